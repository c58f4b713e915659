// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/map_pipeline.hpp"

#include <algorithm>
#include <memory>

#include "command_line/usage.hpp"
#include "input/sessions.hpp"
#include "pipeline/map_result.hpp"
#include "pipeline/run_checkpoint.hpp"
#include "report/plot.hpp"
#include "stages/graph/graph_files.hpp"
#include "stages/graph/graph_store_export.hpp"
#include "stages/keyframes/keyframe_writer.hpp"
#include "stages/vo/vo_files.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_core::DataError;
using urban_nav_core::UserError;

namespace {

constexpr double kSecondsBetweenReports = 4.0;
constexpr int kMostReadAhead = 16;  // pairs: decoding is even enough that more would only cost memory

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// The stages that docs/files.md names and this version has not, with the reason.
std::string leftOut() {
  std::vector<std::string> absent;
  for (const std::string& stage : knownStages()) {
    if (std::find(existingStages().begin(), existingStages().end(), stage) == existingStages().end()) {
      absent.push_back(stage);
    }
  }
  return joined(absent) + " (not in this version)";
}

void checkStages(const std::vector<std::string>& stages) {
  for (const std::string& stage : stages) {
    const auto in = [&](const std::vector<std::string>& list) {
      return std::find(list.begin(), list.end(), stage) != list.end();
    };
    if (in(existingStages())) continue;
    const std::string what =
        in(knownStages()) ? "stage " + stage + " is not in this version" : "no stage \"" + stage + "\"";
    throw UserError("--stages", what, joined(existingStages()));
  }
}

std::unique_ptr<Source> open(const std::vector<std::string>& paths, const MapRequest& request,
                             const BagEnd* behind = nullptr) {
  std::unique_ptr<Source> source = openSource(paths, request.source, behind);
  if (request.threads == 1) return source;
  const urban_nav_core::Pinhole& camera = source->info().camera.left;
  const double pair_mb = std::max(0.1, 2e-6 * camera.width * camera.height);
  const int fits = static_cast<int>(0.1 * request.parameters.command.parameters.memory_mb / pair_mb);
  return readAhead(std::move(source), std::clamp(fits, 2, kMostReadAhead));
}

void say(const SourceInfo& info, Console& console) {
  console.info(info.name + ": " + info.kind +
               (info.frames > 0 ? ", " + std::to_string(info.frames) + " stereo frames" : "") + ", " +
               std::to_string(info.camera.left.width) + "x" + std::to_string(info.camera.left.height));
  for (const std::string& note : info.notes) console.info("  " + note);
}

/// Frames of one session through visual odometry, with the store and the report kept fresh.
void runVo(Source& source, VoStage& stage, StoreStage& store, MapOutcome& outcome, Console& console) {
  std::optional<KeyframeKeeper> views;
  if (keepsViews(outcome.request)) {
    views.emplace(outcome.request.parameters.loop_metric.parameters, source.info().camera,
                  outcome.request.threads == 1);
    views->goOn(stage.run(), store.viewsKept());
  }
  const auto keepViews = [&views, &store] {
    while (const auto view = views ? views->next() : std::nullopt) store.keep(*view);
  };
  Progress progress(console, "vo", "frames", source.info().frames);
  std::size_t faults_said = stage.run().faults.size();
  double last_report = outcome.usage.wallSeconds();
  while (const std::optional<SourceItem> input = source.next()) {
    if (input->bag_end) {
      keepViews();
      store.keep(source.info(), input->bag_end->scans);
      store.keepBag(stage, *input->bag_end);
    }
    store.keep(source.info(), input->scans);
    const VoRow& row = stage.process(*input);
    if (const auto view = views ? views->process(input->assembled, row) : std::nullopt) store.keep(*view);
    for (; faults_said < std::min<std::size_t>(stage.run().faults.size(), 10); ++faults_said)
      console.warn(stage.run().faults[faults_said]);
    const auto done = static_cast<std::int64_t>(stage.run().rows.size());
    progress.update(done);
    store.keepUp(stage.run());
    if (!outcome.request.so_far && outcome.usage.wallSeconds() - last_report > kSecondsBetweenReports) {
      outcome.progress =
          source.info().frames > 0 ? static_cast<double>(done) / static_cast<double>(source.info().frames) : 0.0;
      writeReport(outcome);
      last_report = outcome.usage.wallSeconds();
    }
  }
  keepViews();
  if (const auto end = source.bagEnd()) {
    store.keep(source.info(), end->scans);
    store.keepBag(stage, *end);
  }
  store.keep(source.info(), source.scans());
  stage.finish(source.closingFaults(), source.forces());
  store.finish(stage.run());
  for (const std::string& fault : source.closingFaults()) console.warn(fault);
  progress.finish(static_cast<std::int64_t>(stage.run().rows.size()));
}

/// Reader and stage of a session as they stood where it goes on.
struct Resumed {
  std::unique_ptr<Source> source;
  std::unique_ptr<VoStage> stage;
};

/// Empty where the session is to be begun.
Resumed resume(const MapRequest& request, Session& session, StoreStage& store, std::size_t i, Console& console) {
  if (!store.behind(i)) return {};
  const BagState& state = store.behind(i)->state;
  const BagEnd behind{store.behind(i)->bags, state.receipt, state.reader, {}};
  try {
    Resumed resumed{open(session.paths, request, &behind), nullptr};
    resumed.stage = std::make_unique<VoStage>(request.parameters.swf_vo.parameters, resumed.source->info(), state.vo);
    return resumed;
  } catch (const urban_nav_core::Error& error) {
    console.warn(std::string("cannot go on behind the bags that were complete: ") + error.what() + ": begins anew");
    store.giveUp(i, session);
    return {};
  }
}

void checkUsable(const VoRun& run) {
  const bool any =
      std::any_of(run.rows.begin(), run.rows.end(), [](const VoRow& row) { return row.statistics.features > 0; });
  if (any) return;
  const std::string first = !run.faults.empty() ? "; the first fault: " + run.faults.front()
                            : !run.rows.empty() ? "; the first: " + run.rows.front().status.sentence
                                                : "";
  throw DataError(run.input, "none of " + std::to_string(run.rows.size()) + " stereo frames could be used" + first, "");
}

bool asksFor(const MapRequest& request, const std::string& stage) {
  return std::find(request.stages.begin(), request.stages.end(), stage) != request.stages.end();
}

/// Which stages behind odometry run, said for people. They are there wherever odometry is; closures are in a file or in the store to go on from,
/// if anywhere.
struct Running {
  bool loops = false, graph = false;
};
Running checkClosures(const MapRequest& request, Console& console) {
  const bool all = request.stages.empty(), file = !request.closures.empty();
  if (!request.localise.empty()) {
    console.info("stages: vo; then each session is looked for in the map of " + request.localise +
                 ", which is only read");
    if (file) console.warn("--closures is not used: views are looked for in the whole map");
    return {};
  }
  const Running runs{all || asksFor(request, "loops"), all || asksFor(request, "graph")};
  if (all) console.info("stages: vo, loops, graph; left out: " + leftOut());
  if (!runs.loops && !runs.graph) {
    if (file) console.warn("--closures is not used: neither loops nor graph is among --stages");
    return runs;
  }
  if (file) {
    console.info("closures: " + request.closures +
                 (runs.loops ? "; the stage loops finds their transforms, those in the file are not used"
                             : ", with the transforms that stand in it (no stage loops)"));
  } else if (!request.store.empty()) {
    urban_nav_store::Store store(request.store, urban_nav_store::Access::Read);
    if (holdsClosures(store)) console.info("closures: those of " + request.store);
  } else {
    console.info("closures: none (--closures FILE); the map is that of odometry");
  }
  return runs;
}

void runLoopsStage(MapOutcome& outcome, const std::vector<Session>& sessions, const std::vector<ClosureRow>& closures,
                   StoreStage& store, Console& console) {
  const EarlierSessions& earlier = outcome.earlier;
  const std::vector<const VoRun*> runs = runsOfGraph(outcome);
  const std::vector<std::string> names = sessionNames(sessions, earlier.names);
  std::vector<LoopsSession> known;
  for (std::size_t i = 0; i < runs.size(); ++i)
    known.push_back({names[i], i < earlier.ids.size() ? earlier.ids[i] : store.ids()[i - earlier.ids.size()], runs[i]});
  store.store().commit();
  const SourceInfo& info = outcome.infos.back();
  outcome.loops = runLoops(outcome.request.parameters.loop_metric.parameters, info.camera, info.T_base_camera, known,
                           store.store(), closures, console);
  const LoopsRun& loops = *outcome.loops;
  if (loops.candidates == 0) return;
  console.info("loops: " + std::to_string(loops.candidates) + " candidates, " + std::to_string(loops.accepted_stereo) +
               " accepted by stereo, " + std::to_string(loops.accepted_icp) + " by ICP, " +
               std::to_string(loops.rejected) + " rejected; " + forPerson(loops.ms_median, 3) + " ms each");
  for (const std::string& warning : loops.warnings) console.warn(warning);
}

void runGraphStage(MapOutcome& outcome, const std::vector<Session>& sessions, const std::vector<ClosureRow>& closures,
                   StoreStage& store, Console& console) {
  const EarlierSessions& earlier = outcome.earlier;
  const std::vector<const VoRun*> runs = runsOfGraph(outcome);
  const std::vector<std::string> names = sessionNames(sessions, earlier.names);
  std::vector<urban_nav_store::SessionId> ids = earlier.ids, of_before = earlier.ids;
  std::vector<std::string> names_of_before = earlier.names;
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    ids.push_back(store.ids()[i]);
    if (!store.isContinued(i)) continue;
    of_before.push_back(store.ids()[i]);
    names_of_before.push_back(names[earlier.names.size() + i]);
  }
  const pose_graph::Parameters& parameters = outcome.request.parameters.pose_graph.parameters;
  const std::vector<KnownClosure> known = closuresBetween(store.store(), of_before, names_of_before);
  outcome.graph = runGraph(parameters, runs, names, closures, known);
  if (outcome.loops && outcome.loops->accepted_icp > 0) {
    std::vector<ClosureRow> by_stereo;
    for (const ClosureRow& row : closures)
      if (row.kind != "icp") by_stereo.push_back(row);
    outcome.without_icp = runGraph(parameters, runs, names, by_stereo, known);
  }
  const pose_graph::Relaxed& relaxed = outcome.graph->relaxed;
  console.info("graph: " + std::to_string(relaxed.poses) + " poses, " + std::to_string(relaxed.closures) +
               " closures, " + std::to_string(relaxed.accepted) + " accepted; cost " +
               forPerson(relaxed.cost_before, 5) + " -> " + forPerson(relaxed.cost_after, 5) + " in " +
               forPerson(outcome.graph->ms, 3) + " ms");
  for (const std::string& warning : outcome.graph->warnings) console.warn(warning);
  const pose_graph::Level& level = outcome.graph->levels.front();
  console.info(level.known() ? "map is level, to " + forPerson(level.sigma * 57.29577951308232, 2) + " deg"
                             : "map is not level: " + level.sentence);
  putGraph(store.store(), ids, *outcome.graph, earlier.revision);
  store.store().commit();
  writeGraphFiles(outcome.folder, *outcome.graph, runs);
}

void runLocalisation(MapOutcome& outcome, StoreStage& store, Console& console) {
  urban_nav_store::Store frozen(outcome.request.localise, urban_nav_store::Access::Read);
  store.store().commit();
  for (std::size_t i = 0; i < outcome.stages.size(); ++i) {
    const VoRun& run = outcome.stages[i]->run();
    LocaliseRun made = localise(outcome.request.parameters.loop_metric.parameters, frozen, store.store(),
                                store.ids()[i], run, console);
    console.info("localised: KNOWN in " + forPerson(100.0 * made.known_share, 3) + " % of the frames" +
                 (made.first_known_s < 0.0 ? "" : ", first after " + forPerson(made.first_known_s, 3) + " s") + "; " +
                 std::to_string(made.sightings) + " sightings in " + std::to_string(made.looks) + " looks" +
                 (made.cloud_looks == 0 ? ""
                                        : ", " + std::to_string(made.cloud_sightings) + " in " +
                                              std::to_string(made.cloud_looks) + " at clouds"));
    for (const std::string& warning : made.warnings) console.warn(warning);
    const std::string suffix = i == 0 ? "" : "_" + std::to_string(i + 1);
    outcome.folder.write("localisation" + suffix + ".csv", localisationCsv(made));
    if (!made.T_map_base.empty())
      outcome.folder.write("trajectory" + suffix + ".tum", urban_nav_core::printTum(made.T_map_base));
    outcome.localised.push_back(std::move(made));
  }
}

/// Files of sessions that an earlier run in this folder had and this one has not.
void removeFurtherSessions(const OutputFolder& folder, std::size_t sessions) {
  for (std::size_t i = sessions + 1;; ++i) {
    const std::string suffix = "_" + std::to_string(i);
    if (!folder.has("trajectory" + suffix + ".tum") && !folder.has("landmarks" + suffix + ".ply")) return;
    removeVoFiles(folder, suffix);
  }
}

}  // namespace

const std::vector<std::string>& knownStages() {
  static const std::vector<std::string> stages = {"vo", "places", "loops", "graph", "lasers", "stereo", "labels"};
  return stages;
}

const std::vector<std::string>& existingStages() {
  static const std::vector<std::string> stages = {"vo", "loops", "graph"};
  return stages;
}

bool keepsViews(const MapRequest& request) {
  return request.stages.empty() || asksFor(request, "loops") || !request.localise.empty();
}

void runMap(const MapRequest& request, Console& console) {
  checkStages(request.stages);
  if (!request.truth.empty()) readTrajectory(request.truth);  // a mistake in it is told now, not after the work
  const Running with = checkClosures(request, console);
  std::vector<ClosureRow> closures =
      request.closures.empty() ? std::vector<ClosureRow>() : readClosures(request.closures);
  if (!request.localise.empty() && !request.store.empty())
    throw UserError("--localise", "the map stays as it is, and --store goes on in one", "one of them");
  if (!request.localise.empty())  // a mistake in it is told before the work
    urban_nav_store::Store(request.localise, urban_nav_store::Access::Read).close();
  std::vector<Session> sessions = findSessions(request.inputs);
  MapOutcome outcome(request);
  StoreStage store(request, sessions, outcome.folder.file("session.db"), console);
  std::vector<Resumed> resumed;
  for (std::size_t i = 0; i < sessions.size(); ++i) resumed.push_back(resume(request, sessions[i], store, i, console));
  if (with.loops || with.graph) outcome.earlier = readEarlierSessions(store.store(), store.ids());
  const std::vector<std::string> names = outcome.session_names = sessionNames(sessions, outcome.earlier.names);
  for (ClosureRow& row : closures)
    for (std::string* session : {&row.session_a, &row.session_b})
      *session = sessionMeant(*session, names, outcome.earlier.names.size());
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    auto [source, stage] = std::move(resumed[i]);
    if (!source) source = open(sessions[i].paths, request);
    say(source->info(), console);
    std::optional<VoRun> finished;
    if (stage) store.goOn(i, source->info(), stage->run());
    else if ((finished = store.begin(i, source->info()))) stage = std::make_unique<VoStage>(std::move(*finished));
    else stage = std::make_unique<VoStage>(request.parameters.swf_vo.parameters, source->info());
    outcome.stages.push_back(std::move(stage));
    outcome.infos.push_back(source->info());
    if (i == 0 && !request.so_far) {
      writeReport(outcome);
      console.info("report: " + outcome.folder.file("report.html") + " (open it now; it grows as the run goes on)");
    }
    if (!finished) runVo(*source, *outcome.stages.back(), store, outcome, console);
    checkUsable(outcome.stages.back()->run());
    const std::size_t place = outcome.earlier.ids.size() + i;
    writeVoFiles(outcome.folder, outcome.stages.back()->run(), place == 0 ? "" : "_" + std::to_string(place + 1));
  }
  removeFurtherSessions(outcome.folder, outcome.earlier.ids.size() + sessions.size());
  if (with.loops) runLoopsStage(outcome, sessions, closures, store, console);
  if (outcome.loops) closures = outcome.loops->closures;
  if (with.graph) runGraphStage(outcome, sessions, closures, store, console);
  else if (with.loops) outcome.folder.write("closures.csv", printClosures(closures));
  else outcome.folder.remove("closures.csv");
  if (!request.localise.empty()) runLocalisation(outcome, store, console);
  else outcome.folder.remove("localisation.csv");
  finishMap(outcome, sessions, console);
  store.end();
}

}  // namespace urban_nav
