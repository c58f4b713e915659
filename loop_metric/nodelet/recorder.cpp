// SPDX-License-Identifier: BSD-3-Clause
#include "recorder.hpp"

#include <algorithm>
#include <utility>

#include "loop_metric/camera_words.hpp"
#include "urban_nav_core/sequence/time_jump.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/laser_scan.hpp"

namespace loop_metric {

using urban_nav_core::RelativePose;
using urban_nav_core::StampNs;
using urban_nav_store::Access;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

// What comes before odometry has a first step, which is a window of its frames later: 25 s of two lasers at 75 Hz.
constexpr std::size_t most_before = 4000;

}  // namespace

Recorder::Recorder(const Parameters& parameters, const NodeletParameters& nodelet, bool rectified,
                   const std::string& where, StageStore& store, Judge& judge)
    : parameters_(parameters),
      nodelet_(nodelet),
      store_(store),
      judge_(judge),
      views_(parameters, nodelet, rectified, where, transforms_) {
  mailbox_.setCapacity(static_cast<std::size_t>(nodelet.queue));
  thread_ = std::thread([this] { work(); });
}

Recorder::~Recorder() {
  mailbox_.close();
  thread_.join();
}

Recorder::State Recorder::state() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  State state = state_;
  state.dropped = mailbox_.dropped();
  return state;
}

void Recorder::work() {
  while (!mailbox_.closed()) {
    if (store_.open()) announce();
    for (Input& input : mailbox_.takeAll(std::chrono::milliseconds(100))) {
      take(input);
      if (mailbox_.closed()) break;
    }
    tell();
  }
  end();
}

void Recorder::tell() {
  now_.session = session_ ? session_->id : "";
  now_.views = views_.counts();
  now_.camera_fault = views_.fault();
  now_.camera_note = views_.note();
  now_.has_lasers = !lasers_.empty();
  now_.laser_fault.clear();
  for (const auto& [frame, laser] : lasers_)
    if (!laser.T_base_laser) now_.laser_fault = "no static tf from " + nodelet_.base_frame + " to " + frame;
  const std::lock_guard<std::mutex> lock(mutex_);
  state_ = now_;
}

void Recorder::take(Input& input) {
  if (const auto* image = std::get_if<ImageInput>(&input)) {
    if (views_.add(*image) && session_) views_are_next_ = true;
    takeViews();
  } else if (const auto* info = std::get_if<InfoInput>(&input)) {
    views_.add(info->side, info->message);
    if (!views_.camera()) camera_told_ = false;
  } else if (const auto* transforms = std::get_if<tf2_msgs::TFMessageConstPtr>(&input)) {
    transforms_.add(**transforms);
    placeLasers();
  } else if (const auto* scan = std::get_if<sensor_msgs::LaserScanConstPtr>(&input)) {
    takeScan(**scan);
  } else if (const auto* odometry = std::get_if<urban_nav_core::StampedPose>(&input)) {
    views_.hear(*odometry);
    takeViews();
  } else if (const auto* step = std::get_if<RelativePose>(&input)) {
    takeStep(*step);
  } else {
    end();
    judge_.put(Judge::End{std::get<Reset>(input).done});
  }
}

void Recorder::takeViews() {
  if (views_.camera() && !camera_told_) {
    camera_told_ = true;
    judge_.put(*views_.camera());
    announce();
  }
  for (urban_nav_store::StoredKeyframe& view : views_.take()) {
    const StampNs stamp = view.stamp;
    keep(views_are_next_, [view = std::move(view)](Store& store, const SessionId& session) {
      store.keyframes().put(session, keyframe_camera, view);
    });
    if (session_ && !views_are_next_) judge_.put(Judge::ViewKept{stamp});
  }
}

void Recorder::takeScan(const sensor_msgs::LaserScan& message) {
  const auto planar = urban_nav_ros::toPlanarScan(message);
  if (!planar) {
    ++now_.damaged_scans;
    return;
  }
  const bool is_new = lasers_.count(message.header.frame_id) == 0;
  Laser& laser = lasers_[message.header.frame_id];
  if (is_new) placeLasers();
  if (laser.newest && urban_nav_core::jumpsBack(planar->stamp, *laser.newest)) {
    laser.is_next = session_.has_value();
    laser.newest.reset();
  }
  laser.newest = std::max(laser.newest.value_or(planar->stamp), planar->stamp);
  ++now_.scans;
  keep(laser.is_next, [frame = message.header.frame_id, scan = urban_nav_core::toScan(*planar)](
                          Store& store, const SessionId& session) { store.scans().put(session, frame, scan); });
}

void Recorder::placeLasers() {
  for (auto& [frame, laser] : lasers_) {
    if (laser.T_base_laser) continue;
    laser.T_base_laser = transforms_.lookup(nodelet_.base_frame, frame);
    if (!laser.T_base_laser) continue;
    if (session_) judge_.put(LaserAt{frame, *laser.T_base_laser});
    announce();
  }
}

void Recorder::takeStep(const RelativePose& step) {
  if (!session_ || urban_nav_core::jumpsBack(step.from, heard_)) begin(step.from);
  std::vector<urban_nav_store::Node> nodes;
  std::optional<urban_nav_store::Edge> edge;
  if (!odometry_.write(session_->id, step, nodes, edge)) {
    ++now_.refused_steps;
    return;
  }
  heard_ = std::max(heard_, step.to);
  post([nodes, edge](Store& store, const SessionId& session) {
    for (const urban_nav_store::Node& node : nodes) store.graph().put(session, node);
    store.graph().put(*edge);
  });
  judge_.put(step);
}

std::optional<urban_nav_store::Session> Recorder::goesOn(StampNs start) {
  odometry_ = OdometryRows();
  if (!store_.isOpen()) return std::nullopt;
  try {
    Store store(store_.state().path, Access::Read);
    for (const Session& session : store.sessions().all()) {
      if (used_.count(session.id) > 0 || session.robot != nodelet_.robot || session.recording != nodelet_.recording)
        continue;
      if (session.start == start) return session;  // the recording is played again
      std::vector<urban_nav_store::Node> behind;
      store.graph().forEachNode(
          session.id, [&](const urban_nav_store::Node& node) { behind.push_back(node); }, start);
      if (behind.size() != 1 || behind.front().stamp != start) continue;
      odometry_.goOn(behind.front());
      return session;
    }
  } catch (const urban_nav_core::Error&) {
    // a store that cannot be read is named when it is written
  }
  return std::nullopt;
}

void Recorder::begin(StampNs start) {
  end();
  const std::optional<Session> known = goesOn(start);
  Session session;
  if (known) {
    session = *known;
    session.complete = false;
  } else {
    session.name = nodelet_.recording.empty() ? urban_nav_core::printStamp(start) : nodelet_.recording;
    session.robot = nodelet_.robot;
    session.recording = nodelet_.recording;
    session.start = start;
    session.id = urban_nav_store::sessionIdOf({session.robot, session.recording, start, ""});
    // A bag that is played again in the same process has the name and the start of the time before.
    for (int round = 2; used_.count(session.id) > 0; ++round) {
      session.recording = nodelet_.recording + " (" + std::to_string(round) + ")";
      session.id = urban_nav_store::sessionIdOf({session.robot, session.recording, start, ""});
    }
  }
  used_.insert(session.id);
  session_ = session;
  heard_ = start;
  views_are_next_ = false;
  announce();
  judge_.put(Judge::SessionBegan{session.id, known && known->start != start});
  for (auto& [frame, laser] : lasers_) {
    laser.is_next = false;
    if (laser.T_base_laser) judge_.put(LaserAt{frame, *laser.T_base_laser});
  }
  for (Write& write : std::exchange(before_, {})) post(std::move(write));
}

void Recorder::announce() {
  if (!session_) return;
  std::vector<urban_nav_store::Extrinsic> places;
  for (const auto& [frame, laser] : lasers_)
    if (laser.T_base_laser) places.push_back({frame, *laser.T_base_laser});
  std::string words;
  if (const auto& camera = views_.camera()) {
    places.push_back({keyframe_camera, camera->T_base_left});
    words = cameraWords(camera->camera, camera->T_base_left);
  }
  post([session = *session_, places, words](Store& store, const SessionId&) {
    store.sessions().put(session);
    for (const urban_nav_store::Extrinsic& place : places) store.sessions().put(session.id, place);
    if (!words.empty()) store.sessions().put(session.id, urban_nav_store::Property{camera_property, words});
  });
}

void Recorder::end() {
  if (!session_) return;
  session_->complete = true;
  announce();
  session_.reset();
}

void Recorder::keep(bool is_next, Write write) {
  if (session_ && !is_next) return post(std::move(write));
  before_.push_back(std::move(write));
  if (before_.size() <= most_before) return;
  before_.pop_front();
  ++now_.not_kept;
}

void Recorder::post(Write write) {
  store_.post([id = session_->id, write = std::move(write)](Store& store) { write(store, id); });
}

}  // namespace loop_metric
