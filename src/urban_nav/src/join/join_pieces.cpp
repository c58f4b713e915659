// SPDX-License-Identifier: BSD-3-Clause
#include "join/join_pieces.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <random>
#include <tuple>

#include "topics/loops/closure_bytes.hpp"
#include "topics/loops/loops_run.hpp"
#include "topics/loops/stored_sessions.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/trajectory/statistics.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/parameters.hpp"
#include "urban_nav_registration/session/calibration_fingerprint.hpp"
#include "urban_nav_store/bytes.hpp"
#include "urban_nav_store/digest.hpp"
#include "urban_nav_store/stored_ids.hpp"

namespace urban_nav {

namespace fs = std::filesystem;
using urban_nav_core::DataError;
using urban_nav_core::MetricClosure;
using urban_nav_core::UserError;
using urban_nav_store::Access;
using urban_nav_store::Store;

namespace {

constexpr const char* kPlanFile = "plan.json";
constexpr const char* kDone = ".done";
constexpr const char* kResultFormat = "urban_nav join result 1";

std::string inFolder(const std::string& folder, const std::string& name) { return (fs::path(folder) / name).string(); }

fs::path parentFolder(const std::string& file) { return fs::absolute(file).lexically_normal().parent_path(); }

/// A source of a plan, to be sorted: the start and id of its first session, and its path relative to the plan.
struct Source {
  urban_nav_core::StampNs start = 0;
  urban_nav_store::SessionId first;
  std::string relative, path;
  std::vector<urban_nav_store::SessionId> ids;
};

bool operator<(const Source& a, const Source& b) {
  return std::tie(a.start, a.first, a.relative) < std::tie(b.start, b.first, b.relative);
}

/// Returns the unique sources in an order independent of the given one.
std::vector<Source> sortSources(const std::vector<std::string>& stores, const std::string& folder) {
  std::map<std::string, Source> by_path;
  for (const std::string& path : stores) {
    Source source;
    source.path = path;
    source.relative = fs::absolute(path).lexically_normal().lexically_relative(folder).generic_string();
    Store store = urban_nav_store::openForReading(path, Access::Snapshot);
    for (const urban_nav_store::Session& session : store.sessions().all()) {
      if (source.ids.empty()) source.start = session.start;
      source.ids.push_back(session.id);
    }
    if (!source.ids.empty()) source.first = source.ids.front();
    by_path.emplace(source.relative, std::move(source));
  }
  std::vector<Source> sorted;
  for (auto& [path, source] : by_path) sorted.push_back(std::move(source));
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

std::string describeLastCamera(const MapContext& context) {
  const auto camera = context.lastCamera();
  return camera ? urban_nav_registration::calibrationFingerprint(camera->camera, camera->T_base_left) : "";
}

/// Removes the pieces of an earlier plan from the folder.
void removeEarlierPlan(const std::string& folder) {
  const std::string path = inFolder(folder, kPlanFile);
  if (!fs::exists(path)) return;
  std::error_code ignored;
  for (const std::string& name : readPlan(path).pieces) {
    if (fs::path(name).filename() != name) continue;
    fs::remove(inFolder(folder, name), ignored);
    fs::remove(inFolder(folder, name + kDone), ignored);
  }
}

/// Throws UserError if a store is missing or differs from that of the plan.
void requireUnchanged(const std::vector<PlannedStore>& stores, const fs::path& folder) {
  for (const PlannedStore& store : stores) {
    const std::string path = (folder / store.path).lexically_normal().string();
    if (!fs::exists(path))
      throw UserError(path, "is missing", "the stores of the plan at their paths, or in its folder");
    if (digestOfFile(path) != store.digest)
      throw UserError(path, "has changed since the plan was made", "a new plan by urban_nav join --plan");
  }
}

/// Applies the parameters of a plan.
void applyParameters(const std::vector<std::string>& chosen, ParameterSet& parameters) {
  for (const std::string& assignment : chosen) parameters.set(assignment);
}

std::string digestOfPiece(const JoinPiece& piece) { return urban_nav_store::sha256(toJson(piece).print()); }

std::string printResult(const JoinPiece& piece, const std::vector<MetricClosure>& closures) {
  std::string bytes;
  for (const std::string& text : {std::string(kResultFormat), piece.plan, digestOfPiece(piece), packClosures(closures)})
    urban_nav_store::appendText(bytes, text);
  return bytes;
}

/// Writes a file atomically, also while other processes, on any host, write the same file.
void writeConcurrently(const std::string& path, const std::string& bytes) {
  std::random_device random;
  urban_nav_core::PartialFile partial(path, "." + std::to_string(random()) + std::to_string(random()) + ".part");
  urban_nav_core::writeAtomically(partial.path(), bytes);
  partial.commit();
}

/// Returns the closures measured by a piece.
std::vector<MetricClosure> readResult(const std::string& path, const JoinPlan& plan) {
  if (!fs::exists(path + kDone))
    throw DataError(path, "has no result: " + path + kDone + " is missing", "a run of urban_nav join --piece " + path);
  const JoinPiece piece = readPiece(path);
  const std::string bytes = urban_nav_core::readBytes(path + kDone);
  urban_nav_store::ByteReader reader(bytes);
  const std::string_view format = reader.text(), of_plan = reader.text(), of_piece = reader.text();
  const auto closures = unpackClosures(reader.text());
  const std::string again = "a new run of urban_nav join --piece " + path;
  if (!reader.complete() || format != kResultFormat || !closures)
    throw DataError(path + kDone, "is damaged, or not the result of a piece", again);
  if (of_plan != plan.digest || piece.plan != plan.digest || of_piece != digestOfPiece(piece))
    throw UserError(path + kDone, "is the result of another plan or piece", again);
  if (closures->size() != piece.candidates.size()) throw DataError(path + kDone, "is incomplete", again);
  return *closures;
}

/// Returns the sessions of a piece as input of stage loops.
loop_metric::StoredPlaceData::Sessions readSessions(const JoinPiece& piece, const std::vector<std::string>& paths,
                                                    const urban_nav_registration::MountedCamera& camera) {
  loop_metric::StoredPlaceData::Sessions sessions;
  for (std::size_t s = 0; s < paths.size(); ++s) {
    Store store = urban_nav_store::openForReading(paths[s], Access::Snapshot);
    const PreviousSessions known = readPreviousSessions(store, {});
    std::vector<CandidateSession> candidates;
    for (const PlannedSession& session : piece.sessions) {
      const auto place = std::find(known.ids.begin(), known.ids.end(), session.id);
      if (session.store == s && place != known.ids.end())
        candidates.push_back(
            {session.name, session.id, &known.runs[static_cast<std::size_t>(place - known.ids.begin())]});
    }
    sessions.merge(storedSessions(candidates, store, camera));
  }
  return sessions;
}

}  // namespace

JoinPlan planJoin(JoinOptions options, AllStages stages, Console& console) {
  const std::string folder = fs::absolute(options.out).lexically_normal().string();
  fs::create_directories(folder);
  const std::vector<Source> sources = sortSources(options.stores, folder);
  JoinPlan plan;
  plan.parameters = chosenParameters(options.parameters);
  options.stores.clear();
  for (const Source& source : sources) options.stores.push_back(source.path);
  options.out = inFolder(folder, kPlanFile);
  Join join(std::move(options), std::move(stages), console);
  for (const Source& source : sources) plan.stores.push_back({source.relative, digestOfFile(source.path)});
  join.findCandidates();
  const MapContext& context = join.context();
  for (std::size_t s = 0; s < context.previous.ids.size(); ++s) {
    const auto holds = [&](const Source& source) {
      return std::find(source.ids.begin(), source.ids.end(), context.previous.ids[s]) != source.ids.end();
    };
    const auto store = std::find_if(sources.begin(), sources.end(), holds);
    plan.sessions.push_back(
        {context.previous.ids[s], context.names[s], static_cast<std::size_t>(store - sources.begin())});
  }
  plan.camera = describeLastCamera(context);
  plan.candidates = context.closures;
  plan.warnings = join.warnings();
  const std::vector<JoinPiece> pieces = splitPlan(plan);
  removeEarlierPlan(folder);
  for (std::size_t i = 0; i < pieces.size(); ++i)
    urban_nav_core::writeAtomically(inFolder(folder, plan.pieces[i]), toJson(pieces[i]).print());
  urban_nav_core::writeAtomically(inFolder(folder, kPlanFile), toJson(plan).print());
  return plan;
}

PieceResult measurePiece(const std::string& path, ParameterSet parameters, Console& console) {
  const JoinPiece piece = readPiece(path);
  const fs::path folder = parentFolder(path);
  requireUnchanged(piece.stores, folder);
  applyParameters(piece.parameters, parameters);
  CandidateMeasurer measurer;
  for (const PlannedStore& store : piece.stores)
    measurer.stores.push_back((folder / store.path).lexically_normal().string());
  measurer.camera = urban_nav_registration::parseCalibrationFingerprint(piece.camera)
                        .value_or(urban_nav_registration::MountedCamera());  // of none: no views
  measurer.sessions = readSessions(piece, measurer.stores, measurer.camera);
  measurer.parameters = parameters.get(loop_metric::table());
  measurer.parameters.registration = parameters.get(urban_nav_registration::table());
  const auto count = static_cast<std::int64_t>(piece.candidates.size());
  Progress progress(console, "piece", "closures", count);
  const MeasuredCandidates measured = measureCandidates(
      measurer, piece.candidates, [&](std::size_t done) { progress.update(static_cast<std::int64_t>(done)); });
  progress.finish(count);
  PieceResult result;
  result.candidates = measured.closures.size();
  for (const MetricClosure& closure : measured.closures) {
    if (closure.verdict != urban_nav_core::ClosureVerdict::Accepted) ++result.rejected;
    else ++(closure.method == urban_nav_core::ClosureMethod::Icp ? result.accepted_icp : result.accepted_stereo);
  }
  if (!measured.ms.empty()) result.ms_median = urban_nav_core::quantile(measured.ms, 0.5);
  writeConcurrently(path + kDone, printResult(piece, measured.closures));
  return result;
}

JoinRun finishJoin(const std::string& folder, JoinOptions options, AllStages stages, Console& console) {
  const JoinPlan plan = readPlan(inFolder(folder, kPlanFile));
  const fs::path place = fs::absolute(folder).lexically_normal();
  std::vector<MetricClosure> closures;
  for (const std::string& name : plan.pieces) {
    const std::vector<MetricClosure> measured = readResult(inFolder(folder, name), plan);
    closures.insert(closures.end(), measured.begin(), measured.end());
  }
  requireUnchanged(plan.stores, place);
  applyParameters(plan.parameters, options.parameters);
  for (const PlannedStore& store : plan.stores)
    options.stores.push_back((place / store.path).lexically_normal().string());
  Join join(std::move(options), std::move(stages), console);
  MapContext& context = join.context();
  context.closures = plan.candidates;
  for (MetricClosure& closure : closures) {
    const auto poses = std::make_pair(closure.a, closure.b);
    context.measured[poses] = std::move(closure);
  }
  for (const std::string& warning : plan.warnings) join.addWarning(warning);
  join.relax();
  return join.publish();
}

}  // namespace urban_nav
