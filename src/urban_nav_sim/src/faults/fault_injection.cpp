// SPDX-License-Identifier: BSD-3-Clause
#include "faults/fault_injection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "noise/hash.hpp"

namespace urban_nav_sim {

using urban_nav_core::StampNs;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kLongestLidarRange = 120.0;  // m
constexpr int kStreakLength = 12;             // px
constexpr double kReadNoise = 2.0;            // grey levels, at most

template <typename Any>
void set(StampNs stamp, Any& measurement) {
  measurement.stamp = stamp;
}
void set(StampNs stamp, LaserMeasurement& measurement) { measurement.scan.stamp = stamp; }
void set(StampNs stamp, LidarMeasurement& measurement) {
  const StampNs shift = stamp - measurement.stamp;
  measurement.stamp = stamp;
  measurement.sweep.reference += shift;
  for (urban_nav_core::Beam& beam : measurement.sweep.beams) beam.stamp += shift;
}

/// Modifies a copy, since pixels are shared with previous measurements.
void corruptRows(double share, std::uint64_t seed, cv::Mat& image) {
  image = image.clone();
  for (int v = 0; v < image.rows; ++v) {
    if (toUniform(hash(seed, v)) >= share) continue;
    std::uint8_t* row = image.ptr<std::uint8_t>(v);
    for (int i = 0; i < image.cols * image.channels(); ++i) row[i] = static_cast<std::uint8_t>(hash(seed, v, i));
  }
}

/// Draws vertical streaks of 12 px, half transparent.
void drawStreaks(double share, std::uint64_t seed, cv::Mat& image) {
  if (image.empty()) return;
  image = image.clone();
  Draw draw(seed);
  const int streaks = static_cast<int>(share * image.rows * image.cols / kStreakLength);
  for (int i = 0; i < streaks; ++i) {
    const int u = static_cast<int>(draw.uniform(0.0, image.cols)), v = static_cast<int>(draw.uniform(0.0, image.rows));
    for (int k = 0; k < kStreakLength && v + k < image.rows; ++k) {
      std::uint8_t& pixel = image.at<std::uint8_t>(v + k, std::min(u, image.cols - 1));
      pixel = static_cast<std::uint8_t>((pixel + 255) / 2);
    }
  }
}

void darkenPixels(double factor, std::uint64_t seed, cv::Mat& image) {
  if (image.empty()) return;
  image = image.clone();
  Draw draw(seed);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) {
      std::uint8_t& pixel = image.at<std::uint8_t>(v, u);
      const double noise = draw.uniform(-kReadNoise, kReadNoise);
      pixel = static_cast<std::uint8_t>(std::clamp(std::lround(factor * pixel + noise), 0L, 255L));
    }
}

/// Sets one of the numbers to a random value up to `size`.
class CorruptedBytes {
 public:
  CorruptedBytes(double share, std::uint64_t seed) : share_(share), draw_(seed) {}
  void into(double size, double& number) {
    if (draw_.chance(share_)) number = draw_.uniform(-size, size);
  }
  void into(double size, Eigen::Vector3d& vector) {
    for (int k = 0; k < 3; ++k) into(size, vector[k]);
  }

 private:
  double share_;
  Draw draw_;
};

struct Corrupt {
  double share;
  std::uint64_t seed;

  void operator()(StereoMeasurement& pair) const {
    corruptRows(share, hash(seed, 1), pair.left);
    corruptRows(share, hash(seed, 2), pair.right);
  }
  void operator()(LadybugMeasurement& panorama) const { corruptRows(share, seed, panorama.image); }
  void operator()(LaserMeasurement& turn) const {
    for (std::size_t i = 0; i < turn.scan.ranges.size(); ++i)
      if (toUniform(hash(seed, i)) < share)
        turn.scan.ranges[i] = static_cast<float>(turn.scan.range_max * toUniform(hash(seed, i, 1)));
  }
  void operator()(LidarMeasurement& lidar) const {
    for (std::size_t i = 0; i < lidar.sweep.beams.size(); ++i)
      if (toUniform(hash(seed, i)) < share)
        lidar.sweep.beams[i].range = static_cast<float>(kLongestLidarRange * toUniform(hash(seed, i, 1)));
  }
  void operator()(ImuMeasurement& imu) const {
    CorruptedBytes rubbish(share, seed);
    rubbish.into(10.0, imu.rate);
    rubbish.into(50.0, imu.specific_force);
    rubbish.into(1e-4, imu.field);
  }
  void operator()(WheelMeasurement& wheels) const {
    CorruptedBytes rubbish(share, seed);
    Eigen::Vector3d place = wheels.T_odom_base.t();
    rubbish.into(1000.0, place);
    wheels.T_odom_base = urban_nav_core::Pose(wheels.T_odom_base.q(), place);
    rubbish.into(10.0, wheels.speed);
    rubbish.into(10.0, wheels.yaw_rate);
  }
  void operator()(GpsMeasurement& gps) const {
    CorruptedBytes rubbish(share, seed);
    rubbish.into(90.0, gps.latitude);
    rubbish.into(180.0, gps.longitude);
    rubbish.into(9000.0, gps.altitude);
    rubbish.into(100.0, gps.velocity);
  }
  void operator()(TruthMeasurement&) const {}
  void operator()(ViewTruth&) const {}
};

struct Blank {
  static cv::Mat black(const cv::Mat& image) { return cv::Mat::zeros(image.size(), image.type()); }

  void operator()(StereoMeasurement& pair) const {
    pair.left = black(pair.left);
    pair.right = black(pair.right);
  }
  void operator()(LadybugMeasurement& panorama) const { panorama.image = black(panorama.image); }
  void operator()(LaserMeasurement& turn) const {
    turn.scan.ranges.assign(turn.scan.ranges.size(), std::numeric_limits<float>::quiet_NaN());
  }
  void operator()(LidarMeasurement& lidar) const {
    for (urban_nav_core::Beam& beam : lidar.sweep.beams) beam.range = std::numeric_limits<float>::quiet_NaN();
  }
  void operator()(ImuMeasurement& imu) const {
    imu.rate.setConstant(kNan);
    imu.specific_force.setConstant(kNan);
    imu.field.setConstant(kNan);
  }
  void operator()(WheelMeasurement& wheels) const {
    wheels.T_odom_base = urban_nav_core::Pose(wheels.T_odom_base.q(), Eigen::Vector3d::Constant(kNan));
    wheels.speed = wheels.yaw_rate = kNan;
  }
  void operator()(GpsMeasurement& gps) const {
    gps.latitude = gps.longitude = gps.altitude = kNan;
    gps.velocity.setConstant(kNan);
  }
  void operator()(TruthMeasurement&) const {}
  void operator()(ViewTruth&) const {}
};

}  // namespace

void setStamp(StampNs stamp, Measurement& measurement) {
  std::visit([stamp](auto& any) { set(stamp, any); }, measurement);
}

bool swapSides(Measurement& measurement) {
  if (auto* pair = std::get_if<StereoMeasurement>(&measurement)) {
    std::swap(pair->left, pair->right);
    return true;
  }
  if (auto* turn = std::get_if<LaserMeasurement>(&measurement)) {
    turn->side = turn->side == Side::Left ? Side::Right : Side::Left;
    return true;
  }
  return false;
}

void corrupt(double share, std::uint64_t seed, Measurement& measurement) {
  std::visit(Corrupt{share, seed}, measurement);
}

void rain(double share, std::uint64_t seed, Measurement& measurement) {
  auto* pair = std::get_if<StereoMeasurement>(&measurement);
  if (pair == nullptr) return;
  drawStreaks(share, hash(seed, 1), pair->left);
  drawStreaks(share, hash(seed, 2), pair->right);
}

void darken(double factor, std::uint64_t seed, Measurement& measurement) {
  auto* pair = std::get_if<StereoMeasurement>(&measurement);
  if (pair == nullptr) return;
  darkenPixels(factor, hash(seed, 1), pair->left);
  darkenPixels(factor, hash(seed, 2), pair->right);
}

void blank(Measurement& measurement) { std::visit(Blank(), measurement); }

}  // namespace urban_nav_sim
