// SPDX-License-Identifier: BSD-3-Clause
#include "session/settings.hpp"

#include <cmath>

namespace urban_nav_sim {

namespace {

constexpr double kDataSheetError = 0.035;  // m: data sheet of the LMS291
// Largest errors of IMUs and bases in use: the gyroscope of EuRoC has 0.08 rad/s.
constexpr double kRateOffset = 0.1 / 1.7320508, kForceOffset = 0.2;  // rad/s, m/s^2, of each axis
constexpr double kImuScale = 5e-3, kImuAxes = 0.2 * M_PI / 180.0;    // standard deviations
constexpr double kWheelScale = 0.03, kLongestDelay = 0.05;           // share; s

}  // namespace

StereoImages stereoImages(const Defects& defects) {
  return defects.has(Sensor::Stereo, Defect::Lens) ? StereoImages::Raw : StereoImages::Rectified;
}

CameraDefects cameraDefects(const Defects& defects, Sensor sensor) {
  CameraDefects made;
  made.is_noisy = defects.has(sensor, Defect::Noise);
  made.blurs = defects.has(sensor, Defect::Blur);
  made.vignettes = defects.has(sensor, Defect::Vignetting);
  made.adapts = defects.has(sensor, Defect::Exposure);
  return made;
}

Lms291::Settings laserSettings(const Defects& defects) {
  Lms291::Settings settings;
  if (!defects.has(Sensor::Lasers, Defect::Noise)) settings.sigma = 0.0;
  if (!defects.has(Sensor::Lasers, Defect::Bias)) settings.largest_bias = 0.0;
  if (!defects.has(Sensor::Lasers, Defect::Steps)) settings.step = 0.0;
  settings.mixes = defects.has(Sensor::Lasers, Defect::Edges);
  settings.loses = defects.has(Sensor::Lasers, Defect::Losses);
  if (defects.has(Sensor::Lasers, Defect::Offset)) settings.systematic_error = kDataSheetError;
  return settings;
}

Lidar3d::Settings lidarSettings(const Defects& defects) {
  const auto has = [&](Defect defect) { return defects.has(Sensor::Lidar3d, defect); };
  Lidar3d::Settings settings;
  if (!has(Defect::Noise)) settings.sigma = 0.0;
  if (!has(Defect::Bias)) settings.ring_range_sigma = settings.ring_angle_sigma = 0.0;
  if (!has(Defect::Steps)) settings.step = 0.0;
  settings.mixes = has(Defect::Edges);
  settings.loses = has(Defect::Losses);
  settings.has_times = !has(Defect::Times);
  return settings;
}

ImuOptions imuOptions(const Defects& defects) {
  const ImuOptions usual;
  ImuOptions options = perfectImu();
  if (defects.has(Sensor::Imu, Defect::Noise)) {
    options.rate_density = usual.rate_density;
    options.force_density = usual.force_density;
    options.field_sigma = usual.field_sigma;
  }
  if (defects.has(Sensor::Imu, Defect::Bias)) {
    options.rate_bias = usual.rate_bias;
    options.rate_walk = usual.rate_walk;
    options.force_bias = usual.force_bias;
    options.field_bias = usual.field_bias;
    options.field_disturbance = usual.field_disturbance;
  }
  const auto has = [&](Defect defect) { return defects.has(Sensor::Imu, defect); };
  if (has(Defect::Offset)) {
    options.rate_offset = kRateOffset;
    options.force_offset = kForceOffset;
  }
  if (has(Defect::Scale)) {
    options.scale_sigma = kImuScale;
    options.axes_sigma = kImuAxes;
  }
  options.mistakes = {has(Defect::Axes), has(Defect::Degrees), has(Defect::Ned), has(Defect::Gravity)};
  return options;
}

WheelOptions wheelOptions(const Defects& defects) {
  const WheelOptions usual;
  WheelOptions options = perfectWheels();
  if (defects.has(Sensor::Wheels, Defect::Tyres)) {
    options.scale_sigma = usual.scale_sigma;
    options.difference_sigma = usual.difference_sigma;
    options.track = usual.track;
  }
  if (defects.has(Sensor::Wheels, Defect::Slip)) options.slip_sigma = usual.slip_sigma;
  options.counts = defects.has(Sensor::Wheels, Defect::Steps);
  if (defects.has(Sensor::Wheels, Defect::Scale)) options.largest_scale = kWheelScale;
  return options;
}

GpsOptions gpsOptions(const Defects& defects) {
  const GpsOptions usual;
  GpsOptions options = perfectGps();
  if (defects.has(Sensor::Gps, Defect::Noise)) {
    options.white_sigma = usual.white_sigma;
    options.velocity_sigma = usual.velocity_sigma;
  }
  if (defects.has(Sensor::Gps, Defect::Bias)) options.slow_sigma = usual.slow_sigma;
  if (defects.has(Sensor::Gps, Defect::Multipath)) options.multipath_sigma = usual.multipath_sigma;
  options.gaps = defects.has(Sensor::Gps, Defect::Gaps);
  return options;
}

ClockOptions clockOptions(const Defects& defects, Sensor sensor, std::uint64_t seed) {
  ClockOptions options = defects.has(sensor, Defect::Clock) ? uncorrectedClock(sensor, seed) : correctedClock(sensor);
  if (!defects.has(sensor, Defect::Jitter)) options.jitter = 0.0;
  if (defects.has(sensor, Defect::Delay))
    options.offset += Noise(seed, "delay").of(static_cast<std::uint64_t>(sensor)).uniform(0, 0.0, kLongestDelay);
  return options;
}

}  // namespace urban_nav_sim
