// SPDX-License-Identifier: BSD-3-Clause
#include "session/optical_sensors.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <utility>

#include "camera/heads.hpp"
#include "camera/sky.hpp"
#include "laser/lms291.hpp"
#include "proprioception/schedule.hpp"
#include "ray_tracing/tracer.hpp"
#include "rig/sensor_poses.hpp"
#include "session/settings.hpp"
#include "urban_nav_core/types/frames.hpp"

namespace urban_nav_sim {

namespace frames = urban_nav_core::frames;

using urban_nav_core::expSo3;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;

namespace {

ViewTruth toViewTruth(const Picture& picture, std::string frame, StampNs stamp) {
  ViewTruth view{stamp, std::move(frame), cv::Mat(picture.height, picture.width, CV_32F),
                 cv::Mat(picture.height, picture.width, CV_8U)};
  std::copy(picture.depth.begin(), picture.depth.end(), view.depth.begin<float>());
  std::copy(picture.surface_class.begin(), picture.surface_class.end(), view.surface_class.begin<std::uint8_t>());
  return view;
}

ViewTruth toViewTruth(const std::vector<BeamTruth>& beams, std::string frame, StampNs stamp) {
  const auto count = static_cast<int>(beams.size());
  ViewTruth view{stamp, std::move(frame), cv::Mat(1, count, CV_32F), cv::Mat(1, count, CV_8U)};
  for (int i = 0; i < count; ++i) {
    const BeamTruth& beam = beams[static_cast<std::size_t>(i)];
    view.depth.at<float>(i) = static_cast<float>(beam.range);
    view.surface_class.at<std::uint8_t>(i) = static_cast<std::uint8_t>(beam.surface_class);
  }
  return view;
}

ViewTruth toViewTruth(const SweepTruth& sweep, StampNs stamp) {
  ViewTruth view{stamp, frames::kLidar3d, cv::Mat(sweep.rings, sweep.columns, CV_32F),
                 cv::Mat(sweep.rings, sweep.columns, CV_8U)};
  std::copy(sweep.range.begin(), sweep.range.end(), view.depth.begin<float>());
  std::transform(sweep.surface_class.begin(), sweep.surface_class.end(), view.surface_class.begin<std::uint8_t>(),
                 [](SurfaceClass each) { return static_cast<std::uint8_t>(each); });
  return view;
}

}  // namespace

class OpticalSensors::Implementation {
 public:
  Implementation(const World& world, const Motion& motion, const Noise& noise, const Defects& defects,
                 const LidarModel& lidar, const std::set<Sensor>& views, const std::vector<Fault>& faults)
      : motion_(motion),
        views_(views),
        laser_seed_(noise.of("lasers").bits(0)),
        laser_settings_(laserSettings(defects)),
        faults_(faults),
        tracer_(world),
        sky_(world, noise.of("sky").bits(0)),
        stereo_(tracer_, sky_, stereoImages(defects), sensorPose(frames::kStereoLeft), noise.of("stereo").bits(0),
                cameraDefects(defects, Sensor::Stereo)),
        ladybug_(tracer_, sky_, ladybugPlace(), noise.of("ladybug").bits(0), cameraDefects(defects, Sensor::Ladybug)),
        right_laser_(tracer_, sensorPose(frames::kLaserRight), laser_seed_, frames::kLaserRight, laser_settings_),
        lidar_(tracer_, lidarPose(), noise.of("lidar3d").bits(0), lidar, lidarSettings(defects)) {}

  std::vector<Measurement> stereo(std::int64_t k, const Clock& clock) {
    const double t = sensorSchedule(Sensor::Stereo).at(k);
    const StampNs stamp = clock.stamp(k, t);
    auto [left, right] = stereo_.take(motion_, t);
    std::vector<Measurement> measurements = {StereoMeasurement{stamp, std::move(left), std::move(right)}};
    if (views_.count(Sensor::Stereo) != 0) {
      measurements.emplace_back(toViewTruth(stereo_.pictures()[0], frames::kStereoLeft, stamp));
      measurements.emplace_back(toViewTruth(stereo_.pictures()[1], frames::kStereoRight, stamp));
    }
    return measurements;
  }

  std::vector<Measurement> panorama(std::int64_t k, const Clock& clock) {
    const double t = sensorSchedule(Sensor::Ladybug).at(k);
    const StampNs stamp = clock.stamp(k, t);
    ladybug_.place(turned(ladybugPlace(), Eigen::Vector3d::UnitZ(), turnAt(Sensor::Ladybug, t)));
    std::array<cv::Mat, 5> taken = ladybug_.take(motion_, t);
    std::vector<Measurement> measurements;
    for (std::size_t i = 0; i < taken.size(); ++i) {
      measurements.emplace_back(LadybugMeasurement{stamp, static_cast<int>(i), std::move(taken[i])});
      if (views_.count(Sensor::Ladybug) != 0)
        measurements.emplace_back(
            toViewTruth(ladybug_.pictures()[i], frames::ladybugCamera(static_cast<int>(i)), stamp));
    }
    return measurements;
  }

  std::vector<Measurement> laser(Side side, std::int64_t k, const Clock& clock) {
    const double t = laserSchedule(side).at(k);
    const StampNs stamp = clock.stamp(k, t);
    const Lms291& device = side == Side::Left ? leftLaserAt(t) : right_laser_;
    const bool is_viewed = views_.count(Sensor::Lasers) != 0;
    std::vector<BeamTruth> beams;
    std::vector<Measurement> measurements = {LaserMeasurement{
        side, device.scan(motion_, t, stamp, static_cast<std::uint64_t>(k), is_viewed ? &beams : nullptr)}};
    if (is_viewed)
      measurements.emplace_back(
          toViewTruth(beams, side == Side::Left ? frames::kLaserLeft : frames::kLaserRight, stamp));
    return measurements;
  }

  std::vector<Measurement> lidar(std::int64_t k, const Clock& clock) const {
    const double t = sensorSchedule(Sensor::Lidar3d).at(k);
    const StampNs stamp = clock.stamp(k, t);
    const bool is_viewed = views_.count(Sensor::Lidar3d) != 0;
    SweepTruth truth;
    std::vector<Measurement> measurements = {LidarMeasurement{
        stamp, lidar_.sweep(motion_, t, stamp, static_cast<std::uint64_t>(k), is_viewed ? &truth : nullptr)}};
    if (is_viewed) measurements.emplace_back(toViewTruth(truth, stamp));
    return measurements;
  }
  const Lidar3d& lidarDevice() const { return lidar_; }

 private:
  /// Returns the turn of a mounting by the knocks until a time, deg.
  double turnAt(Sensor sensor, double t) const {
    double turn = 0.0;
    for (const Fault& fault : faults_)
      if (fault.kind == FaultKind::Knock && fault.sensor == sensor && fault.isActive(t))
        turn += fault.value.value_or(kDefaultKnock);
    return turn;
  }
  static Pose turned(const Pose& place, const Eigen::Vector3d& axis, double degrees) {
    if (degrees == 0.0) return place;  // to the bit
    return Pose(expSo3(degrees * M_PI / 180.0 * axis) * place.q(), place.t());
  }
  const Lms291& leftLaserAt(double t) {
    const double turn = turnAt(Sensor::Lasers, t);
    const Pose place = sensorPose(frames::kLaserLeft);
    return left_lasers_
        .try_emplace(turn, tracer_, turned(place, place.R().col(2), turn), laser_seed_, frames::kLaserLeft,
                     laser_settings_)
        .first->second;
  }

  const Motion& motion_;
  std::set<Sensor> views_;
  std::uint64_t laser_seed_;
  Lms291::Settings laser_settings_;
  std::vector<Fault> faults_;
  Tracer tracer_;
  Sky sky_;
  StereoHead stereo_;
  LadybugHead ladybug_;
  std::map<double, Lms291> left_lasers_;  // key: turn, deg
  Lms291 right_laser_;
  Lidar3d lidar_;
};

OpticalSensors::OpticalSensors(const World& world, const Motion& motion, const Noise& noise, const Defects& defects,
                               const LidarModel& lidar, const std::set<Sensor>& views, const std::vector<Fault>& faults)
    : implementation_(std::make_unique<Implementation>(world, motion, noise, defects, lidar, views, faults)) {}
OpticalSensors::~OpticalSensors() = default;

std::vector<Measurement> OpticalSensors::stereo(std::int64_t k, const Clock& clock) {
  return implementation_->stereo(k, clock);
}
std::vector<Measurement> OpticalSensors::panorama(std::int64_t k, const Clock& clock) {
  return implementation_->panorama(k, clock);
}
std::vector<Measurement> OpticalSensors::laser(Side side, std::int64_t k, const Clock& clock) {
  return implementation_->laser(side, k, clock);
}
std::vector<Measurement> OpticalSensors::lidar(std::int64_t k, const Clock& clock) {
  return implementation_->lidar(k, clock);
}
const Lidar3d& OpticalSensors::lidarDevice() const { return implementation_->lidarDevice(); }

urban_nav_core::CameraInfo OpticalSensors::stereoInfo(Side side, const Defects& defects) {
  return bumblebee(stereoImages(defects))[static_cast<std::size_t>(side)].info;
}
urban_nav_core::CameraInfo OpticalSensors::ladybugInfo(int camera) {
  return ladybug()[static_cast<std::size_t>(camera)].info;
}

}  // namespace urban_nav_sim
