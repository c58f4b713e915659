// SPDX-License-Identifier: BSD-3-Clause
#include "camera/heads.hpp"

namespace urban_nav_sim {
namespace {

using urban_nav_core::Pose;

Imager::Settings toImagerSettings(const CameraDefects& defects, double sensitivity) {
  Imager::Settings settings;
  settings.blurs = defects.blurs;
  settings.is_noisy = defects.is_noisy;
  if (!defects.vignettes) settings.vignetting = 0.0;
  settings.sensitivity = defects.vignettes ? sensitivity : 1.0;
  return settings;
}

Imager::Settings colourSettings(const CameraDefects& defects, const Day& day) {
  Imager::Settings settings = toImagerSettings(defects, 1.0);
  // Balanced for the light of the day: a white sheet in the sun is grey. After sunset it remains at daylight, as a
  // fixed setting: the low sun and lamps are of warm colour.
  if (day.light == Light::Day) {
    const Eigen::Vector3f light = day.sun + day.sky;
    settings.white_balance = Eigen::Vector3f::Constant(light.y()).cwiseQuotient(light);
  }
  settings.gamma = 0.5;
  settings.vignetting *= 1.3;  // wide lenses
  return settings;
}

AutoExposure::Settings greyExposure(const CameraDefects& defects, const Day& day) {
  AutoExposure::Settings settings;
  if (day.light == Light::Night) {
    settings.longest = 0.045;  // of a period of 50 ms; readout takes the rest
    settings.largest_gain = 15.8;
  }
  settings.adapts = defects.adapts;
  return settings;
}

AutoExposure::Settings colourExposure(const CameraDefects& defects, const Day& day) {
  AutoExposure::Settings settings = greyExposure(defects, day);
  settings.target = 70.0;  // before gamma
  return settings;
}

}  // namespace

StereoHead::StereoHead(const Tracer& tracer, const Sky& sky, StereoImages images, const Pose& T_base_left,
                       std::uint64_t seed, const CameraDefects& defects)
    : tracer_(tracer),
      sky_(sky),
      T_base_left_(T_base_left),
      cameras_(bumblebee(images)),
      imagers_{Imager(cameras_[0].lens, toImagerSettings(defects, 1.0), Noise(seed, "stereo left")),
               Imager(cameras_[1].lens, toImagerSettings(defects, 0.97), Noise(seed, "stereo right"))},
      exposure_(greyExposure(defects, sky.day())) {}

std::array<cv::Mat, 2> StereoHead::take(const Motion& motion, double t) {
  const Snapshot snapshot(tracer_, t, t);
  const MotionState motion_state = motion.at(t);
  std::array<cv::Mat, 2> images;
  Exposure exposure;
  for (std::size_t i = 0; i < 2; ++i) {
    const Pose T_base_camera = T_base_left_ * cameras_[i].T_head_camera;
    render(snapshot, sky_, imagers_[i].rays(), motion_state.T_world_base * T_base_camera, Colours::Grey, pictures_[i]);
    if (i == 0) exposure = exposure_.next(pictures_[0]);
    images[i] = imagers_[i].develop(pictures_[i], computeCameraMotion(motion_state, T_base_camera), exposure,
                                    exposure_.levels(exposure), number_);
  }
  ++number_;
  return images;
}

LadybugHead::LadybugHead(const Tracer& tracer, const Sky& sky, const Pose& T_base_head, std::uint64_t seed,
                         const CameraDefects& defects)
    : tracer_(tracer), sky_(sky), T_base_head_(T_base_head), cameras_(ladybug()) {
  const Noise noise(seed, "ladybug");
  exposures_.fill(AutoExposure(colourExposure(defects, sky.day())));
  for (const Camera& camera : cameras_) {
    imagers_.emplace_back(camera.lens, colourSettings(defects, sky.day()), noise.of(imagers_.size()));
  }
}

std::array<cv::Mat, 5> LadybugHead::take(const Motion& motion, double t) {
  const Snapshot snapshot(tracer_, t, t);
  const MotionState motion_state = motion.at(t);
  std::array<cv::Mat, 5> images;
  for (std::size_t i = 0; i < 5; ++i) {
    const Pose T_base_camera = T_base_head_ * cameras_[i].T_head_camera;
    render(snapshot, sky_, imagers_[i].rays(), motion_state.T_world_base * T_base_camera, Colours::Rgb, pictures_[i]);
    const Exposure exposure = exposures_[i].next(pictures_[i]);
    images[i] = imagers_[i].develop(pictures_[i], computeCameraMotion(motion_state, T_base_camera), exposure,
                                    exposures_[i].levels(exposure), number_);
  }
  ++number_;
  return images;
}

}  // namespace urban_nav_sim
