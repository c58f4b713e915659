// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_stereo.hpp"

#include <chrono>

#include "own_method.hpp"

namespace dense_stereo {

LiveStereo::LiveStereo(const Parameters& parameters) : parameters_(parameters) { requireOwnMethod(parameters); }

void LiveStereo::begin(const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_base_left,
                       bool is_mounting_known) {
  estimator_ = std::make_unique<NearSceneEstimator>(parameters_, camera);
  T_base_left_ = T_base_left;
  is_mounting_known_ = is_mounting_known;
  fault_.clear();
  ++sessions_;
}

const NearScene& LiveStereo::process(const urban_nav_core::StereoPair& pair) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  std::optional<Eigen::Vector3d> up;
  if (is_mounting_known_)
    up = T_base_left_.R().transpose() * gravity_.up(pair.stamp).value_or(Eigen::Vector3d::UnitZ());
  const NearScene& scene = estimator_->process(pair, up);
  process_ms_ = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  ++pairs_;
  status_ = scene.stereo.status;
  answered_ = scene.stereo.answered;
  near_share_ = scene.near_share;
  ground_ = scene.ground.isFound() ? "found" : scene.ground.sentence;
  height_ = scene.ground.height;
  obstacles_ = scene.obstacles.size();
  return scene;
}

void LiveStereo::end(const std::string& why) {
  estimator_.reset();
  waiting_ = "no session (" + why + ")";
}

urban_nav_live::StageReport LiveStereo::report() const {
  urban_nav_live::StageReport report;
  report.status = status_;
  report.reason_name = toString(static_cast<Reason>(status_.reason));
  if (!isRunning()) {
    report.status.health = urban_nav_core::Health::Ok;  // without a pair; the warning determines the level
    report.summary = fault_.empty() ? waiting_ : fault_;
    report.is_warning = true;
  }
  report.add("answered pixels (%)", 100.0 * answered_);
  report.add("of these near (%)", 100.0 * near_share_);
  report.add("ground", ground_);
  report.add("height of the camera (m)", height_);
  report.add("points on obstacles", obstacles_);
  report.add("time of the last pair (ms)", process_ms_);
  report.add("pairs", pairs_);
  report.add("pairs without a subscriber", skipped_);
  report.add("sessions", sessions_);
  return report;
}

}  // namespace dense_stereo
