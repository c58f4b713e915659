// SPDX-License-Identifier: BSD-3-Clause
#include "join/join_run.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "inspect/store_info.hpp"
#include "map/context.hpp"
#include "map/store_keys.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/merge.hpp"
#include "urban_nav_store/stored_ids.hpp"

namespace urban_nav {

namespace fs = std::filesystem;
using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::DataError;
using urban_nav_core::UserError;
using urban_nav_store::Access;
using urban_nav_store::Store;

namespace {

const std::vector<std::string>& stagesOfJoin() {
  static const std::vector<std::string> names = {"places", "loops", "graph", "lasers"};
  return names;
}

/// The unfinished store, and a folder for files that a stage writes. Both vanish unless the store is published.
class Workplace {
 public:
  explicit Workplace(const std::string& out) : out_(out), store_(out + ".joining"), folder_(out + ".joining.files") {
    const fs::path parent = fs::absolute(out).parent_path();
    if (!fs::is_directory(parent)) throw UserError(out, "there is no folder " + parent.string(), "an existing folder");
    clear();
    fs::create_directory(folder_);
  }
  ~Workplace() { clear(); }
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  const std::string& store() const { return store_; }
  const std::string& folder() const { return folder_; }
  void publish() { urban_nav_store::merge({store_}, out_); }

 private:
  void clear() {
    std::error_code ignored;
    for (const char* suffix : {"", "-wal", "-shm", ".lock"}) fs::remove(store_ + suffix, ignored);
    fs::remove_all(folder_, ignored);
  }

  const std::string out_, store_, folder_;
};

void requireFinished(const std::string& path) {
  for (const StoredSession& each : readStoreInfo(path).sessions)
    if (each.resumable || !each.session.complete)
      throw DataError(path,
                      "session " + each.session.id + " (" + each.session.name +
                          ") is not complete: the run of map that writes it has not finished, or was interrupted",
                      "the same call of map once more, which goes on from there");
}

std::string reasonApart(const JoinRun& run, const urban_nav_store::SessionId& id) {
  std::size_t candidates = 0;
  for (const JoinRun::Between& between : run.between)
    if (between.a == id || between.b == id) candidates += between.candidates;
  if (candidates == 0) return "none of its places was recognised in another session";
  return "none of its " + std::to_string(candidates) + " candidates for closures with other sessions was accepted";
}

/// The two poses of a closure, whichever of them is named first.
using PosePair = std::pair<urban_nav_core::PoseRef, urban_nav_core::PoseRef>;

/// Returns the accepted closures that the sources hold, by the ids of their sessions.
std::set<PosePair> acceptedClosures(const std::vector<std::string>& stores) {
  std::set<PosePair> pairs;
  for (const std::string& path : stores) {
    Store store = urban_nav_store::openForReading(path);
    for (const urban_nav_store::Session& session : store.sessions().all())
      store.graph().forEachEdge(session.id, [&](const urban_nav_store::Edge& edge) {
        const bool is_measured =
            edge.kind == urban_nav_store::EdgeKind::Stereo || edge.kind == urban_nav_store::EdgeKind::Icp;
        if (is_measured && edge.verdict == ClosureVerdict::Accepted)
          pairs.insert(std::minmax(urban_nav_core::PoseRef{edge.a.session, edge.a.stamp},
                                   urban_nav_core::PoseRef{edge.b.session, edge.b.stamp}));
      });
  }
  return pairs;
}

/// Warns of accepted closures of the sources between poses of which the joined graph has no edge.
void warnOfLostClosures(Store& store, const std::set<PosePair>& before, JoinRun& run) {
  std::set<PosePair> joined;
  for (const urban_nav_store::Session& session : store.sessions().all())
    store.graph().forEachEdge(session.id, [&](const urban_nav_store::Edge& edge) {
      joined.insert(std::minmax(urban_nav_core::PoseRef{edge.a.session, edge.a.stamp},
                                urban_nav_core::PoseRef{edge.b.session, edge.b.stamp}));
    });
  const auto lost =
      std::count_if(before.begin(), before.end(), [&](const PosePair& closure) { return joined.count(closure) == 0; });
  if (lost > 0)
    run.warnings.push_back(std::to_string(lost) + " of " + std::to_string(before.size()) +
                           " closures that the stores had accepted are not in the joined map: places does not propose "
                           "them where all sessions are compared in the order of time (they were given by --closures, "
                           "or found in another order)");
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

/// States with which a run could go on reading are kept for the last session alone: the others have ended.
void dropStates(Store& store) {
  const std::vector<urban_nav_store::Session> sessions = store.sessions().all();
  const auto last = std::max_element(
      sessions.begin(), sessions.end(),
      [](const urban_nav_store::Session& a, const urban_nav_store::Session& b) { return a.start < b.start; });
  for (auto session = sessions.begin(); session != sessions.end(); ++session)
    if (session != last) store.states().remove(session->id, kBagStage);
}

void runStages(MapContext& context, const AllStages& stages, JoinRun& run) {
  for (const std::unique_ptr<Stage>& stage : stages) {
    const std::string name = stage->describe().name;
    if (std::find(stagesOfJoin().begin(), stagesOfJoin().end(), name) == stagesOfJoin().end()) continue;
    if (const std::string missing = stage->missingInput(context); !missing.empty()) {
      context.console.info("stage " + name + " left out: " + missing);
      continue;
    }
    context.store->commit();
    const Stage::Messages messages = stage->run(context);
    for (const std::string& line : messages.info) context.console.info(line);
    run.warnings.insert(run.warnings.end(), messages.warnings.begin(), messages.warnings.end());
  }
}

}  // namespace

JoinRun joinStores(JoinOptions options, AllStages stages, Console& console) {
  for (const std::string& path : options.stores) requireFinished(path);
  const std::set<PosePair> accepted_before = acceptedClosures(options.stores);
  Workplace workplace(options.out);
  urban_nav_store::merge(options.stores, workplace.store(), urban_nav_store::MergeContent::Sessions);
  JoinRun run;
  {
    const MapOptions map_options{
        {}, workplace.folder(), stagesOfJoin(), "", "", "", {}, std::move(options.parameters), options.threads};
    for (const std::unique_ptr<Stage>& stage : stages) stage->select(map_options);  // reports bad files before the work
    Store store(workplace.store(), Access::Write);
    MapContext context(map_options, console);
    context.store = &store;
    context.joins = true;
    context.previous = readPreviousSessions(store, {});
    if (context.previous.runs.empty())
      throw DataError(options.stores.front(), "holds no session with poses", "stores that map has written");
    context.names = context.previous.names;
    context.trajectories = odometryTrajectories(context.runs(), 0);
    runStages(context, stages, run);
    countClosures(context, run);
    findApart(context, run);
    warnOfLostClosures(store, accepted_before, run);
    dropStates(store);
    store.shrink();
    store.close();
  }
  for (const std::string& warning : run.warnings) console.warn(warning);
  workplace.publish();
  return run;
}

}  // namespace urban_nav
