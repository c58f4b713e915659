// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_localiser.hpp"

#include <chrono>
#include <utility>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/cloud/local_cloud.hpp"
#include "urban_nav_registration/session/calibration_fingerprint.hpp"

namespace urban_nav_localization {

using urban_nav_core::Error;
using urban_nav_core::RelativePose;
using urban_nav_core::StampedPose;
using urban_nav_core::StampNs;
using urban_nav_registration::Keyframe;

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMaxOdometry = 1000;
// Keyframes that wait for smoothed odometry, or for the map to be read: a hundred metres of driving, 7 MB.
constexpr std::size_t kMaxWaiting = 100;

double millisecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

}  // namespace

LiveLocaliser::LiveLocaliser(const Parameters& parameters, urban_nav_store::Store store, FrozenMap map,
                             urban_nav_registration::KeyframeRetrievalFactory make_retrieval, Listener listener)
    : parameters_(parameters),
      store_(std::move(store)),
      map_(std::move(map)),
      make_retrieval_(std::move(make_retrieval)),
      listener_(std::move(listener)),
      builder_(parameters.registration),
      localiser_(parameters),
      needs_clouds_(parameters.icp) {}

LiveLocaliser::State LiveLocaliser::state() const {
  State state = state_;
  state.keyframes = builder_.counts();
  state.map_keyframes = search_ ? search_->views() : 0;
  state.map_keyframes_read = search_ ? search_->read() : 0;
  state.map_places = clouds_ ? clouds_->places() : 0;
  state.map_places_read = clouds_ ? clouds_->read() : 0;
  return state;
}

void LiveLocaliser::setCamera(const std::optional<urban_nav_registration::MountedCamera>& camera) {
  if (!camera) return builder_.clearCamera();
  builder_.setCamera(*camera);
  const std::string fingerprint = urban_nav_registration::calibrationFingerprint(camera->camera, camera->T_base_left);
  if (search_ && fingerprint == camera_) return;
  if (!map_.hasKeyframes()) return;  // its clouds are searched
  camera_ = fingerprint;
  search_.reset();
  state_.map_fault.clear();
  try {
    search_ = std::make_unique<MapSearch>(parameters_, map_, store_, *camera, make_retrieval_());
  } catch (const Error& error) {
    state_.map_fault = error.what();
  }
}

void LiveLocaliser::restartImages() {
  builder_.restart();
  waiting_.clear();
}

void LiveLocaliser::addPair(urban_nav_core::StereoPairWithMotion pair) {
  builder_.addPair(std::move(pair));
  takeKeyframes();
}

void LiveLocaliser::addOdometry(const StampedPose& T_odom_base) {
  if (odometry_time_.add(T_odom_base.stamp)) {
    builder_.restartOdometry();
    odometry_.clear();
  }
  builder_.addOdometry(T_odom_base);
  odometry_.push_back(T_odom_base);
  if (odometry_.size() > kMaxOdometry) odometry_.pop_front();
  takeKeyframes();
}

void LiveLocaliser::addScan(const std::string& frame, const urban_nav_core::Scan& scan) {
  scans_.add(frame, scan);
  ++state_.scans;
}

void LiveLocaliser::addSweep(const std::string& frame, const urban_nav_core::Sweep& sweep) {
  const std::optional<urban_nav_core::Pose> now =
      odometry_.empty() ? std::nullopt : std::optional(odometry_.back().pose);
  sweeps_.add(frame, sweep, now);
  ++state_.sweeps;
}

std::vector<std::string> LiveLocaliser::unplacedLasers() const {
  std::vector<std::string> frames = scans_.unplaced();
  for (const std::string& frame : sweeps_.unplaced()) frames.push_back(frame);
  return frames;
}

void LiveLocaliser::takeKeyframes() {
  for (Keyframe& keyframe : builder_.take()) {
    waiting_.push_back(std::move(keyframe));
    if (waiting_.size() <= kMaxWaiting) continue;
    waiting_.pop_front();
    ++state_.dropped_keyframes;
  }
}

void LiveLocaliser::restart() {
  forget();
  state_.estimate.stamp = reached_.value_or(0);
  reached_.reset();
  listener_(state_.estimate, T_map_odom_);
}

void LiveLocaliser::forget() {
  localiser_ = Localiser(parameters_);
  waiting_.clear();
  initial_pose_.reset();
  T_map_odom_.reset();
  state_.estimate = LocalizationEstimate();
  ++state_.restarts;
}

void LiveLocaliser::addStep(const RelativePose& step) {
  // Without the steps in between the motion from one to the other is unknown.
  if (reached_ && (step.from > *reached_ || urban_nav_core::jumpsBack(step.to, *reached_))) {
    forget();
    reached_.reset();
  }
  if (!localiser_.addOdometry(step)) {
    ++state_.refused_steps;
    return;
  }
  reached_ = step.to;
  applyInitialPose();
  while (!odometry_.empty() && odometry_.front().stamp < step.to) odometry_.pop_front();
  publishEstimate();
}

void LiveLocaliser::publishEstimate() {
  const LocalizationEstimate& estimate = state_.estimate = localiser_.at(*reached_);
  if (estimate.state == LocalizationState::Localized && !odometry_.empty() && odometry_.front().stamp == *reached_)
    T_map_odom_ = estimate.T_map_base->pose * odometry_.front().pose.inverse();
  listener_(estimate, T_map_odom_);
}

void LiveLocaliser::publishIfChanged() {
  if (!reached_) return;
  const LocalizationEstimate now = localiser_.at(*reached_);
  const LocalizationEstimate& last = state_.estimate;
  if (now.state != last.state || now.reason != last.reason || now.supporting_matches != last.supporting_matches)
    publishEstimate();
}

void LiveLocaliser::addInitialPose(const InitialPose& initial_pose) {
  ++state_.initial_poses;
  initial_pose_ = initial_pose;
  if (applyInitialPose()) publishEstimate();
}

bool LiveLocaliser::applyInitialPose() {
  if (!initial_pose_ || !reached_) return false;
  const StampNs stamp = initial_pose_->stamp, newest = odometry_.empty() ? *reached_ : odometry_.back().stamp;
  if (stamp > *reached_ && stamp <= newest) return false;  // smoothed odometry is about to reach it
  localiser_.addInitialPose(stamp > newest || stamp == 0 ? *reached_ : stamp, initial_pose_->T_map_base);
  initial_pose_.reset();
  return true;
}

bool LiveLocaliser::work() {
  try {
    if (std::exchange(needs_clouds_, false)) clouds_ = std::make_unique<CloudSearch>(parameters_, map_, store_);
    if (search_ && search_->read() < search_->views()) {
      search_->readNext();
      return true;
    }
    if (queryKeyframe()) return true;
    if (clouds_ && state_.scans + state_.sweeps > 0 && clouds_->read() < clouds_->places()) {
      clouds_->readNext();
      return true;
    }
    return queryCloud();
  } catch (const Error& error) {  // the store is damaged
    state_.map_fault = error.what();
    search_.reset();
    clouds_.reset();
    return false;
  }
}

bool LiveLocaliser::queryKeyframe() {
  if (!search_ || waiting_.empty() || !reached_ || waiting_.front().at.stamp > *reached_) return false;
  const Keyframe keyframe = std::move(waiting_.front());
  waiting_.pop_front();
  const Clock::time_point begin = Clock::now();
  ++state_.queries;
  if (search_->query(keyframe, localiser_)) ++state_.matches;
  state_.query_ms = millisecondsSince(begin);
  publishIfChanged();
  return true;
}

bool LiveLocaliser::queryCloud() {
  if (!clouds_ || state_.scans + state_.sweeps == 0) return false;
  const auto stretch = clouds_->due(localiser_, sweeps_.any() ? BeamSources::Lidars : BeamSources::PlanarLasers);
  if (!stretch) return false;
  const Clock::time_point begin = Clock::now();
  const urban_nav_core::OdometryChain& odometry = localiser_.odometry();
  std::vector<urban_nav_registration::LaserScans> lasers = scans_.lasers();
  for (urban_nav_registration::LaserScans& lidar : sweeps_.lidars()) lasers.push_back(std::move(lidar));
  const auto cloud = urban_nav_registration::localCloud(odometry, stretch->at, stretch->way, lasers);
  const double sigma = urban_nav_registration::deformationSigma(odometry, stretch->at, stretch->way);
  ++state_.cloud_queries;
  if (clouds_->query(*stretch, cloud, sigma, localiser_)) ++state_.cloud_matches;
  else if (!search_) clouds_->addMiss(*stretch, localiser_);
  state_.cloud_query_ms = millisecondsSince(begin);
  publishIfChanged();
  return true;
}

}  // namespace urban_nav_localization
