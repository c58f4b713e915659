// SPDX-License-Identifier: BSD-3-Clause
#include "map/run_checkpoint.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

#include "map/store_keys.hpp"
#include "map/stored_run.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_registration/session/calibration_fingerprint.hpp"
#include "urban_nav_store/merge.hpp"
#include "urban_nav_store/stored_ids.hpp"

namespace urban_nav {

using urban_nav_store::Access;
using urban_nav_store::Property;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

constexpr std::chrono::seconds kCommitPeriod{1};

/// Returns the given options that affect the results of a run, one value per line.
std::map<std::string, std::string> givenOptions(const MapOptions& options) {
  std::map<std::string, std::string> given;
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) given[name] += value + "\n";
  };
  for (const std::string& stage : options.stages) add("stages", stage);
  for (const std::string& topic : options.source.topics) add("topic", topic);
  for (const std::string& transform : options.source.transforms) add("transform", transform);
  add("calibration", options.source.calibration);
  if (options.source.rate > 0.0) add("rate", urban_nav_core::printNumber(options.source.rate));
  for (const char* word : {"stereo", "laser", "both"})
    if (parseOdometryOption(word) == options.odometry) add("odometry", word);
  if (options.calibrate) add("calibrate", "true");
  return given;
}

std::string counted(std::size_t number, const char* noun) {
  return std::to_string(number) + " " + noun + (number == 1 ? "" : "s");
}

}  // namespace

RunCheckpoint::RunCheckpoint(const MapOptions& options, const StageList& stages, std::vector<MapSession>& sessions,
                             std::string path, Console& console)
    : options_(options), path_(std::move(path)), sessions_(sessions), plans_(sessions.size()) {
  for (const Stage* stage : stages) keys_.push_back(stage->describe().key);
  const std::vector<SessionId> ids = sessionIds(options, sessions);
  for (std::size_t i = 0; i < sessions_.size(); ++i) {
    sessions_[i].id = ids[i];
    plans_[i] = {ids[i], fingerprint(options, stages, sessions_[i].input), inputName(sessions_[i].input),
                 bagFingerprints(options, sessions_[i].input), std::nullopt};
  }
  if (!options_.store.empty()) findContinuedSessions(console);
  open(console);
  for (std::size_t i = 0; i < plans_.size(); ++i)
    if (!isFinished(i)) plans_[i].resume_point = findResumePoint(*store_, sessions_[i].id, i);
}

std::optional<RunCheckpoint::ResumePoint> RunCheckpoint::readResumePoint(Store& store, const SessionId& id,
                                                                         std::size_t session) {
  const std::optional<std::string> bytes = store.states().get(id, kBagStage);
  if (!bytes) return std::nullopt;
  try {
    ResumePoint point{unpackBagCheckpoint(*bytes), 0};
    const std::optional<std::size_t> bags =
        coveredBags(point.checkpoint, plans_[session].bags, sessions_[session].input.begin);
    const bool all_given = bags && *bags == point.checkpoint.bags.size();
    if (!bags || (!sessions_[session].continued && !all_given)) return std::nullopt;
    point.bags = *bags;
    return point;
  } catch (const urban_nav_core::DataError&) {
    return std::nullopt;  // of another version
  }
}

bool RunCheckpoint::followsWhole(Store& store, const SessionId& id, std::size_t session) const {
  const std::optional<std::string> bytes = store.states().get(id, kWholeStage);
  if (!bytes) return false;
  try {
    return coveredBags(unpackBagCheckpoint(*bytes), plans_[session].bags, sessions_[session].input.begin) == 0U;
  } catch (const urban_nav_core::DataError&) {
    return false;  // of another version
  }
}

std::string RunCheckpoint::configurationDifferences(Store& store, const SessionId& id, std::size_t session) const {
  return differences(plans_[session].fingerprint, storedFingerprint(store, id), {"inputs", "stages", "store"});
}

std::optional<RunCheckpoint::ResumePoint> RunCheckpoint::findResumePoint(Store& store, const SessionId& id,
                                                                         std::size_t session) {
  return configurationDifferences(store, id, session).empty() ? readResumePoint(store, id, session) : std::nullopt;
}

void RunCheckpoint::startNewSession(std::size_t session) {
  plans_[session].resume_point.reset();
  sessions_[session].continued = false;
  sessions_[session].id = plans_[session].own_id;
  sessions_[session].input.name.clear();
  plans_[session].name = inputName(sessions_[session].input);
}

void RunCheckpoint::findContinuedSessions(Console& console) {
  Store store = urban_nav_store::openForReading(options_.store, Access::Read);
  const auto isTaken = [&](const SessionId& id) {
    return std::any_of(sessions_.begin(), sessions_.end(), [&](const MapSession& each) { return each.id == id; });
  };
  for (std::size_t i = 0; i < sessions_.size(); ++i) {
    const std::string name = inputName(sessions_[i].input);
    for (const urban_nav_store::Session& known : store.sessions().all()) {
      if (isTaken(known.id) && known.id != sessions_[i].id) continue;
      sessions_[i].continued = true;
      const std::optional<ResumePoint> point = readResumePoint(store, known.id, i);
      // A session without new bags, all of whose bags are given, is mapped again.
      sessions_[i].continued =
          point && (point->bags < plans_[i].bags.size() || point->bags < point->checkpoint.bags.size());
      if (followsWhole(store, known.id, i))
        console.info("store: " + name + " follows session " + known.name + ", but becomes a session of its own: " +
                     "the state of " + known.name + " is not kept, since the name of its last bag does not end in " +
                     "_N as those of a split recording do; mapped together, the bags are one session");
      if (!sessions_[i].continued) continue;
      if (const std::string difference = configurationDifferences(store, known.id, i); !difference.empty()) {
        sessions_[i].continued = false;
        console.info("store: " + name + " does not continue session " + known.name + ": other " + difference);
        continue;
      }
      sessions_[i].id = known.id;
      plans_[i].name = sessions_[i].input.name = known.name;
      console.info("store: " + name + " continues session " + known.name + ", after " +
                   counted(point->checkpoint.bags.size(), "bag") + " of it");
      break;
    }
  }
}

bool RunCheckpoint::isFinished(std::size_t session) {
  const SessionId& id = sessions_[session].id;
  const auto known = store_->sessions().find(id);
  return known && known->complete && storedFingerprint(*store_, id) == plans_[session].fingerprint &&
         store_->states().get(id, keys_.front()).has_value();
}

RunCheckpoint::PruneResult RunCheckpoint::pruneSessions(bool in_place) {
  PruneResult found;
  std::vector<SessionId> stay;
  if (!options_.store.empty() && !in_place)
    for (const urban_nav_store::Session& session : Store(options_.store, Access::Read).sessions().all())
      stay.push_back(session.id);
  for (const urban_nav_store::Session& known : store_->sessions().all()) {
    const auto place = std::find_if(sessions_.begin(), sessions_.end(),
                                    [&](const MapSession& session) { return session.id == known.id; });
    const bool ours = place != sessions_.end();
    const auto at = static_cast<std::size_t>(place - sessions_.begin());
    // Complete, or not begun by a run of map: a session recorded live counts as complete.
    if (!ours && (in_place ? known.complete || storedFingerprint(*store_, known.id).empty()
                           : std::find(stay.begin(), stay.end(), known.id) != stay.end()))
      continue;
    const bool interrupted = !known.complete || isUnfinished(*store_, known);
    found.interrupted = found.interrupted || interrupted;
    if (!ours) {
      if (!in_place && !options_.overwrite)
        throw urban_nav_core::UserError(
            options_.out, "holds the map of another recording, " + known.name,
            "another folder, --overwrite to replace that map, or --store " + path_ + " to continue it");
      found.difference = "other inputs";
    } else if (isFinished(at)) {
      ++found.finished;
      continue;
    } else if ((interrupted || (sessions_[at].continued && in_place)) && findResumePoint(*store_, known.id, at)) {
      if (interrupted) ++found.begun;
      continue;
    } else if (const std::string names = differences(plans_[at].fingerprint, storedFingerprint(*store_, known.id));
               !names.empty()) {
      found.difference = "other " + names;
    }
    store_->sessions().remove(known.id);
  }
  return found;
}

void RunCheckpoint::startNewStore() {
  store_->close();
  urban_nav_store::removeStore(path_);
  if (!options_.store.empty()) urban_nav_store::merge({options_.store}, path_);
  store_.emplace(path_, Access::Write);
  for (const MapSession& session : sessions_)
    if (!session.continued) store_->sessions().remove(session.id);
  store_->commit();
}

void RunCheckpoint::open(Console& console) {
  std::error_code ignored;
  const bool in_place = !options_.store.empty() && std::filesystem::equivalent(options_.store, path_, ignored);
  // Reports an unusable file before any change.
  if (!options_.store.empty()) urban_nav_store::openForReading(options_.store, Access::Read);
  store_.emplace(path_, Access::Write);
  const PruneResult found = pruneSessions(in_place);
  const bool resumes = found.finished > 0 || found.begun > 0;
  if (resumes)
    console.info("resuming an interrupted run: " + std::to_string(found.finished) + " of " +
                 counted(sessions_.size(), "session") + " complete" +
                 (found.begun > 0 ? ", continuing after the last complete bag" : ""));
  else if (found.interrupted)
    console.info("an earlier run was interrupted" +
                 (found.difference.empty() ? " in its first session" : ", with " + found.difference) +
                 ": starting from the beginning");
  if (resumes || in_place) {
    store_->commit();
  } else {
    startNewStore();
  }
  if (!options_.store.empty())
    console.info("store: continues from " + counted(store_->sessions().all().size() - found.finished, "session") +
                 " of " + options_.store);
}

std::vector<BagCheckpoint::StageState> RunCheckpoint::finishedStates(std::size_t session) {
  std::vector<BagCheckpoint::StageState> states;
  if (!isFinished(session)) return states;
  for (const std::string& key : keys_)
    if (std::optional<std::string> state = store_->states().get(sessions_[session].id, key))
      states.emplace_back(key, std::move(*state));
  return states;
}

void RunCheckpoint::begin(std::size_t session) {
  current_ = session;
  writeSession(session);
  commit();
}

void RunCheckpoint::resume(std::size_t session) {
  current_ = session;
  writeSession(session);
  store_->states().put(sessions_[session].id, kBagStage, packBagCheckpoint(plans_[session].resume_point->checkpoint));
}

void RunCheckpoint::writeSession(std::size_t session) {
  const SessionPlan& plan = plans_[session];
  const SessionId& id = sessions_[session].id;
  const urban_nav_input::SourceInfo& info = sessions_[session].info;
  std::vector<EdgeWithEvidence> closures;
  if (sessions_[session].continued) closures = readClosureEdges(*store_, id);
  if (plan.resume_point) store_->sessions().clear(id);
  else store_->sessions().remove(id);
  store_->sessions().put(urban_nav_store::Session{id, plan.name, "", "", info.first, false});
  store_->states().put(id, kRunStage, {});
  for (const auto& [name, digest] : plan.fingerprint) store_->sessions().put(id, Property{"run/" + name, digest});
  store_->sessions().put(id, Property{"input/name", info.name});
  store_->sessions().put(id, Property{"input/kind", info.kind});
  for (const auto& [name, values] : givenOptions(options_))
    store_->sessions().put(id, Property{kOptionProperty + name, values});
  store_->sessions().put(id, urban_nav_store::Extrinsic{urban_nav_core::frames::kStereoLeft, info.T_base_camera});
  store_->sessions().put(id, Property{urban_nav_registration::kCalibrationProperty,
                                      urban_nav_registration::calibrationFingerprint(info.camera, info.T_base_camera)});
  for (const urban_nav_input::LaserInfo& laser : info.lasers)
    store_->sessions().put(id, urban_nav_store::Extrinsic{laser.frame, laser.T_base_laser});
  for (const urban_nav_core::Setting& setting : options_.parameters.settings())
    store_->sessions().put(id,
                           urban_nav_store::StoredParameter{urban_nav_core::fullName(setting.stage, setting.name),
                                                            urban_nav_core::printValue(setting.value), setting.origin});
  writeEdges(*store_, closures);
}

void RunCheckpoint::writeScans(const std::vector<urban_nav_input::LaserInput>& scans) {
  const std::vector<urban_nav_input::LaserInfo>& lasers = sessions_[current_].info.lasers;
  for (const urban_nav_input::LaserInput& each : scans)
    store_->scans().put(sessions_[current_].id, lasers[each.laser].frame, each.scan);
}

void RunCheckpoint::saveBagEnd(std::vector<BagCheckpoint::StageState> states, const urban_nav_input::BagEnd& end) {
  const std::optional<ResumePoint>& point = plans_[current_].resume_point;
  BagCheckpoint checkpoint{{}, end.receipt, end.reader, std::move(states)};
  if (point)  // bags before the given ones
    checkpoint.bags.assign(point->checkpoint.bags.begin(),
                           point->checkpoint.bags.end() - static_cast<std::ptrdiff_t>(point->bags));
  const std::vector<std::string>& bags = plans_[current_].bags;
  checkpoint.bags.insert(checkpoint.bags.end(), bags.begin(), bags.begin() + static_cast<std::ptrdiff_t>(end.bags));
  store_->states().put(sessions_[current_].id, kBagStage, packBagCheckpoint(std::move(checkpoint)));
  commit();
}

bool RunCheckpoint::isCommitDue() const { return Clock::now() - committed_ >= kCommitPeriod; }

void RunCheckpoint::commit() {
  store_->commit();
  committed_ = Clock::now();
}

void RunCheckpoint::finishSession(const std::vector<BagCheckpoint::StageState>& states) {
  const SessionId& id = sessions_[current_].id;
  for (const auto& [key, state] : states) store_->states().put(id, key, state);
  urban_nav_store::Session session = *store_->sessions().find(id);
  session.complete = true;
  store_->sessions().put(session);
  commit();
}

void RunCheckpoint::dropCheckpoint(std::size_t session) {
  const SessionId& id = sessions_[session].id;
  const std::optional<std::string> bytes = store_->states().get(id, kBagStage);
  if (!bytes) return;
  BagCheckpoint checkpoint = unpackBagCheckpoint(*bytes);
  checkpoint.reader.clear();
  checkpoint.stages.clear();
  store_->states().put(id, kWholeStage, packBagCheckpoint(std::move(checkpoint)));
  store_->states().remove(id, kBagStage);
}

void RunCheckpoint::endRun() {
  const auto last = std::max_element(sessions_.begin(), sessions_.end(), [](const MapSession& a, const MapSession& b) {
    return a.input.begin < b.input.begin;
  });
  for (const MapSession& session : sessions_)
    for (const std::string& key : keys_) store_->states().remove(session.id, key);
  for (const urban_nav_store::Session& session : store_->sessions().all())
    if (session.id != last->id) store_->states().remove(session.id, kBagStage);
  if (!isPartOfSplit(last->input.paths.back())) dropCheckpoint(static_cast<std::size_t>(last - sessions_.begin()));
  store_->shrink();
  // Last, after what takes time: a run that is killed before its end is not complete.
  for (const urban_nav_store::Session& session : store_->sessions().all())
    store_->states().remove(session.id, kRunStage);
  store_->commit();
  store_->close();
}

}  // namespace urban_nav
