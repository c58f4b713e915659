// SPDX-License-Identifier: BSD-3-Clause
#include "join/join_run.hpp"

#include <algorithm>
#include <map>

#include "inspect/stores_command.hpp"
#include "map/session_order.hpp"
#include "map/store_keys.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/merge.hpp"
#include "urban_nav_store/stored_ids.hpp"

namespace urban_nav {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::DataError;
using urban_nav_store::Access;
using urban_nav_store::Store;

namespace {

std::string reasonApart(const JoinRun& run, const urban_nav_store::SessionId& id) {
  std::size_t candidates = 0;
  for (const JoinRun::Between& between : run.between)
    if (between.a == id || between.b == id) candidates += between.candidates;
  if (candidates == 0) return "no place of it was recognised in another session";
  return "none of its " + std::to_string(candidates) + " candidates for closures with other sessions was accepted";
}

/// Counts closures by verdict and by the sessions that they connect.
void countClosures(const MapContext& context, JoinRun& run) {
  std::map<std::string, std::size_t> place;
  for (std::size_t i = 0; i < context.names.size(); ++i) place[context.names[i]] = i;
  std::map<std::pair<std::size_t, std::size_t>, JoinRun::Between> between;
  for (std::size_t i = 0; i < context.closures.size(); ++i) {
    const urban_nav_core::MetricClosure& closure = context.closures[i];
    const bool accepted = i < context.assessments.size() && context.assessments[i].verdict == ClosureVerdict::Accepted;
    ++run.candidates;
    if (!accepted) ++run.rejected;
    else ++(closure.method == ClosureMethod::Icp ? run.accepted_icp : run.accepted_stereo);
    const auto a = place.find(closure.a.session), b = place.find(closure.b.session);
    if (a == place.end() || b == place.end() || a->second == b->second) continue;
    const auto [first, second] = std::minmax(a->second, b->second);
    JoinRun::Between& row = between[{first, second}];
    row.a = context.previous.ids[first];
    row.b = context.previous.ids[second];
    ++row.candidates;
    row.accepted += accepted ? 1 : 0;
  }
  for (auto& [sessions, row] : between) run.between.push_back(std::move(row));
}

void findApart(const MapContext& context, JoinRun& run) {
  std::map<std::size_t, std::size_t> members;
  for (const SessionTrajectory& trajectory : context.trajectories) ++members[trajectory.map];
  if (context.trajectories.size() < 2) return;
  for (std::size_t s = 0; s < context.trajectories.size(); ++s)
    if (members[context.trajectories[s].map] == 1)
      run.apart.push_back({context.previous.ids[s], reasonApart(run, context.previous.ids[s])});
}

/// Removes the states for continuing a session, except that of the last one.
void dropStates(Store& store) {
  const std::vector<urban_nav_store::Session> sessions = store.sessions().all();
  const auto last = std::max_element(
      sessions.begin(), sessions.end(),
      [](const urban_nav_store::Session& a, const urban_nav_store::Session& b) { return a.start < b.start; });
  for (auto session = sessions.begin(); session != sessions.end(); ++session)
    if (session != last) store.states().remove(session->id, kBagStage);
}

}  // namespace

void runStage(const AllStages& stages, const std::string& name, MapContext& context,
              std::vector<std::string>& warnings) {
  for (const std::unique_ptr<Stage>& stage : stages) {
    if (stage->describe().name != name) continue;
    if (const std::string missing = stage->missingInput(context); !missing.empty()) {
      context.console.info("stage " + name + " left out: " + missing);
      continue;
    }
    context.store->commit();
    const Stage::Messages messages = stage->run(context);
    for (const std::string& line : messages.info) context.console.info(line);
    for (const std::string& line : messages.warnings)
      if (std::find(warnings.begin(), warnings.end(), line) == warnings.end()) warnings.push_back(line);
  }
}

Join::Join(JoinOptions options, AllStages stages, Console& console)
    : sources_(std::move(options.stores)),
      console_(console),
      stages_(std::move(stages)),
      workplace_(options.out),
      options_{{}, workplace_.folder(),           stagesOfJoin(), "", "", "",
               {}, std::move(options.parameters), options.threads} {
  for (const std::string& path : sources_) requireFinished(path);
  for (const std::string& path : sources_) {
    Store store = urban_nav_store::openForReading(path, Access::Snapshot);
    addAcceptedClosures(store, accepted_before_);
  }
  urban_nav_store::merge(sources_, workplace_.store(), urban_nav_store::MergeContent::Sessions);
  for (const std::unique_ptr<Stage>& stage : stages_) stage->select(options_);  // reports bad files before the work
  store_ = std::make_unique<Store>(workplace_.store(), Access::Write);
  context_ = std::make_unique<MapContext>(options_, console_);
  context_->store = store_.get();
  context_->joins = true;
  context_->previous = readPreviousSessions(*store_, {});
  if (context_->previous.runs.empty())
    throw DataError(sources_.front(), "has no session with poses", "stores written by map");
  context_->names = context_->previous.names;
  context_->trajectories = odometryTrajectories(context_->runs(), 0);
  context_->divides = context_->names.size() > 1;
}

void Join::findCandidates() { runStage(stages_, "places", *context_, run_.warnings); }

void Join::relax() {
  const auto run = [&](const char* name) { runStage(stages_, name, *context_, run_.warnings); };
  run("loops");
  run("graph");
  while (!context_->isFinal())
    for (const char* name : {"places", "loops", "graph"}) run(name);
  run("lasers");
}

JoinRun Join::publish() {
  countClosures(*context_, run_);
  findApart(*context_, run_);
  if (std::string lost = lostClosuresWarning(*store_, accepted_before_); !lost.empty())
    run_.warnings.push_back(std::move(lost));
  dropStates(*store_);
  store_->shrink();
  context_.reset();
  store_->close();
  for (const std::string& warning : run_.warnings) console_.warn(warning);
  workplace_.publish();
  return std::move(run_);
}

JoinRun joinStores(JoinOptions options, AllStages stages, Console& console) {
  Join join(std::move(options), std::move(stages), console);
  join.findCandidates();
  join.relax();
  return join.publish();
}

}  // namespace urban_nav
