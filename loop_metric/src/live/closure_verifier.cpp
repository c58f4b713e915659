// SPDX-License-Identifier: BSD-3-Clause
#include "live/closure_verifier.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "loop_metric/evidence.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/session/calibration_fingerprint.hpp"

namespace loop_metric {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::MetricClosure;
using urban_nav_core::PoseRef;
using urban_nav_core::StampNs;
using urban_nav_core::TopologicalClosure;
using urban_nav_registration::LaserAt;
using urban_nav_registration::MountedCamera;
using urban_nav_registration::SessionOdometry;
using urban_nav_store::Access;
using urban_nav_store::SessionId;

namespace {

constexpr std::size_t kMaxInputs = 100'000;  // over an hour of odometry at 20 Hz, while a candidate is measured
// s: odometry lags by seconds at most, so that a pose further ahead will not be reached.
constexpr double kMaxAhead = 60.0;

double secondsAfter(StampNs stamp, StampNs reference) { return 1e-9 * static_cast<double>(stamp - reference); }

/// Returns the name of a gapless part of a session in the place data.
std::string partName(const SessionId& id, std::size_t part) {
  return part == 0 ? id : id + "#" + std::to_string(part + 1);
}

SessionId sessionOfPart(const std::string& name) { return name.substr(0, name.find('#')); }

void reject(MetricClosure& metric, LoopReason reason, const std::string& sentence) {
  metric.verdict = ClosureVerdict::Rejected;
  metric.reason = static_cast<int>(reason);
  metric.reason_name = toString(reason);
  metric.sentence = sentence;
  metric.measured.information.setZero();
}

}  // namespace

ClosureVerifier::ClosureVerifier(const Parameters& parameters, double timeout, urban_nav_live::StoreWriterLink& store,
                                 Listener listener)
    : parameters_(parameters),
      timeout_(timeout),
      store_(store),
      listener_(std::move(listener)),
      proposals_(parameters.registration.voxel_size),
      loop_(kMaxInputs) {
  urban_nav_live::WorkerLoop<Input>::Steps steps;
  steps.handle = [this](Input& input) { handle(input); };
  steps.idle = [this] { return verifyNext(); };
  loop_.start("closure_verify", std::move(steps));
}

ClosureVerifier::Counts ClosureVerifier::counts() const {
  return {loop_.dropped(), waits_, stereo_, icp_, rejected_, parts_, proposed_};
}

bool ClosureVerifier::finishSession(std::chrono::milliseconds timeout) {
  return loop_
      .ask(
          [this] {
            endSession(nullptr);
            return true;
          },
          timeout)
      .value_or(false);
}

void ClosureVerifier::handle(Input& input) {
  if (const auto* step = std::get_if<urban_nav_core::RelativePose>(&input)) {
    addStep(*step);
  } else if (auto* candidate = std::get_if<Candidate>(&input)) {
    waiting_.push_back(std::move(*candidate));
    waits_ = static_cast<std::int64_t>(waiting_.size());
  } else if (const auto* started = std::get_if<SessionStarted>(&input)) {
    endSession(started);
  } else if (const auto* keyframe = std::get_if<KeyframeStored>(&input)) {
    if (!place_data_ || outdated_ || running_.empty()) return;
    for (std::size_t i = 0; i < sessions_[running_].odometry.parts().size(); ++i)
      place_data_->add({partName(running_, i), keyframe->stamp});
  } else if (const auto* laser = std::get_if<LaserAt>(&input)) {
    if (running_.empty()) return;
    sessions_[running_].lasers.push_back(*laser);
    outdated_ = true;
  } else {
    setCamera(std::get<MountedCamera>(input));
  }
}

void ClosureVerifier::setCamera(const MountedCamera& camera) {
  camera_ = camera;
  stage_.reset();
  // Conversions of other sessions depend on the camera and must be computed again.
  for (auto each = sessions_.begin(); each != sessions_.end();)
    each = each->first == running_ ? std::next(each) : sessions_.erase(each);
  if (!running_.empty()) sessions_[running_].has_camera = true, sessions_[running_].conversion = nullptr;
  outdated_ = true;
}

void ClosureVerifier::addStep(const urban_nav_core::RelativePose& step) {
  last_step_ = Clock::now();
  if (running_.empty()) return;
  SessionOdometry& odometry = sessions_[running_].odometry;
  const std::size_t parts = odometry.parts().size();
  odometry.add(step);
  if (odometry.parts().size() == parts) return;
  outdated_ = true;
  parts_ = static_cast<std::int64_t>(odometry.parts().size());
}

void ClosureVerifier::endSession(const SessionStarted* next) {
  while (!loop_.isStopping() && proposeNext(true)) {
  }
  while (!running_.empty() && !waiting_.empty() && !loop_.isStopping()) {
    const Candidate candidate = waiting_.front();
    waiting_.pop_front();
    verify(candidate, next != nullptr);
  }
  waits_ = static_cast<std::int64_t>(waiting_.size());
  proposals_.nameRunning(running_);
  running_.clear();
  if (next == nullptr) return;
  if (next->continues) load(next->id);
  else sessions_.erase(next->id);
  running_ = next->id;
  KnownSession& session = sessions_[running_];
  session.id = running_;
  session.has_camera = camera_.has_value();
  session.conversion = nullptr;
  session.lasers.clear();  // reported again by the recorder
  outdated_ = true;
  last_step_ = Clock::now();
}

/// Place recognition may refer to the next session before its odometry arrives here.
bool ClosureVerifier::isKnown(const PoseRef& at) {
  if (at.session.empty() || sessions_.count(at.session) > 0) return true;
  try {
    return reader_ && reader_->sessions().find(at.session);
  } catch (const urban_nav_core::Error&) {
    return true;  // reported when the candidate is measured
  }
}

/// A candidate is due if neither pose is of the running session, or if the robot has driven on from the later pose by
/// the extent of a cloud (of the keyframe search, without lasers) or has had the time for it, or if odometry has ended.
bool ClosureVerifier::isDue(const Candidate& candidate) {
  StampNs later = 0;
  for (const PoseRef* at : {&candidate.closure.a, &candidate.closure.b})
    if (at->session.empty() || at->session == running_) later = std::max(later, at->stamp);
  const bool is_known = isKnown(candidate.closure.a) && isKnown(candidate.closure.b);
  if (later == 0 && is_known) return true;
  if (Clock::now() - std::max(last_step_, candidate.received) >= timeout_) return true;
  if (!is_known) return false;
  const auto session = sessions_.find(running_);
  if (session == sessions_.end() || session->second.odometry.empty()) return false;
  const StampNs newest = session->second.odometry.newest();
  if (secondsAfter(newest, later) >= timeout_.count() || secondsAfter(later, newest) > kMaxAhead) return true;
  if (newest < later) return false;
  const bool clouds = parameters_.icp && !session->second.lasers.empty();
  const urban_nav_core::OdometryChain& odometry = *session->second.odometry.parts().back();
  return odometry.distance(newest) - odometry.distance(later) >=
         (clouds ? parameters_.registration.cloud_half_length : parameters_.keyframe_search_distance);
}

bool ClosureVerifier::verifyNext() {
  openReader();
  const auto due =
      std::find_if(waiting_.begin(), waiting_.end(), [this](const Candidate& each) { return isDue(each); });
  if (due == waiting_.end()) return proposeNext();
  const Candidate candidate = *due;
  waiting_.erase(due);
  waits_ = static_cast<std::int64_t>(waiting_.size());
  verify(candidate, false);
  return true;
}

void ClosureVerifier::verify(const Candidate& candidate, bool by_id) {
  const Clock::time_point begin = Clock::now();
  CandidateMeasurement measurement;
  try {
    measurement = measure(candidate.closure);
    if (place_data_) checks_.apply(measurement.metric, *place_data_, parameters_);
  } catch (const urban_nav_core::Error& error) {  // data of this place is damaged or cannot be read
    measurement.metric = {};
    measurement.metric.probability = candidate.closure.probability;
    measurement.metric.source = "loop_metric";
    reject(measurement.metric, LoopReason::NothingKept, error.what());
  }
  report(candidate, measurement, by_id, begin);
}

/// Reports poses by the frames of odometry, and sessions by the names in the candidate: a pose without a name belongs
/// to the running session, irrespective of its id.
void ClosureVerifier::report(const Candidate& candidate, CandidateMeasurement& measurement, bool by_id,
                             Clock::time_point begin) {
  MetricClosure& reported = measurement.metric;
  for (const auto& [at, asked] :
       {std::pair(&reported.a, &candidate.closure.a), std::pair(&reported.b, &candidate.closure.b)}) {
    if (at->stamp == 0) at->stamp = asked->stamp;
    at->session = asked->session.empty() && by_id ? running_ : asked->session;
  }
  for (StereoAttempt& each : measurement.attempts.stereo) {
    restoreName(each.keyframe_a.at);
    restoreName(each.keyframe_b.at);
  }
  if (!reported.evidence.empty()) reported.evidence = printEvidence(collectEvidence(measurement));
  if (reported.verdict == ClosureVerdict::Rejected) ++rejected_;
  else ++(reported.method == ClosureMethod::Stereo ? stereo_ : icp_);
  const auto keyframe = [this](const PoseRef& at) {
    return place_data_ ? place_data_->keyframe(resolve(at)) : urban_nav_registration::Keyframe();
  };
  const auto cloud = [this](const PoseRef& at) {
    return place_data_ ? place_data_->cloud(resolve(at), parameters_.registration.cloud_half_length)
                       : urban_nav_core::PointCloud();
  };
  listener_({std::move(reported), measurement.attempts, keyframe, cloud,
             std::chrono::duration<double, std::milli>(Clock::now() - begin).count()});
}

/// Keyframes of pending writes are announced but cannot be read yet. During a fault of the store, and once after it,
/// the contents are read again and results of missing keyframes are dropped.
void ClosureVerifier::followStore() {
  store_.flush();
  std::string fault = store_.state().fault;
  if (!fault.empty() || !store_fault_.empty()) {
    stage_.reset();
    outdated_ = true;
  }
  store_fault_ = std::move(fault);
}

CandidateMeasurement ClosureVerifier::measure(const TopologicalClosure& closure) {
  followStore();
  TopologicalClosure candidate{resolve(closure.a), resolve(closure.b), closure.probability};
  CandidateMeasurement result;
  result.metric.a = candidate.a;
  result.metric.b = candidate.b;
  result.metric.probability = candidate.probability;
  result.metric.source = "loop_metric";
  if (!reader_) {
    reject(result.metric, LoopReason::NothingKept,
           "no stored data: " + (store_fault_.empty() ? "no store yet" : store_fault_));
    return result;
  }
  if (running_.empty() && (closure.a.session.empty() || closure.b.session.empty())) {
    reject(result.metric, LoopReason::UnknownMoment, "no odometry received: no session is being recorded");
    return result;
  }
  if (outdated_) renewPlaceData();
  result = stage_->measure(candidate, *place_data_);
  if (!store_fault_.empty() && result.metric.verdict == ClosureVerdict::Rejected)
    result.metric.sentence += "; the latest data is not in the store: " + store_fault_;
  return result;
}

bool ClosureVerifier::proposesByClouds() const {
  if (camera_ || !parameters_.icp || running_.empty()) return false;
  const auto& lasers = sessions_.at(running_).lasers;
  return std::any_of(lasers.begin(), lasers.end(), [](const LaserAt& laser) { return laser.is_lidar; });
}

bool ClosureVerifier::proposeNext(bool ended) {
  if (!reader_ || !proposesByClouds()) return false;
  if (!std::exchange(are_stored_followed_, true))
    for (const urban_nav_store::Session& session : reader_->sessions().all()) {
      if (session.id == running_) continue;
      if (sessions_.count(session.id) == 0) load(session.id);
      for (const auto& part : sessions_[session.id].odometry.parts())
        proposals_.follow(session.id + std::to_string(part->trajectory().front().stamp), {session.id, 0}, *part, true,
                          true);
    }
  for (const auto& part : sessions_[running_].odometry.parts())
    proposals_.follow(running_ + std::to_string(part->trajectory().front().stamp), {}, *part, false,
                      ended || part != sessions_[running_].odometry.parts().back());
  const auto place = proposals_.next();
  if (!place) return false;
  followStore();
  if (outdated_) renewPlaceData();
  for (const TopologicalClosure& closure : proposals_.describe(
           *place, place_data_->cloud(resolve(place->at), urban_nav_registration::CloudPlaces::kHalfLength))) {
    ++proposed_;
    waiting_.push_back({closure, Clock::now()});
  }
  waits_ = static_cast<std::int64_t>(waiting_.size());
  return true;
}

void ClosureVerifier::openReader() {
  if (reader_ || !store_.isOpen()) return;
  reader_.emplace(store_.path(), Access::Read);
  beams_.emplace(*reader_);
}

PoseRef ClosureVerifier::resolve(const PoseRef& at) {
  openReader();
  const SessionId id = at.session.empty() ? running_ : at.session;
  if (!id.empty() && sessions_.count(id) == 0) load(id);
  const auto found = sessions_.find(id);
  if (found == sessions_.end() || found->second.odometry.empty()) return {id, at.stamp};
  const SessionOdometry& odometry = found->second.odometry;
  const std::size_t part = odometry.partAt(at.stamp);
  const auto moment = odometry.parts()[part]->nearestFrame(at.stamp);
  return {partName(id, part), moment ? moment->frame : at.stamp};
}

void ClosureVerifier::restoreName(PoseRef& at) const {
  at.session = sessionOfPart(at.session);
  if (at.session == running_) at.session.clear();
}

void ClosureVerifier::load(const SessionId& id) {
  openReader();
  if (!reader_ || !reader_->sessions().find(id)) return;
  KnownSession session;
  session.id = id;
  session.odometry = urban_nav_registration::readOdometry(*reader_, id);
  for (const urban_nav_store::Property& property : reader_->sessions().properties(id))
    if (camera_ && property.name == urban_nav_registration::kCalibrationProperty)
      session.conversion = urban_nav_registration::findConversion(property.value, *camera_, session.has_camera);
  session.lasers = urban_nav_registration::storedBeamSources(*reader_, id);
  sessions_[id] = std::move(session);
  outdated_ = true;
}

void ClosureVerifier::renewPlaceData() {
  StoredPlaceData::Sessions sessions;
  for (const auto& [id, known] : sessions_)
    for (std::size_t i = 0; i < known.odometry.parts().size(); ++i)
      sessions[partName(id, i)] = {id, known.odometry.parts()[i], known.lasers, known.has_camera, known.conversion};
  place_data_ = std::make_unique<StoredPlaceData>(std::move(sessions), reader_->keyframes(), *beams_);
  if (!stage_) {
    Parameters parameters = parameters_;
    parameters.stereo = parameters.stereo && camera_;
    const MountedCamera camera = camera_.value_or(MountedCamera());
    stage_ = std::make_unique<LoopMetric>(parameters, camera.camera, camera.T_base_left);
  }
  outdated_ = false;
}

}  // namespace loop_metric
