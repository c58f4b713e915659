// SPDX-License-Identifier: BSD-3-Clause
#include "faults/fault_filter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "faults/fault_injection.hpp"
#include "noise/hash.hpp"

namespace urban_nav_sim {

using urban_nav_core::StampNs;

namespace {

constexpr double kDefaultDrop = 0.3, kDefaultCorrupt = 0.3, kDefaultJump = 10.0;
constexpr double kDefaultDrift = 0.1;  // s
constexpr double kDefaultRain = 0.05, kDefaultDark = 0.05;

struct Origin {
  std::optional<Sensor> operator()(const StereoMeasurement&) const { return Sensor::Stereo; }
  std::optional<Sensor> operator()(const LadybugMeasurement&) const { return Sensor::Ladybug; }
  std::optional<Sensor> operator()(const LaserMeasurement&) const { return Sensor::Lasers; }
  std::optional<Sensor> operator()(const LidarMeasurement&) const { return Sensor::Lidar3d; }
  std::optional<Sensor> operator()(const ImuMeasurement&) const { return Sensor::Imu; }
  std::optional<Sensor> operator()(const WheelMeasurement&) const { return Sensor::Wheels; }
  std::optional<Sensor> operator()(const GpsMeasurement&) const { return Sensor::Gps; }
  std::optional<Sensor> operator()(const TruthMeasurement&) const { return std::nullopt; }
  std::optional<Sensor> operator()(const ViewTruth&) const { return std::nullopt; }
};

int partIndex(const Measurement& measurement) {
  if (const auto* image = std::get_if<LadybugMeasurement>(&measurement)) return image->camera;
  if (const auto* turn = std::get_if<LaserMeasurement>(&measurement)) return static_cast<int>(turn->side);
  return 0;
}

}  // namespace

FaultFilter::FaultFilter(std::vector<Fault> faults, std::uint64_t seed, StampNs begin, const Lens& right_lens)
    : faults_(std::move(faults)), seed_(seed), begin_(begin), right_lens_(right_lens) {}

void FaultFilter::spoil(const Fault& fault, double t, const Stream& stream, Measurement& measurement) {
  const auto freeze = [&] {
    const StampNs now = toStamp(measurement);
    measurement = last_good_.try_emplace(stream, measurement).first->second;
    setStamp(now, measurement);
  };
  switch (fault.kind) {
    case FaultKind::Drop:
    case FaultKind::Unplug: return;
    case FaultKind::Freeze: return freeze();
    case FaultKind::Swap:
      if (!swapSides(measurement)) freeze();
      return;
    case FaultKind::Corrupt: return corrupt(fault.value.value_or(kDefaultCorrupt), hash(seed_, count_), measurement);
    case FaultKind::Jump:
      return setStamp(toStamp(measurement) + std::llround(1e9 * fault.value.value_or(kDefaultJump)), measurement);
    case FaultKind::Nan: return blank(measurement);
    case FaultKind::Drift: {
      const double share = fault.duration > 0.0 ? std::min(1.0, (t - fault.start) / fault.duration) : 1.0;
      return setStamp(toStamp(measurement) + std::llround(1e9 * share * fault.value.value_or(kDefaultDrift)),
                      measurement);
    }
    case FaultKind::Scale: return;  // of camera_info
    case FaultKind::Rain: return rain(fault.value.value_or(kDefaultRain), hash(seed_, count_), measurement);
    case FaultKind::Dark: return darken(fault.value.value_or(kDefaultDark), hash(seed_, count_), measurement);
    case FaultKind::Knock: return knock(fault.value.value_or(kDefaultKnock), measurement);
  }
}

void FaultFilter::knock(double degrees, Measurement& measurement) {
  auto* pair = std::get_if<StereoMeasurement>(&measurement);
  if (pair == nullptr || pair->right.empty()) return;
  const auto [turn, is_new] = turns_.try_emplace(degrees);
  if (is_new)
    turn->second = TurnedView(right_lens_, Eigen::AngleAxisd(degrees * M_PI / 180.0, Eigen::Vector3d::UnitY()));
  pair->right = turn->second.apply(pair->right);
}

std::optional<Measurement> FaultFilter::apply(Measurement measurement, StampNs taken) {
  const std::optional<Sensor> sensor = std::visit(Origin(), measurement);
  if (!sensor || faults_.empty()) return measurement;
  const Stream stream(*sensor, partIndex(measurement));
  const double t = 1e-9 * static_cast<double>(taken - begin_);
  ++count_;
  bool spoilt = false;
  for (const Fault& fault : faults_) {
    if (fault.sensor != *sensor || !fault.isActive(t)) continue;
    if (fault.kind == FaultKind::Unplug) return std::nullopt;
    if (fault.kind == FaultKind::Drop) {
      if (toUniform(hash(seed_, count_, 1)) < fault.value.value_or(kDefaultDrop)) return std::nullopt;
      continue;
    }
    spoil(fault, t, stream, measurement);
    spoilt = true;
  }
  if (!spoilt) last_good_[stream] = measurement;
  return measurement;
}

}  // namespace urban_nav_sim
