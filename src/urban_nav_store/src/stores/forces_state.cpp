// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/forces_state.hpp"

#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_store {

using urban_nav_core::Archive;
using urban_nav_core::SpecificForce;

namespace {

constexpr const char* kForcesName = "specific forces of a session";
constexpr std::uint32_t kForcesVersion = 2;
/// Version 1 was not sealed: its number in four bytes, then the content of version 2.
constexpr std::string_view kForcesHead1("\1\0\0\0", 4);

/// Returns the content of the bytes of any version. Throws DataError if they are damaged.
std::string_view forcesContent(std::string_view bytes) {
  if (bytes.substr(0, kForcesHead1.size()) == kForcesHead1) return bytes.substr(kForcesHead1.size());
  return urban_nav_core::unseal(kForcesName, kForcesVersion, bytes);
}

}  // namespace

std::string packForces(std::vector<SpecificForce> forces) {
  Archive writer;
  writer(forces);
  return urban_nav_core::seal(kForcesName, kForcesVersion, writer.take());
}

std::optional<std::vector<SpecificForce>> unpackForces(std::string_view bytes) {
  try {
    Archive reader(forcesContent(bytes), kForcesName);
    std::vector<SpecificForce> forces;
    reader(forces);
    reader.finish();
    return forces;
  } catch (const urban_nav_core::DataError&) {
    return std::nullopt;
  }
}

}  // namespace urban_nav_store
