// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/sensors/laser_ground.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/format_number.hpp"
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

std::optional<Finding> LaserGround::finding(const std::string& role, const std::string& topic,
                                            const std::vector<double>& stereo) const {
  const std::optional<double> by_laser = height();
  if (!by_laser || stereo.size() < kFewHeights) return std::nullopt;
  const double by_stereo = urban_nav_core::quantile(stereo, 0.5);
  std::vector<double> deviations;
  for (const double each : stereo) deviations.push_back(std::abs(each - by_stereo));
  const double drop = laser_height_ - by_stereo, apart = *by_laser - by_stereo;
  if (urban_nav_core::quantile(deviations, 0.5) > kScatteredHeights || drop < kLeastDrop) return std::nullopt;
  if (std::abs(apart) < std::max(kTolerance, kRelative * drop)) return std::nullopt;
  const double scale = drop / (laser_height_ - *by_laser);
  const std::string parameter = "--set input." + role + "_range_scale=" + formatNumber(scale, 3);
  return Finding{FindingKind::Lasers,
                 topic + ": the ground it sees is at a height of " + formatNumber(*by_laser, 3) +
                     " m in base_link, and that which stereo sees at " + formatNumber(by_stereo, 3) +
                     " m: its ranges are " + formatNumber(1.0 / scale, 3) +
                     " times the true ones, or its place in tf is " + formatNumber(std::abs(apart), 3) + " m too " +
                     (apart < 0.0 ? "low" : "high"),
                 parameter +
                     " where the ranges are wrong (other scales are multiplied with it), --transform "
                     "PARENT,CHILD:X,Y,Z,QX,QY,QZ,QW where the place is"};
}

}  // namespace urban_nav_input
