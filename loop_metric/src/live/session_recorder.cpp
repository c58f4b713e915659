// SPDX-License-Identifier: BSD-3-Clause
#include "live/session_recorder.hpp"

#include <algorithm>
#include <utility>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/session/calibration_fingerprint.hpp"
#include "urban_nav_registration/session/stored_keyframe.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/lidar_sweep.hpp"
#include "urban_nav_store/tables/mounted_lidar.hpp"

namespace loop_metric {

using urban_nav_core::SessionStep;
using urban_nav_core::StampNs;
using urban_nav_live::SessionNamer;
using urban_nav_registration::kKeyframeCamera;
using urban_nav_registration::LaserAt;
using urban_nav_store::Access;
using urban_nav_store::LidarSweep;
using urban_nav_store::MountedLidar;
using urban_nav_store::Node;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

// Data received before the first step of odometry, which is delayed by a window of frames: 25 s of two lasers at 75 Hz.
constexpr std::size_t kMaxWritesBefore = 4000;

}  // namespace

SessionRecorder::SessionRecorder(const urban_nav_registration::Parameters& parameters, Options options,
                                 urban_nav_live::StoreWriterLink& store, ClosureVerifier& verifier)
    : options_(std::move(options)), store_(store), verifier_(verifier), builder_(parameters), namer_(options_.robot) {}

SessionRecorder::State SessionRecorder::state() const {
  return {session_ ? session_->id : "", builder_.counts(), scans_, refused_steps_, sweeps_, not_stored_};
}

void SessionRecorder::setCamera(const std::optional<urban_nav_registration::MountedCamera>& camera) {
  if (!camera) return builder_.clearCamera();
  builder_.setCamera(*camera);
  const std::string fingerprint = urban_nav_registration::calibrationFingerprint(camera->camera, camera->T_base_left);
  if (fingerprint == camera_) return;
  camera_ = fingerprint;
  verifier_.push(*camera);
  storeSession();
}

void SessionRecorder::restartImages() {
  storeKeyframes();
  builder_.restart();
  odometry_time_.reset();
  images_are_next_ = session_.has_value();
}

void SessionRecorder::addPair(urban_nav_core::StereoPairWithMotion pair) {
  builder_.addPair(std::move(pair));
  storeKeyframes();
}

void SessionRecorder::addOdometry(const urban_nav_core::StampedPose& T_odom_base) {
  if (odometry_time_.add(T_odom_base.stamp)) builder_.restartOdometry();
  builder_.addOdometry(T_odom_base);
  T_odom_base_ = T_odom_base.pose;
  storeKeyframes();
}

void SessionRecorder::storeKeyframes() {
  for (const urban_nav_registration::Keyframe& keyframe : builder_.take()) {
    store(images_are_next_, [stored = toStoredKeyframe(keyframe)](Store& file, const SessionId& session) {
      file.keyframes().put(session, kKeyframeCamera, stored);
    });
    if (session_ && !images_are_next_) verifier_.push(ClosureVerifier::KeyframeStored{keyframe.at.stamp});
  }
}

void SessionRecorder::addScan(const std::string& frame, const urban_nav_core::Scan& scan) {
  Laser& laser = lasers_[frame];
  if (laser.time.add(scan.stamp)) laser.is_next = session_.has_value();
  ++scans_;
  store(laser.is_next,
        [frame, scan](Store& file, const SessionId& session) { file.scans().put(session, frame, scan); });
}

void SessionRecorder::addSweep(const std::string& frame, const urban_nav_core::Sweep& sweep) {
  Laser& laser = lasers_[frame];
  if (laser.role.empty())
    laser.role = "points" + std::to_string(std::count_if(lasers_.begin(), lasers_.end(),
                                                         [](const auto& each) { return !each.second.role.empty(); }));
  if (laser.time.add(sweep.reference)) laser.is_next = session_.has_value();
  if (!laser.spacing.takes(sweep.reference, T_odom_base_)) return;
  ++sweeps_;
  store(laser.is_next, [row = LidarSweep{"", laser.role, sweep.reference, LidarSweep::pack(sweep)}](
                           Store& file, const SessionId& session) mutable {
    row.session = session;
    urban_nav_store::TableStore<LidarSweep>(file).put(row);
  });
}

void SessionRecorder::setLaser(const std::string& frame, const urban_nav_core::Pose& T_base_laser) {
  const auto laser = lasers_.find(frame);
  if (laser == lasers_.end() || laser->second.T_base_laser) return;
  laser->second.T_base_laser = T_base_laser;
  if (session_) verifier_.push(LaserAt{storedName(frame, laser->second), T_base_laser, 0, !laser->second.role.empty()});
  storeSession();
}

std::vector<std::string> SessionRecorder::unplacedLasers() const {
  std::vector<std::string> frames;
  for (const auto& [frame, laser] : lasers_)
    if (!laser.T_base_laser) frames.push_back(frame);
  return frames;
}

void SessionRecorder::addStep(const SessionStep& step) {
  const bool is_next = step.session ? step.session->id != announced_ : step_time_.jumpsBack(step.from);
  if (!session_ || is_next) begin(step);
  std::vector<Node> nodes;
  std::optional<urban_nav_store::Edge> edge;
  if (!odometry_.write(session_->id, step, nodes, edge)) {
    ++refused_steps_;
    return;
  }
  step_time_.advance(step.to);
  post([nodes, edge](Store& file, const SessionId& session) {
    for (const Node& node : nodes) file.graph().put(session, node);
    file.graph().put(*edge);
  });
  verifier_.push(static_cast<const urban_nav_core::RelativePose&>(step));
}

SessionNamer::Named SessionRecorder::nameSession(const SessionStep& first) {
  odometry_ = OdometryRows();
  const StampNs start = first.from;
  const auto name = [&](const std::vector<Session>& stored, const SessionNamer::EndsAt& endsAt) {
    if (!first.session) return namer_.begin(options_.recording, start, stored, endsAt);
    SessionNamer::Named named = namer_.follow(*first.session, stored);
    named.continues = named.resumed && start > named.session.start;
    if (named.continues) endsAt(named.session, start);
    return named;
  };
  if (!store_.isOpen()) return name({}, {});
  try {
    Store file(store_.path(), Access::Read);
    const auto endsAt = [&](const Session& session, StampNs stamp) {
      std::vector<Node> later;
      file.graph().forEachNode(
          session.id, [&](const Node& node) { later.push_back(node); }, stamp);
      if (later.size() != 1 || later.front().stamp != stamp) return false;
      odometry_.continueFrom(later.front());
      return true;
    };
    return name(file.sessions().all(), endsAt);
  } catch (const urban_nav_core::Error&) {
    return name({}, {});  // an unreadable store is reported when it is written
  }
}

void SessionRecorder::begin(const SessionStep& first) {
  end();
  const SessionNamer::Named named = nameSession(first);
  session_ = named.session;
  announced_ = urban_nav_core::sessionId(first.session);
  step_time_.reset();
  step_time_.advance(first.from);
  images_are_next_ = false;
  storeSession();
  verifier_.push(ClosureVerifier::SessionStarted{session_->id, named.continues});
  for (auto& [frame, laser] : lasers_) {
    laser.is_next = false;
    if (laser.T_base_laser)
      verifier_.push(LaserAt{storedName(frame, laser), *laser.T_base_laser, 0, !laser.role.empty()});
  }
  for (Write& write : std::exchange(before_, {})) post(std::move(write));
}

void SessionRecorder::storeSession() {
  if (!session_) return;
  std::vector<urban_nav_store::Extrinsic> extrinsics;
  std::vector<MountedLidar> lidars;
  for (const auto& [frame, laser] : lasers_) {
    if (!laser.T_base_laser) continue;
    if (laser.role.empty()) extrinsics.push_back({frame, *laser.T_base_laser});
    else lidars.push_back({session_->id, laser.role, frame, *laser.T_base_laser});
  }
  std::string fingerprint;
  if (const auto& camera = builder_.camera()) {
    extrinsics.push_back({kKeyframeCamera, camera->T_base_left});
    fingerprint = camera_;
  }
  post([session = *session_, extrinsics, lidars, fingerprint](Store& file, const SessionId&) {
    file.sessions().put(session);
    for (const MountedLidar& lidar : lidars) urban_nav_store::TableStore<MountedLidar>(file).put(lidar);
    for (const urban_nav_store::Extrinsic& extrinsic : extrinsics) file.sessions().put(session.id, extrinsic);
    if (fingerprint.empty()) return;
    file.sessions().put(session.id,
                        urban_nav_store::Property{urban_nav_registration::kCalibrationProperty, fingerprint});
  });
}

void SessionRecorder::idle() {
  if (store_.open()) storeSession();
}

void SessionRecorder::end() {
  if (!session_) return;
  session_->complete = true;
  storeSession();
  session_.reset();
}

void SessionRecorder::store(bool is_next, Write write) {
  if (session_ && !is_next) return post(std::move(write));
  before_.push_back(std::move(write));
  if (before_.size() <= kMaxWritesBefore) return;
  before_.pop_front();
  ++not_stored_;
}

void SessionRecorder::post(Write write) {
  store_.post([id = session_->id, write = std::move(write)](Store& file) { write(file, id); });
}

}  // namespace loop_metric
