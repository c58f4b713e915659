// SPDX-License-Identifier: BSD-3-Clause
#include "session/eyes.hpp"

#include "body/schedule.hpp"
#include "camera/heads.hpp"
#include "camera/sky.hpp"
#include "laser/lms291.hpp"
#include "rig/places.hpp"
#include "trace/tracer.hpp"

namespace urban_nav_sim {

namespace {

constexpr StereoImages images = StereoImages::Rectified;

}  // namespace

class Eyes::Implementation {
 public:
  Implementation(const World& world, const Ride& ride, const Noise& noise)
      : ride_(ride),
        tracer_(world),
        sky_(world.day, noise.of("sky").bits(0)),
        stereo_(tracer_, sky_, images, placeOf("stereo_left_optical_frame"), noise.of("stereo").bits(0)),
        ladybug_(tracer_, sky_, ladybugPlace(), noise.of("ladybug").bits(0)),
        left_laser_(tracer_, placeOf("laser_left"), noise.of("lasers").bits(0), "laser_left", Lms291::Settings()),
        right_laser_(tracer_, placeOf("laser_right"), noise.of("lasers").bits(0), "laser_right", Lms291::Settings()) {}

  std::vector<Measurement> stereo(std::int64_t k, const Clock& clock) {
    const double t = scheduleOf(Sensor::Stereo).at(k);
    auto [left, right] = stereo_.take(ride_, t);
    return {StereoMeasurement{clock.stamp(k, t), std::move(left), std::move(right)}};
  }

  std::vector<Measurement> panorama(std::int64_t k, const Clock& clock) {
    const double t = scheduleOf(Sensor::Ladybug).at(k);
    std::array<cv::Mat, 5> taken = ladybug_.take(ride_, t);
    std::vector<Measurement> measurements;
    for (std::size_t i = 0; i < taken.size(); ++i)
      measurements.emplace_back(LadybugMeasurement{clock.stamp(k, t), static_cast<int>(i), std::move(taken[i])});
    return measurements;
  }

  std::vector<Measurement> laser(Side side, std::int64_t k, const Clock& clock) const {
    const double t = laserSchedule(side).at(k);
    const Lms291& device = side == Side::Left ? left_laser_ : right_laser_;
    return {LaserMeasurement{side, device.scan(ride_, t, clock.stamp(k, t), static_cast<std::uint64_t>(k))}};
  }

 private:
  const Ride& ride_;
  Tracer tracer_;
  Sky sky_;
  StereoHead stereo_;
  LadybugHead ladybug_;
  Lms291 left_laser_, right_laser_;
};

Eyes::Eyes(const World& world, const Ride& ride, const Noise& noise)
    : implementation_(std::make_unique<Implementation>(world, ride, noise)) {}
Eyes::~Eyes() = default;

std::vector<Measurement> Eyes::stereo(std::int64_t k, const Clock& clock) { return implementation_->stereo(k, clock); }
std::vector<Measurement> Eyes::panorama(std::int64_t k, const Clock& clock) {
  return implementation_->panorama(k, clock);
}
std::vector<Measurement> Eyes::laser(Side side, std::int64_t k, const Clock& clock) {
  return implementation_->laser(side, k, clock);
}

urban_nav_core::CameraInfo Eyes::stereoInfo(Side side) {
  return bumblebee(images)[static_cast<std::size_t>(side)].info;
}
urban_nav_core::CameraInfo Eyes::ladybugInfo(int camera) { return ladybug()[static_cast<std::size_t>(camera)].info; }

}  // namespace urban_nav_sim
