// SPDX-License-Identifier: BSD-3-Clause
#include "judge.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "loop_metric/camera_words.hpp"
#include "loop_metric/consistency.hpp"
#include "loop_metric/evidence.hpp"
#include "loop_metric/shared_clouds.hpp"
#include "urban_nav_core/types/error.hpp"

namespace loop_metric {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::MetricClosure;
using urban_nav_core::PoseRef;
using urban_nav_core::StampNs;
using urban_nav_core::TopologicalClosure;
using urban_nav_store::Access;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

constexpr std::size_t most_messages = 100'000;  // over an hour of odometry at 20 Hz, while a candidate is measured
// A moment that odometry will not reach in this time will not come: odometry is seconds behind at most.
constexpr double longest_ahead = 60.0;  // s
// What is accepted is held against closures whose ends lie so near in time, as consistency.hpp does.
constexpr double neighbour_time = 120.0;  // s

double secondsAfter(StampNs stamp, StampNs reference) { return 1e-9 * static_cast<double>(stamp - reference); }

/// Under which name Surroundings know a part of a session.
std::string nameOf(const SessionId& id, std::size_t part) {
  return part == 0 ? id : id + "#" + std::to_string(part + 1);
}

SessionId sessionOf(const std::string& name) { return name.substr(0, name.find('#')); }

void refuse(MetricClosure& metric, LoopReason reason, const std::string& sentence) {
  metric.verdict = ClosureVerdict::Rejected;
  metric.reason = static_cast<int>(reason);
  metric.reason_name = toString(reason);
  metric.sentence = sentence;
  metric.measured.information.setZero();
}

}  // namespace

Judge::Judge(const Parameters& parameters, double patience, StageStore& store, Listener listener)
    : parameters_(parameters), patience_(patience), store_(store), listener_(std::move(listener)) {
  mailbox_.setCapacity(most_messages);
  thread_ = std::thread([this] { work(); });
}

Judge::~Judge() {
  mailbox_.close();
  thread_.join();
}

Judge::Counts Judge::counts() const { return {mailbox_.dropped(), waits_, stereo_, icp_, rejected_, parts_}; }

void Judge::work() {
  bool busy = false;
  while (!mailbox_.closed()) {
    for (Input& input : mailbox_.takeAll(std::chrono::milliseconds(busy ? 0 : 100))) take(input);
    busy = judgeNext();
  }
}

void Judge::take(Input& input) {
  if (const auto* step = std::get_if<urban_nav_core::RelativePose>(&input)) {
    takeStep(*step);
  } else if (auto* candidate = std::get_if<Candidate>(&input)) {
    waiting_.push_back(std::move(*candidate));
    waits_ = static_cast<std::int64_t>(waiting_.size());
  } else if (const auto* began = std::get_if<SessionBegan>(&input)) {
    endSession(began);
  } else if (const auto* view = std::get_if<ViewKept>(&input)) {
    if (surroundings_ && !outdated_ && !running_.empty())
      for (std::size_t i = 0; i < sessions_[running_].odometry.parts().size(); ++i)
        surroundings_->add({nameOf(running_, i), view->stamp});
  } else if (const auto* laser = std::get_if<LaserAt>(&input)) {
    if (running_.empty()) return;
    sessions_[running_].lasers.push_back(*laser);
    outdated_ = true;
  } else if (const auto* camera = std::get_if<CameraAt>(&input)) {
    camera_ = *camera;
    stage_.reset();
    for (auto each = sessions_.begin(); each != sessions_.end();)
      each = each->first == running_ ? std::next(each) : sessions_.erase(each);  // whose camera is that, now?
    if (!running_.empty()) sessions_[running_].has_camera = true;
    outdated_ = true;
  } else {
    endSession(nullptr);
    if (const auto& done = std::get<End>(input).done) done->set_value();
  }
}

void Judge::takeStep(const urban_nav_core::RelativePose& step) {
  last_step_ = Clock::now();
  if (running_.empty()) return;
  SessionOdometry& odometry = sessions_[running_].odometry;
  const std::size_t parts = odometry.parts().size();
  odometry.add(step);
  if (odometry.parts().size() == parts) return;
  outdated_ = true;
  parts_ = static_cast<std::int64_t>(odometry.parts().size());
}

void Judge::endSession(const SessionBegan* next) {
  while (!running_.empty() && !waiting_.empty() && !mailbox_.closed()) {
    const Candidate candidate = waiting_.front();
    waiting_.pop_front();
    judge(candidate, next != nullptr);
  }
  waits_ = static_cast<std::int64_t>(waiting_.size());
  running_.clear();
  if (next == nullptr) return;
  if (next->goes_on) load(next->id);
  else sessions_.erase(next->id);
  running_ = next->id;
  Known& session = sessions_[running_];
  session.id = running_;
  session.has_camera = camera_.has_value();
  session.lasers.clear();  // whoever keeps scans tells them again
  outdated_ = true;
  last_step_ = Clock::now();
}

/// Nothing is gained by waiting: neither moment is of the running session, or the robot has driven on from the later one by what clouds (views, where
/// there are none) take in, or has had the time to, or no odometry tells of it any more.
bool Judge::isDue(const Candidate& candidate) const {
  StampNs later = 0;
  for (const PoseRef* at : {&candidate.closure.a, &candidate.closure.b})
    if (at->session.empty() || at->session == running_) later = std::max(later, at->stamp);
  if (later == 0) return true;
  if (Clock::now() - std::max(last_step_, candidate.came) >= patience_) return true;
  const auto session = sessions_.find(running_);
  if (session == sessions_.end() || session->second.odometry.empty()) return false;
  const StampNs newest = session->second.odometry.newest();
  if (secondsAfter(newest, later) >= patience_.count() || secondsAfter(later, newest) > longest_ahead) return true;
  if (newest < later) return false;
  const bool clouds = parameters_.icp && !session->second.lasers.empty();
  const urban_nav_core::OdometryChain& way = *session->second.odometry.parts().back();
  return way.distance(newest) - way.distance(later) >= (clouds ? parameters_.cloud_way : parameters_.view_way);
}

bool Judge::judgeNext() {
  const auto due =
      std::find_if(waiting_.begin(), waiting_.end(), [this](const Candidate& each) { return isDue(each); });
  if (due == waiting_.end()) return false;
  const Candidate candidate = *due;
  waiting_.erase(due);
  waits_ = static_cast<std::int64_t>(waiting_.size());
  judge(candidate, false);
  return true;
}

void Judge::judge(const Candidate& candidate, bool by_id) {
  const Clock::time_point begin = Clock::now();
  LoopClosure closure;
  try {
    closure = measure(candidate.closure);
    holdAgainstEarlier(closure.metric);
  } catch (const urban_nav_core::Error& error) {  // what the store holds of this place is damaged, or it cannot be read
    closure.metric = {};
    closure.metric.probability = candidate.closure.probability;
    closure.metric.source = "loop_metric";
    refuse(closure.metric, LoopReason::NothingKept, error.what());
  }
  MetricClosure told = closure.metric;
  // The poses by the frames of odometry, and sessions as the candidate calls them: who does not name one means the running one, whatever its id.
  for (const auto& [at, asked] : {std::pair(&told.a, &candidate.closure.a), std::pair(&told.b, &candidate.closure.b)}) {
    if (at->stamp == 0) at->stamp = asked->stamp;
    at->session = asked->session.empty() && by_id ? running_ : asked->session;
  }
  for (StereoTry& each : closure.stereo) {
    name(each.view_a.at);
    name(each.view_b.at);
  }
  closure.metric.a.session = told.a.session;
  closure.metric.b.session = told.b.session;
  if (!told.evidence.empty()) told.evidence = printEvidence(evidenceOf(closure));
  if (told.verdict == ClosureVerdict::Rejected) ++rejected_;
  else ++(told.method == ClosureMethod::Stereo ? stereo_ : icp_);
  const auto keyframe = [this](const PoseRef& at) {
    return surroundings_ ? surroundings_->keyframe(resolved(at)) : Keyframe();
  };
  const auto cloud = [this](const PoseRef& at) {
    return surroundings_ ? surroundings_->cloud(resolved(at), parameters_.cloud_way) : urban_nav_core::PointCloud();
  };
  listener_({std::move(told), closure, keyframe, cloud,
             std::chrono::duration<double, std::milli>(Clock::now() - begin).count()});
}

/// While writes wait for the disk, views have been told of that cannot be read: what the store holds is looked up anew then, and once more when it is
/// in order again, and what came of views that were not there is forgotten.
void Judge::followStore() {
  store_.flush();
  std::string fault = store_.state().fault;
  if (!fault.empty() || !store_fault_.empty()) {
    stage_.reset();
    outdated_ = true;
  }
  store_fault_ = std::move(fault);
}

LoopClosure Judge::measure(const TopologicalClosure& closure) {
  followStore();
  TopologicalClosure candidate{resolved(closure.a), resolved(closure.b), closure.probability};
  LoopClosure made;
  made.metric.a = candidate.a;
  made.metric.b = candidate.b;
  made.metric.probability = candidate.probability;
  made.metric.source = "loop_metric";
  if (!reader_) {
    refuse(made.metric, LoopReason::NothingKept,
           "nothing is kept: " + (store_fault_.empty() ? "no store yet" : store_fault_));
    return made;
  }
  if (running_.empty() && (closure.a.session.empty() || closure.b.session.empty())) {
    refuse(made.metric, LoopReason::UnknownMoment, "no odometry has come: no session is being recorded");
    return made;
  }
  if (outdated_) renew();
  made = stage_->measure(candidate, *surroundings_);
  if (!store_fault_.empty() && made.metric.verdict == ClosureVerdict::Rejected)
    made.metric.sentence += "; what came last is not in the store: " + store_fault_;
  return made;
}

PoseRef Judge::resolved(const PoseRef& at) {
  if (!reader_ && store_.isOpen()) reader_.emplace(store_.state().path, Access::Read);
  const SessionId id = at.session.empty() ? running_ : at.session;
  if (!id.empty() && sessions_.count(id) == 0 && reader_) load(id);
  const auto found = sessions_.find(id);
  if (found == sessions_.end() || found->second.odometry.empty()) return {id, at.stamp};
  const SessionOdometry& odometry = found->second.odometry;
  const std::size_t part = odometry.partAt(at.stamp);
  const auto moment = odometry.parts()[part]->nearestFrame(at.stamp);
  return {nameOf(id, part), moment ? moment->frame : at.stamp};
}

void Judge::name(PoseRef& at) const {
  at.session = sessionOf(at.session);
  if (at.session == running_) at.session.clear();
}

void Judge::load(const SessionId& id) {
  if (!reader_ && store_.isOpen()) reader_.emplace(store_.state().path, Access::Read);
  if (!reader_ || !reader_->sessions().find(id)) return;
  Known session;
  session.id = id;
  session.odometry = readOdometry(*reader_, id);
  const std::string words = camera_ ? cameraWords(camera_->camera, camera_->T_base_left) : "";
  for (const urban_nav_store::Property& property : reader_->sessions().properties(id))
    if (property.name == camera_property) session.has_camera = property.value == words;
  session.lasers = storedLasers(*reader_, id);
  sessions_[id] = std::move(session);
  outdated_ = true;
}

void Judge::renew() {
  StoredSurroundings::Sessions sessions;
  for (const auto& [id, known] : sessions_)
    for (std::size_t i = 0; i < known.odometry.parts().size(); ++i)
      sessions[nameOf(id, i)] = {id, known.odometry.parts()[i], known.lasers, known.has_camera};
  surroundings_ = std::make_unique<StoredSurroundings>(std::move(sessions), reader_->keyframes(), reader_->scans());
  if (!stage_) {
    Parameters parameters = parameters_;
    parameters.stereo = parameters.stereo && camera_;
    const CameraAt camera = camera_.value_or(CameraAt());
    stage_ = std::make_unique<LoopMetric>(parameters, camera.camera, camera.T_base_left);
  }
  outdated_ = false;
}

void Judge::holdAgainstEarlier(MetricClosure& metric) {
  if (metric.verdict != ClosureVerdict::Accepted) return;
  const auto near = [](const PoseRef& x, const PoseRef& y) {
    return x.session == y.session && std::abs(secondsAfter(x.stamp, y.stamp)) <= neighbour_time;
  };
  std::vector<MetricClosure> beside;
  for (const MetricClosure& earlier : accepted_)
    if (near(earlier.a, metric.a) && near(earlier.b, metric.b)) beside.push_back(earlier);
  beside.push_back(metric);
  holdAgainstEachOther(beside, *surroundings_, parameters_);
  metric = beside.back();
  if (metric.verdict != ClosureVerdict::Accepted) return;
  MetricClosure whole = metric;
  whole.evidence.clear();
  keepWhatIsNew(metric, accepted_, *surroundings_, parameters_);
  told_views_.keepWhatIsNew(metric);
  accepted_.push_back(std::move(whole));
}

}  // namespace loop_metric
