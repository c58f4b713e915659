// SPDX-License-Identifier: BSD-3-Clause
#include "topics/loops/closure_bytes.hpp"

#include <cmath>

#include "urban_nav_store/bytes.hpp"

namespace urban_nav {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::MetricClosure;
using urban_nav_core::PoseRef;
using urban_nav_store::ByteReader;

namespace {

constexpr std::size_t kSmallestClosure = 400;  // bytes of one without words and free directions

void append(std::string& bytes, const PoseRef& ref) {
  urban_nav_store::appendText(bytes, ref.session);
  urban_nav_store::appendInteger(bytes, static_cast<std::uint64_t>(ref.stamp));
}

void append(std::string& bytes, const MetricClosure& closure) {
  append(bytes, closure.a);
  append(bytes, closure.b);
  for (int i = 0; i < 3; ++i) urban_nav_store::appendNumber(bytes, closure.measured.T_a_b.t()(i));
  for (int i = 0; i < 4; ++i) urban_nav_store::appendNumber(bytes, closure.measured.T_a_b.q().coeffs()(i));
  for (int i = 0; i < 36; ++i) urban_nav_store::appendNumber(bytes, closure.measured.information(i / 6, i % 6));
  urban_nav_store::appendInteger(bytes, closure.free_directions.size());
  for (const urban_nav_core::Vector6d& direction : closure.free_directions)
    for (int i = 0; i < 6; ++i) urban_nav_store::appendNumber(bytes, direction(i));
  urban_nav_store::appendNumber(bytes, closure.probability);
  urban_nav_store::appendText(bytes, toString(closure.method));
  urban_nav_store::appendInteger(bytes, closure.odometry_gate ? 1 : 0);
  urban_nav_store::appendText(bytes, toString(closure.verdict));
  urban_nav_store::appendInteger(bytes, static_cast<std::uint64_t>(closure.reason));
  urban_nav_store::appendText(bytes, closure.reason_name);
  urban_nav_store::appendText(bytes, closure.sentence);
  urban_nav_store::appendText(bytes, closure.evidence);
  urban_nav_store::appendText(bytes, closure.source);
}

PoseRef readRef(ByteReader& reader) {
  PoseRef ref;
  ref.session = reader.text();
  ref.stamp = static_cast<urban_nav_core::StampNs>(reader.integer());
  return ref;
}

/// Sets `good` to false for a number that is not finite.
double readNumber(ByteReader& reader, bool& good) {
  const double value = reader.number();
  good = good && std::isfinite(value);
  return value;
}

bool readTransform(ByteReader& reader, MetricClosure& closure) {
  bool good = true;
  double value[7];
  for (double& each : value) each = readNumber(reader, good);
  const Eigen::Quaterniond q(value[6], value[3], value[4], value[5]);
  if (!good || std::abs(q.norm() - 1.0) > 1e-6) return false;
  closure.measured.T_a_b = urban_nav_core::Pose(q, Eigen::Vector3d(value[0], value[1], value[2]));
  for (int i = 0; i < 36; ++i) closure.measured.information(i / 6, i % 6) = readNumber(reader, good);
  const std::uint64_t directions = reader.integer();
  if (!good || directions > 6) return false;
  for (std::uint64_t d = 0; d < directions; ++d) {
    urban_nav_core::Vector6d direction;
    for (int i = 0; i < 6; ++i) direction(i) = readNumber(reader, good);
    closure.free_directions.push_back(direction);
  }
  closure.probability = readNumber(reader, good);
  return good && closure.probability >= 0.0 && closure.probability <= 1.0;
}

std::optional<MetricClosure> readClosure(ByteReader& reader) {
  MetricClosure closure;
  closure.a = readRef(reader);
  closure.b = readRef(reader);
  if (!readTransform(reader, closure)) return std::nullopt;
  const std::optional<ClosureMethod> method = urban_nav_core::parseClosureMethod(reader.text());
  closure.odometry_gate = reader.integer() != 0;
  const std::optional<ClosureVerdict> verdict = urban_nav_core::parseClosureVerdict(reader.text());
  if (!method || !verdict) return std::nullopt;
  closure.method = *method;
  closure.verdict = *verdict;
  closure.reason = static_cast<int>(reader.integer());
  closure.reason_name = reader.text();
  closure.sentence = reader.text();
  closure.evidence = reader.text();
  closure.source = reader.text();
  return reader.ok() ? std::optional(std::move(closure)) : std::nullopt;
}

}  // namespace

std::string packClosures(const std::vector<MetricClosure>& closures) {
  std::string bytes;
  urban_nav_store::appendInteger(bytes, closures.size());
  for (const MetricClosure& closure : closures) append(bytes, closure);
  return bytes;
}

std::optional<std::vector<MetricClosure>> unpackClosures(std::string_view bytes) {
  ByteReader reader(bytes);
  const std::uint64_t count = reader.integer();
  if (!reader.ok() || count > reader.left() / kSmallestClosure) return std::nullopt;
  std::vector<MetricClosure> closures;
  for (std::uint64_t i = 0; i < count; ++i) {
    std::optional<MetricClosure> closure = readClosure(reader);
    if (!closure) return std::nullopt;
    closures.push_back(std::move(*closure));
  }
  return reader.complete() ? std::optional(std::move(closures)) : std::nullopt;
}

}  // namespace urban_nav
