// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/sensors/laser_ground.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/trajectory/statistics.hpp"

namespace urban_nav_input {

using urban_nav_core::formatNumber;

namespace {

constexpr std::int64_t kEachScan = 5, kFewReturns = 500;
constexpr double kReach = 5.0;      // m from the laser, horizontally
constexpr double kDownwards = 0.3;  // least downward component of a beam
constexpr double kBin = 0.05, kLowest = -10.0;
constexpr std::size_t kBins = 400, kHalfWidth = 2;
constexpr double kLevelShare = 0.3;  // share of the low returns within the height of the ground +- 12 cm
constexpr std::size_t kFewHeights = 5;
constexpr double kScatteredHeights = 0.12;            // m, median deviation of the heights by stereo
constexpr double kTolerance = 0.25, kRelative = 0.2;  // m; of the height of the laser: kerbs, slopes, crowns of roads
constexpr double kLeastDrop = 0.3;                    // m from the laser to the ground
constexpr double kFoot = 0.3048, kFootTolerance = 0.15;  // m; relative error of the height by stereo

/// Returns the height of the ground by stereo; nullopt if the heights are few or scattered.
std::optional<double> heightByStereo(const std::vector<double>& heights) {
  if (heights.size() < kFewHeights) return std::nullopt;
  const double median = urban_nav_core::quantile(heights, 0.5);
  std::vector<double> deviations;
  for (const double each : heights) deviations.push_back(std::abs(each - median));
  return urban_nav_core::quantile(deviations, 0.5) > kScatteredHeights ? std::nullopt : std::optional(median);
}

}  // namespace

void LaserGround::add(const urban_nav_core::PlanarScan& scan, const urban_nav_core::Pose& T_base_laser) {
  if (scans_++ % kEachScan != 0) return;
  heights_.resize(kBins, 0);
  laser_height_ = T_base_laser.t().z();
  for (const urban_nav_core::Beam& beam : urban_nav_core::toScan(scan).beams) {
    const urban_nav_core::Vector3d direction = T_base_laser.R() * beam.direction.cast<double>();
    const double range = static_cast<double>(beam.range);
    if (direction.z() > -kDownwards || range * direction.head<2>().norm() > kReach) continue;
    ++returns_;
    const double bin = std::floor((laser_height_ + range * direction.z() - kLowest) / kBin);
    if (bin >= 0.0 && bin < static_cast<double>(kBins)) ++heights_[static_cast<std::size_t>(bin)];
  }
}

std::optional<double> LaserGround::height() const {
  if (returns_ < kFewReturns) return std::nullopt;
  const auto around = [this](std::size_t bin) {
    std::int64_t sum = 0;
    for (std::size_t i = bin - kHalfWidth; i <= bin + kHalfWidth; ++i) sum += heights_[i];
    return sum;
  };
  std::size_t best = kHalfWidth;
  for (std::size_t bin = kHalfWidth; bin + kHalfWidth < heights_.size(); ++bin)
    if (around(bin) > around(best)) best = bin;
  if (static_cast<double>(around(best)) < kLevelShare * static_cast<double>(returns_)) return std::nullopt;
  double sum = 0.0;
  for (std::size_t i = best - kHalfWidth; i <= best + kHalfWidth; ++i)
    sum += static_cast<double>(heights_[i]) * (kLowest + kBin * (static_cast<double>(i) + 0.5));
  return sum / static_cast<double>(around(best));
}

bool LaserGround::agreesWith(double by_stereo) const {
  const std::optional<double> by_laser = height();
  return by_laser && std::abs(*by_laser - by_stereo) < std::max(kTolerance, kRelative * (laser_height_ - by_stereo));
}

std::optional<Finding> LaserGround::finding(const std::string& role, const std::string& topic,
                                            const std::vector<double>& stereo, double range_scale) const {
  const std::optional<double> by_laser = height(), by_stereo = heightByStereo(stereo);
  if (!by_laser || !by_stereo || agreesWith(*by_stereo)) return std::nullopt;
  const double drop = laser_height_ - *by_stereo, apart = *by_laser - *by_stereo;
  if (drop < kLeastDrop) return std::nullopt;
  const double scale = drop / (laser_height_ - *by_laser);
  const std::string parameter = "input." + role + "_range_scale=";
  Finding finding{FindingKind::Lasers,
                  topic + ": the ground it measures is at a height of " + formatNumber(*by_laser, 3) +
                      " m in base_link, that of stereo at " + formatNumber(*by_stereo, 3) + " m: its ranges are " +
                      formatNumber(1.0 / scale, 3) + " times the true ones, or its pose in tf is " +
                      formatNumber(std::abs(apart), 3) + " m too " + (apart < 0.0 ? "low" : "high"),
                  "--set " + parameter + formatNumber(scale, 3) +
                      " if the ranges are wrong (multiplied with other scales), --transform "
                      "PARENT,CHILD:X,Y,Z,QX,QY,QZ,QW if the pose is"};
  if (std::abs(scale / kFoot - 1.0) > kFootTolerance) return finding;
  finding.text += "; its ranges are probably in feet";
  finding.options = {"--set", parameter + urban_nav_core::printNumber(kFoot * range_scale)};
  finding.remedy = finding.options[0] + " " + finding.options[1] +
                   " if they are in feet, --transform PARENT,CHILD:X,Y,Z,QX,QY,QZ,QW if the pose is wrong; for "
                   "later recordings let the driver publish metres";
  return finding;
}

bool areExchanged(const std::array<LaserGround, 2>& own, const std::array<LaserGround, 2>& other,
                  const std::vector<double>& stereo) {
  const std::optional<double> by_stereo = heightByStereo(stereo);
  const auto agrees = [&](const LaserGround& ground) { return ground.agreesWith(*by_stereo); };
  return by_stereo && std::none_of(own.begin(), own.end(), agrees) && std::all_of(other.begin(), other.end(), agrees);
}

}  // namespace urban_nav_input
