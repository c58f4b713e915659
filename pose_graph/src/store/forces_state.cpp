// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/forces_state.hpp"

#include "urban_nav_store/bytes.hpp"

namespace pose_graph {

using urban_nav_store::appendInteger;
using urban_nav_store::appendInteger32;
using urban_nav_store::appendNumber;

namespace {

constexpr std::uint32_t kVersion = 1;  // of these bytes
constexpr std::size_t kBytes = 32;     // of a force: its stamp and three numbers

}  // namespace

std::string packForces(const std::vector<FeltForce>& forces) {
  std::string bytes;
  appendInteger32(bytes, kVersion);
  appendInteger(bytes, forces.size());
  for (const FeltForce& each : forces) {
    appendInteger(bytes, static_cast<std::uint64_t>(each.stamp));
    for (int i = 0; i < 3; ++i) appendNumber(bytes, each.force(i));
  }
  return bytes;
}

std::optional<std::vector<FeltForce>> unpackForces(std::string_view bytes) {
  urban_nav_store::ByteReader reader(bytes);
  if (reader.integer32() != kVersion) return std::nullopt;
  const std::uint64_t count = reader.integer();
  if (!reader.ok() || count > reader.left() / kBytes) return std::nullopt;
  std::vector<FeltForce> forces(count);
  for (FeltForce& each : forces) {
    each.stamp = static_cast<urban_nav_core::StampNs>(reader.integer());
    for (int i = 0; i < 3; ++i) each.force(i) = reader.number();
  }
  if (!reader.complete()) return std::nullopt;
  return forces;
}

}  // namespace pose_graph
