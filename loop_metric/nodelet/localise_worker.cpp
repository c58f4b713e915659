// SPDX-License-Identifier: BSD-3-Clause
#include "localise_worker.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "loop_metric/stored_surroundings.hpp"
#include "urban_nav_core/sequence/time_jump.hpp"
#include "urban_nav_core/types/error.hpp"

namespace loop_metric {

using urban_nav_core::Pose;
using urban_nav_core::RelativePose;
using urban_nav_core::StampedPose;
using urban_nav_core::StampNs;

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t most_poses = 1000;
// Views that wait for odometry to settle, or for the map to be read: a hundred metres of driving, 7 MB.
constexpr std::size_t most_waiting = 100;

double millisecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

}  // namespace

LocaliseWorker::LocaliseWorker(const Parameters& parameters, const LocalisationParameters& nodelet, bool rectified,
                               const std::string& where, urban_nav_store::Store store, FrozenMap map, Listener listener)
    : parameters_(parameters),
      store_(std::move(store)),
      map_(std::move(map)),
      listener_(std::move(listener)),
      views_(parameters, nodelet, rectified, where, transforms_),
      scans_(nodelet.base_frame, transforms_),
      localiser_(parameters) {
  mailbox_.setCapacity(static_cast<std::size_t>(nodelet.queue));
  thread_ = std::thread([this] { work(); });
}

LocaliseWorker::~LocaliseWorker() {
  mailbox_.close();
  thread_.join();
}

LocaliseWorker::State LocaliseWorker::state() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  State state = state_;
  state.dropped = mailbox_.dropped();
  return state;
}

void LocaliseWorker::tell() {
  now_.views = views_.counts();
  now_.camera_fault = views_.fault();
  now_.camera_note = views_.note();
  now_.map_views = search_ ? search_->views() : 0;
  now_.map_views_read = search_ ? search_->read() : 0;
  now_.map_places = clouds_ ? clouds_->places() : 0;
  now_.map_places_read = clouds_ ? clouds_->read() : 0;
  const std::string unplaced = scans_.unplaced();
  now_.laser_fault = unplaced.empty() ? "" : "no static tf from the robot to " + unplaced;
  const std::lock_guard<std::mutex> lock(mutex_);
  state_ = now_;
}

void LocaliseWorker::work() {
  bool busy = false;
  try {
    if (parameters_.icp) clouds_ = std::make_unique<CloudSearch>(parameters_, map_, store_);
  } catch (const urban_nav_core::Error& error) {
    now_.map_fault = error.what();
  }
  while (!mailbox_.closed()) {
    for (Input& input : mailbox_.takeAll(std::chrono::milliseconds(busy ? 0 : 100))) {
      take(input);
      if (mailbox_.closed()) return;
    }
    busy = searchOn();
    tell();
  }
}

void LocaliseWorker::take(Input& input) {
  if (const auto* image = std::get_if<ImageInput>(&input)) {
    if (views_.add(*image)) waiting_.clear();
    takeViews();
  } else if (const auto* info = std::get_if<InfoInput>(&input)) {
    views_.add(info->side, info->message);
    if (!views_.camera()) camera_seen_ = false;
  } else if (const auto* transforms = std::get_if<tf2_msgs::TFMessageConstPtr>(&input)) {
    transforms_.add(**transforms);
  } else if (const auto* scan = std::get_if<sensor_msgs::LaserScanConstPtr>(&input)) {
    ++(scans_.add(**scan) ? now_.scans : now_.damaged_scans);
  } else if (const auto* odometry = std::get_if<StampedPose>(&input)) {
    hear(*odometry);
    takeViews();
  } else if (const auto* step = std::get_if<RelativePose>(&input)) {
    takeStep(*step);
  } else if (const auto* belief = std::get_if<Belief>(&input)) {
    ++now_.beliefs;
    belief_ = *belief;
    believe();
  } else {
    beginAnew();
  }
}

void LocaliseWorker::hear(const StampedPose& odometry) {
  views_.hear(odometry);
  if (!odometry_.empty() && urban_nav_core::jumpsBack(odometry.stamp, odometry_.back().stamp)) odometry_.clear();
  odometry_.push_back(odometry);
  if (odometry_.size() > most_poses) odometry_.pop_front();
}

void LocaliseWorker::beginAnew() {
  localiser_ = Localiser(parameters_);
  reached_.reset();
  waiting_.clear();
  belief_.reset();
  T_map_odom_.reset();
  now_.located = Located();
  ++now_.begun_anew;
}

void LocaliseWorker::takeStep(const RelativePose& step) {
  // Without the steps in between, nobody knows how the robot came from one to the other.
  if (reached_ && (step.from > *reached_ || urban_nav_core::jumpsBack(step.to, *reached_))) beginAnew();
  if (!localiser_.addOdometry(step)) {
    ++now_.refused_steps;
    return;
  }
  reached_ = step.to;
  believe();
  now_.located = localiser_.at(step.to);
  while (!odometry_.empty() && odometry_.front().stamp < step.to) odometry_.pop_front();
  if (now_.located.knowledge == Knowledge::Known && !odometry_.empty() && odometry_.front().stamp == step.to)
    T_map_odom_ = now_.located.T_map_base->pose * odometry_.front().pose.inverse();
  listener_(now_.located, T_map_odom_);
}

void LocaliseWorker::believe() {
  if (!belief_ || !reached_) return;
  const StampNs newest = odometry_.empty() ? *reached_ : odometry_.back().stamp;
  if (belief_->stamp > *reached_ && belief_->stamp <= newest) return;  // odometry is about to settle there
  localiser_.addBelief(belief_->stamp > newest || belief_->stamp == 0 ? *reached_ : belief_->stamp,
                       belief_->T_map_base);
  belief_.reset();
}

void LocaliseWorker::makeSearch() {
  camera_seen_ = true;
  search_.reset();
  now_.map_fault.clear();
  try {
    search_ = std::make_unique<MapSearch>(parameters_, map_, store_.keyframes(), views_.camera()->camera,
                                          views_.camera()->T_base_left);
  } catch (const urban_nav_core::Error& error) {
    now_.map_fault = error.what();
  }
}

void LocaliseWorker::takeViews() {
  if (views_.camera() && !camera_seen_) makeSearch();
  for (const urban_nav_store::StoredKeyframe& view : views_.take()) {
    waiting_.push_back(keyframeOf(view, ""));
    if (waiting_.size() <= most_waiting) continue;
    waiting_.pop_front();
    ++now_.dropped_views;
  }
}

bool LocaliseWorker::searchOn() {
  try {
    if (search_ && search_->read() < search_->views()) {
      search_->readNext();
      return true;
    }
    if (lookForView()) return true;
    if (clouds_ && now_.scans > 0 && clouds_->read() < clouds_->places()) {
      clouds_->readNext();
      return true;
    }
    return lookForCloud();
  } catch (const urban_nav_core::Error& error) {  // what the store holds is damaged
    now_.map_fault = error.what();
    search_.reset();
    clouds_.reset();
    return false;
  }
}

bool LocaliseWorker::lookForView() {
  if (!search_ || waiting_.empty() || !reached_ || waiting_.front().at.stamp > *reached_) return false;
  const Keyframe view = std::move(waiting_.front());
  waiting_.pop_front();
  const Clock::time_point begin = Clock::now();
  ++now_.looks;
  if (search_->look(view, localiser_)) ++now_.sightings;
  now_.look_ms = millisecondsSince(begin);
  return true;
}

bool LocaliseWorker::lookForCloud() {
  if (!clouds_ || now_.scans == 0) return false;
  const auto stretch = clouds_->due(localiser_);
  if (!stretch) return false;
  const Clock::time_point begin = Clock::now();
  const urban_nav_core::OdometryChain& odometry = localiser_.odometry();
  const auto cloud = localCloud(odometry, stretch->at, stretch->way, scans_.lasers());
  ++now_.cloud_looks;
  if (clouds_->look(*stretch, cloud, bendOf(odometry, stretch->at, stretch->way), localiser_)) ++now_.cloud_sightings;
  now_.cloud_look_ms = millisecondsSince(begin);
  return true;
}

}  // namespace loop_metric
