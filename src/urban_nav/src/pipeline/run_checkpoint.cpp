// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/run_checkpoint.hpp"

#include <algorithm>
#include <filesystem>

#include "loop_metric/camera_words.hpp"
#include "stages/vo/vo_state.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_store/merge.hpp"

namespace urban_nav {

namespace frames = urban_nav_core::frames;

using urban_nav_core::ClosureVerdict;
using urban_nav_core::Matrix6d;
using urban_nav_store::Access;
using urban_nav_store::Edge;
using urban_nav_store::EdgeKind;
using urban_nav_store::Property;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

constexpr std::chrono::seconds kPeriod{1};

/// Sessions by the content of their inputs; the same input given twice is two sessions.
std::vector<SessionId> idsOf(const MapRequest& request, const std::vector<Session>& sessions) {
  std::vector<SessionId> ids;
  for (const Session& session : sessions) {
    urban_nav_store::SessionOrigin origin = originOf(request, session);
    SessionId id = sessionIdOf(origin);
    for (int again = 2; std::find(ids.begin(), ids.end(), id) != ids.end(); ++again) {
      origin.recording = std::to_string(again);
      id = sessionIdOf(origin);
    }
    ids.push_back(id);
  }
  return ids;
}

std::string nameOf(const Session& session) {
  const std::filesystem::path path = std::filesystem::absolute(session.paths.front()).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

RunIdentity storedIdentity(Store& store, const SessionId& id) {
  RunIdentity identity;
  for (const Property& property : store.sessions().properties(id))
    if (property.name.rfind("run/", 0) == 0) identity.emplace_back(property.name.substr(4), property.value);
  return identity;
}

struct StoredClosure {
  Edge edge;
  std::optional<std::string> evidence;
};

std::vector<StoredClosure> closuresOf(Store& store, const SessionId& id) {
  std::vector<StoredClosure> closures;
  for (const urban_nav_store::Session& session : store.sessions().all())
    store.graph().forEachEdge(session.id, [&](const Edge& edge) {
      if (edge.kind != EdgeKind::Odometry && (edge.a.session == id || edge.b.session == id))
        closures.push_back({edge, std::nullopt});
    });
  for (StoredClosure& closure : closures) closure.evidence = store.graph().evidence(closure.edge);
  return closures;
}

}  // namespace

StoreStage::StoreStage(const MapRequest& request, std::vector<Session>& sessions, const std::string& path,
                       Console& console)
    : request_(request),
      path_(path),
      ids_(idsOf(request, sessions)),
      own_ids_(ids_),
      continued_(sessions.size(), false),
      behind_(sessions.size()) {
  for (const Session& session : sessions) {
    identities_.push_back(identityOf(request, session));
    names_.push_back(nameOf(session));
    bags_.push_back(bagsOf(request, session));
    begins_.push_back(session.begin);
  }
  if (!request_.store.empty()) findContinued(sessions, console);
  open(console);
  for (std::size_t i = 0; i < ids_.size(); ++i)
    if (!isFinished(i)) behind_[i] = look(*store_, ids_[i], i);
}

std::optional<StoreStage::Behind> StoreStage::follow(Store& store, const SessionId& id, std::size_t session) {
  const std::optional<std::string> bytes = store.states().get(id, kBagStage);
  if (!bytes) return std::nullopt;
  try {
    Behind behind{unpackBagState(*bytes), 0};
    const std::optional<std::size_t> bags = bagsBehind(behind.state, bags_[session], begins_[session]);
    const bool all_given = bags && *bags == behind.state.bags.size();
    if (!bags || (!continued_[session] && !all_given)) return std::nullopt;
    behind.bags = *bags;
    return behind;
  } catch (const urban_nav_core::DataError&) {
    return std::nullopt;  // of another version
  }
}

std::string StoreStage::otherThan(Store& store, const SessionId& id, std::size_t session) const {
  return differences(identities_[session], storedIdentity(store, id), {"inputs", "stages", "store"});
}

std::optional<StoreStage::Behind> StoreStage::look(Store& store, const SessionId& id, std::size_t session) {
  return otherThan(store, id, session).empty() ? follow(store, id, session) : std::nullopt;
}

void StoreStage::giveUp(std::size_t session, Session& inputs) {
  behind_[session].reset();
  continued_[session] = false;
  ids_[session] = own_ids_[session];
  inputs.name.clear();
  names_[session] = nameOf(inputs);
}

void StoreStage::findContinued(std::vector<Session>& sessions, Console& console) {
  Store store(request_.store, Access::Read);
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    for (const urban_nav_store::Session& known : store.sessions().all()) {
      if (std::find(ids_.begin(), ids_.end(), known.id) != ids_.end() && known.id != ids_[i]) continue;
      continued_[i] = true;
      const std::optional<Behind> behind = follow(store, known.id, i);
      // Nothing new, and all of it is here: that is mapped again.
      continued_[i] = behind && (behind->bags < bags_[i].size() || behind->bags < behind->state.bags.size());
      if (!continued_[i]) continue;
      if (const std::string other = otherThan(store, known.id, i); !other.empty()) {
        continued_[i] = false;
        console.info("store: " + nameOf(sessions[i]) + " does not go on in session " + known.name + ": other " + other);
        continue;
      }
      ids_[i] = known.id;
      names_[i] = sessions[i].name = known.name;
      console.info("store: " + nameOf(sessions[i]) + " goes on in session " + known.name + ", behind " +
                   std::to_string(behind->state.bags.size()) + (behind->state.bags.size() == 1 ? " bag" : " bags") +
                   " of it");
      break;
    }
  }
}

bool StoreStage::isFinished(std::size_t session) {
  const auto known = store_->sessions().find(ids_[session]);
  return known && known->complete && storedIdentity(*store_, ids_[session]) == identities_[session] &&
         store_->states().get(ids_[session], kVoStage).has_value();
}

StoreStage::Found StoreStage::sift(bool goes_on_here) {
  Found found;
  std::vector<SessionId> stay;
  if (!request_.store.empty() && !goes_on_here)
    for (const urban_nav_store::Session& session : Store(request_.store, Access::Read).sessions().all())
      stay.push_back(session.id);
  for (const urban_nav_store::Session& known : store_->sessions().all()) {
    const auto place = std::find(ids_.begin(), ids_.end(), known.id);
    const bool ours = place != ids_.end();
    if (!ours && (goes_on_here ? known.complete || storedIdentity(*store_, known.id).empty()
                               : std::find(stay.begin(), stay.end(), known.id) != stay.end()))
      continue;  // complete, or none that a run of map began: a live one is as complete as it will ever be
    const bool cut_off = !known.complete || store_->states().get(known.id, kVoStage).has_value();
    found.cut_off = found.cut_off || cut_off;
    const auto at = static_cast<std::size_t>(place - ids_.begin());
    if (!ours) {
      found.other = "other inputs";
    } else if (isFinished(at)) {
      ++found.finished;
      continue;
    } else if ((cut_off || (continued_[at] && goes_on_here)) && look(*store_, known.id, at)) {
      if (cut_off) ++found.begun;
      continue;
    } else if (const std::string names = differences(identities_[static_cast<std::size_t>(place - ids_.begin())],
                                                     storedIdentity(*store_, known.id));
               !names.empty()) {
      found.other = "other " + names;
    }
    store_->sessions().remove(known.id);
  }
  return found;
}

void StoreStage::beginAnew() {
  store_->close();
  urban_nav_store::removeStore(path_);
  if (!request_.store.empty()) urban_nav_store::merge({request_.store}, path_);
  store_.emplace(path_, Access::Write);
  for (std::size_t i = 0; i < ids_.size(); ++i)
    if (!continued_[i]) store_->sessions().remove(ids_[i]);
  store_->commit();
}

void StoreStage::open(Console& console) {
  std::error_code ignored;
  const bool goes_on_here = !request_.store.empty() && std::filesystem::equivalent(request_.store, path_, ignored);
  if (!request_.store.empty()) Store(request_.store, Access::Read);  // a mistake in it is told before anything changes
  store_.emplace(path_, Access::Write);
  const Found found = sift(goes_on_here);
  if (found.finished > 0 || found.begun > 0)
    console.info("an earlier run was cut off here: goes on behind " + std::to_string(found.finished) + " of " +
                 std::to_string(ids_.size()) + (ids_.size() == 1 ? " session" : " sessions") +
                 (found.begun > 0 ? ", and behind the bags that were complete" : ""));
  else if (found.cut_off)
    console.info("an earlier run was cut off here" +
                 (found.other.empty() ? " in its first session" : " with " + found.other) + ": begins anew");
  if (found.finished > 0 || found.begun > 0 || goes_on_here) {
    store_->commit();
  } else {
    beginAnew();
  }
  const std::size_t earlier = store_->sessions().all().size() - found.finished;
  if (!request_.store.empty())
    console.info("store: goes on from " + std::to_string(earlier) + (earlier == 1 ? " session" : " sessions") + " of " +
                 request_.store);
}

std::optional<VoRun> StoreStage::begin(std::size_t session, const SourceInfo& info) {
  session_ = session;
  rows_ = nodes_ = 0;
  committed_ = Clock::now();
  const SessionId& id = ids_[session];
  if (const std::optional<std::string> bytes = store_->states().get(id, kVoStage)) {
    if (std::optional<VoRun> run = unpackVoRun(*bytes)) {
      run->input = info.name;
      run->camera = info.camera;
      run->T_base_camera = info.T_base_camera;
      return run;
    }
  }
  put(session, info);
  store_->commit();
  return std::nullopt;
}

void StoreStage::put(std::size_t session, const SourceInfo& info) {
  const SessionId& id = ids_[session];
  const std::vector<StoredClosure> closures =
      continued_[session] ? closuresOf(*store_, id) : std::vector<StoredClosure>();
  if (behind_[session]) store_->sessions().clear(id);
  else store_->sessions().remove(id);
  store_->sessions().put(urban_nav_store::Session{id, names_[session], "", "", info.first, false});
  for (const auto& [name, digest] : identities_[session]) store_->sessions().put(id, Property{"run/" + name, digest});
  store_->sessions().put(id, Property{"input/name", info.name});
  store_->sessions().put(id, Property{"input/kind", info.kind});
  store_->sessions().put(id, urban_nav_store::Extrinsic{frames::stereo_left, info.T_base_camera});
  store_->sessions().put(
      id, Property{loop_metric::camera_property, loop_metric::cameraWords(info.camera, info.T_base_camera)});
  for (const LaserInfo& laser : info.lasers)
    store_->sessions().put(id, urban_nav_store::Extrinsic{laser.frame, laser.T_base_laser});
  for (const std::vector<urban_nav_core::Setting>* settings : request_.parameters.settings()) {
    for (const urban_nav_core::Setting& setting : *settings)
      store_->sessions().put(
          id, urban_nav_store::StoredParameter{urban_nav_core::fullName(setting.stage, setting.name),
                                               urban_nav_core::printValue(setting.value), setting.origin});
  }
  for (const StoredClosure& closure : closures) {
    store_->graph().put(closure.edge);
    if (closure.evidence) store_->graph().putEvidence(closure.edge, *closure.evidence);
  }
}

void StoreStage::goOn(std::size_t session, const SourceInfo& info, const VoRun& run) {
  session_ = session;
  rows_ = nodes_ = 0;
  committed_ = Clock::now();
  put(session, info);
  store_->states().put(ids_[session], kBagStage, packBagState(behind_[session]->state));
  add(run);
  store_->commit();
}

void StoreStage::keep(const SourceInfo& info, const std::vector<LaserInput>& scans) {
  for (const LaserInput& each : scans) store_->scans().put(ids_[session_], info.lasers[each.laser].frame, each.scan);
}

void StoreStage::keep(const urban_nav_store::StoredKeyframe& view) {
  store_->keyframes().put(ids_[session_], frames::stereo_left, view);
}

std::vector<urban_nav_core::StampNs> StoreStage::viewsKept() {
  return store_->keyframes().stamps(ids_[session_], frames::stereo_left);
}

void StoreStage::keepBag(const VoStage& stage, const BagEnd& end) {
  add(stage.run());
  const std::optional<Behind>& behind = behind_[session_];
  BagState state{{}, end.receipt, end.reader, stage.state()};
  if (behind)
    state.bags.assign(behind->state.bags.begin(), behind->state.bags.end() - static_cast<std::ptrdiff_t>(behind->bags));
  const std::vector<std::string>& bags = bags_[session_];
  state.bags.insert(state.bags.end(), bags.begin(), bags.begin() + static_cast<std::ptrdiff_t>(end.bags));
  store_->states().put(ids_[session_], kBagStage, packBagState(std::move(state)));
  store_->commit();
  committed_ = Clock::now();
}

void StoreStage::keepUp(const VoRun& run) {
  if (Clock::now() - committed_ < kPeriod) return;
  add(run);
  store_->commit();
  committed_ = Clock::now();
}

void StoreStage::add(const VoRun& run) {
  const SessionId& id = ids_[session_];
  for (; rows_ < run.rows.size(); ++rows_)
    store_->inputs().append(id, {kVoStream, run.rows[rows_].stamp, run.rows[rows_].accepted});
  for (; nodes_ < run.settled.size(); ++nodes_) {
    const swf_vo::Settled& settled = run.settled[nodes_];
    const urban_nav_core::RelativePose& step = settled.from_previous;
    const bool first = nodes_ == 0;
    store_->graph().put(
        id, urban_nav_store::Node{
                settled.stamp, settled.T_odom_base.pose, first ? Matrix6d(Matrix6d::Zero()) : step.covariance,
                first ? Matrix6d(Matrix6d::Zero()) : settled.from_previous.drift_covariance, settled.status.health});
    if (first) continue;
    Edge edge{{id, step.from},      {id, step.to}, EdgeKind::Odometry,       kVoStage,
              {step.T_from_to, {}}, 1.0,           ClosureVerdict::Accepted, ""};
    edge.measured.information = urban_nav_core::invertPositiveDefinite(step.covariance).value_or(Matrix6d::Zero());
    store_->graph().put(edge);
  }
}

void StoreStage::finish(const VoRun& run) {
  add(run);
  const SessionId& id = ids_[session_];
  store_->states().put(id, kVoStage, packVoRun(run));
  if (!run.forces.empty()) store_->states().put(id, kForcesStage, packForces(run.forces));
  urban_nav_store::Session session = *store_->sessions().find(id);
  session.complete = true;
  store_->sessions().put(session);
  store_->commit();
}

void StoreStage::end() {
  const auto last = std::max_element(begins_.begin(), begins_.end()) - begins_.begin();
  for (const SessionId& id : ids_) store_->states().remove(id, kVoStage);
  for (const urban_nav_store::Session& session : store_->sessions().all())
    if (session.id != ids_[static_cast<std::size_t>(last)]) store_->states().remove(session.id, kBagStage);
  store_->shrink();
  store_->close();
}

}  // namespace urban_nav
