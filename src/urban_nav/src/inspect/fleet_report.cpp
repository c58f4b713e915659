// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/fleet_report.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "base/plot.hpp"
#include "inspect/fleet_coverage.hpp"
#include "inspect/store_info.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/trajectory/statistics.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/session/calibration_fingerprint.hpp"
#include "urban_nav_store/release.hpp"
#include "urban_nav_store/stored_ids.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {

namespace fs = std::filesystem;
using urban_nav_core::StampNs;
using urban_nav_store::Access;
using urban_nav_store::Store;

namespace {

constexpr const char* kSummary = "summary.json";
constexpr double kFleetPathStep = 1.0;  // m

/// Sorted names of files below a folder.
struct FoundFiles {
  std::vector<std::string> stores, summaries;
};

/// Finds stores and releases, and the summaries of runs of map.
FoundFiles findFiles(const std::string& folder) {
  FoundFiles found;
  std::error_code ignored;
  for (fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, ignored), end;
       entry != end; entry.increment(ignored)) {
    if (!entry->is_regular_file(ignored)) continue;
    const std::string name = entry->path().lexically_relative(folder).generic_string();
    if (entry->path().filename() == kSummary) found.summaries.push_back(name);
    else if (urban_nav_store::isStore(entry->path().string())) found.stores.push_back(name);
  }
  std::sort(found.stores.begin(), found.stores.end());
  std::sort(found.summaries.begin(), found.summaries.end());
  return found;
}

/// Returns the reason why a recording could not be mapped, from the summary that the workflow writes for it; nullopt
/// for the summary of a map, and for other content.
std::optional<std::string> readFailure(const std::string& summary) {
  const auto json = nlohmann::json::parse(urban_nav_core::readBytes(summary), nullptr, false);
  if (!json.is_object()) return std::nullopt;
  const auto reason = json.find("failed");
  return reason != json.end() && reason->is_string() ? std::optional(reason->get<std::string>()) : std::nullopt;
}

/// "2008-11-03".
std::string printDay(StampNs stamp) {
  const auto seconds = static_cast<std::time_t>(stamp / 1'000'000'000);
  std::tm utc{};
  char text[16] = "";
  if (gmtime_r(&seconds, &utc) != nullptr) std::strftime(text, sizeof(text), "%Y-%m-%d", &utc);
  return text;
}

double largestSigma(Store& store, const urban_nav_store::SessionId& id) {
  double largest = 0.0;
  store.graph().forEachRelaxed(id, [&](const urban_nav_store::RelaxedPose& pose) {
    const auto values = urban_nav_core::symmetricEigenvalues(pose.covariance.topLeftCorner<3, 3>());
    if (values) largest = std::max(largest, std::sqrt(std::max(0.0, (*values)[2])));
  });
  return largest;
}

/// Counts the closures of sessions with others, and computes the residuals of accepted ones.
void addClosures(Store& store, std::vector<FleetSession>& sessions) {
  std::map<urban_nav_store::SessionId, std::map<StampNs, urban_nav_core::Pose>> poses;
  std::map<urban_nav_store::SessionId, std::vector<double>> misses;
  for (FleetSession& session : sessions)
    for (const urban_nav_core::StampedPose& pose : readTrajectory(store, session.session).T_map_base) {
      poses[session.session.id][pose.stamp] = pose.pose;
      const Eigen::Vector2d at = pose.pose.t().head<2>();
      if (session.path.empty() || (at - session.path.back()).norm() >= kFleetPathStep) session.path.push_back(at);
    }
  const auto find = [&](const urban_nav_store::SessionId& id) {
    return std::find_if(sessions.begin(), sessions.end(),
                        [&](const FleetSession& session) { return session.session.id == id; });
  };
  for (const FleetSession& session : sessions)
    store.graph().forEachEdge(session.session.id, [&](const urban_nav_store::Edge& edge) {
      const auto a = find(edge.a.session), b = find(edge.b.session);
      const bool is_closure =
          edge.kind == urban_nav_store::EdgeKind::Stereo || edge.kind == urban_nav_store::EdgeKind::Icp;
      if (!is_closure || a == b || a == sessions.end() || b == sessions.end()) return;
      const bool is_accepted = edge.verdict == urban_nav_core::ClosureVerdict::Accepted;
      for (const auto& each : {a, b}) {
        ++each->candidates;
        each->accepted += is_accepted ? 1 : 0;
      }
      const auto &of_a = poses[edge.a.session], &of_b = poses[edge.b.session];
      const auto pose_a = of_a.find(edge.a.stamp), pose_b = of_b.find(edge.b.stamp);
      if (!is_accepted || pose_a == of_a.end() || pose_b == of_b.end()) return;
      const double miss = distanceBetween(pose_a->second * edge.measured.T_a_b, pose_b->second);
      misses[edge.a.session].push_back(miss);
      misses[edge.b.session].push_back(miss);
    });
  for (FleetSession& session : sessions)
    if (const auto found = misses.find(session.session.id); found != misses.end())
      session.disagreement_m = urban_nav_core::quantile(found->second, 0.5);
}

/// Adds the recordings that could not be mapped, and returns their folders.
std::set<std::string> addFailures(const std::vector<std::string>& summaries, Fleet& fleet) {
  std::set<std::string> folders;
  for (const std::string& name : summaries) {
    try {
      const auto reason = readFailure((fs::path(fleet.folder) / name).string());
      if (!reason) continue;
      const std::string folder = fs::path(name).parent_path().generic_string();
      fleet.failed.emplace_back(folder, *reason);
      folders.insert(folder);
    } catch (const urban_nav_core::Error& error) {
      fleet.unreadable.emplace_back(name, error.what());
    }
  }
  return folders;
}

std::vector<FleetSession> readSessions(const std::string& path, const std::string& name) {
  const StoreInfo info = readStoreInfo(path);
  Store store = urban_nav_store::openForReading(path, Access::Snapshot);
  std::vector<FleetSession> sessions;
  for (std::size_t i = 0; i < info.sessions.size(); ++i) {
    const StoredSession& each = info.sessions[i];
    FleetSession session;
    session.session = each.session;
    session.day = printDay(each.session.start);
    session.store = name;
    session.map = each.map;
    for (const std::vector<std::size_t>& group : info.joined)
      if (std::find(group.begin(), group.end(), i) != group.end()) session.in_map = group.size();
    session.first = each.first;
    session.last = each.last;
    session.distance_m = each.length_m;
    const auto good = each.status_counts.find("OK");
    if (each.nodes > 0)
      session.good_share =
          good == each.status_counts.end() ? 0.0 : static_cast<double>(good->second) / static_cast<double>(each.nodes);
    session.sigma_m = largestSigma(store, each.session.id);
    for (const urban_nav_store::Property& property : store.sessions().properties(each.session.id))
      if (property.name == urban_nav_registration::kCalibrationProperty) session.camera = property.value;
    sessions.push_back(std::move(session));
  }
  addClosures(store, sessions);
  return sessions;
}

std::string printName(const FleetSession& session) {
  return session.session.id.substr(0, 8) + " (" + session.session.name + ")";
}

/// Returns sentences on sessions whose calibration differs from the previous session of the same robot.
std::vector<std::string> findDrifts(const std::vector<FleetSession>& sessions) {
  std::map<std::string, const FleetSession*> last;
  std::vector<std::string> sentences;
  for (const FleetSession& session : sessions) {
    const auto now = urban_nav_registration::parseCalibrationFingerprint(session.camera);
    if (!now) continue;
    const FleetSession*& before = last[session.session.robot];
    if (before != nullptr && !urban_nav_registration::isSameCalibration(before->camera, session.camera)) {
      const auto then = urban_nav_registration::parseCalibrationFingerprint(before->camera);
      const double pixels = std::abs(now->camera.left.fx - then->camera.left.fx);
      const double metres = distanceBetween(now->T_base_left, then->T_base_left);
      sentences.push_back(printName(session) + ": the camera differs from that of " + printName(*before) +
                          ": focal length by " + urban_nav_core::formatNumber(pixels, 3) +
                          " px, position on the robot by " + urban_nav_core::formatNumber(1e3 * metres, 3) + " mm");
    }
    before = &session;
  }
  return sentences;
}

std::string reasonApart(const FleetSession& session) {
  if (session.in_map > 1) return "";
  if (session.candidates == 0) return "no candidate for a closure with another session of its store";
  return "none of its " + std::to_string(session.candidates) + " candidates for closures was accepted";
}

std::size_t countJoined(const Fleet& fleet) {
  return static_cast<std::size_t>(std::count_if(fleet.sessions.begin(), fleet.sessions.end(),
                                                [](const FleetSession& session) { return session.in_map > 1; }));
}

PageTable sessionTable(const Fleet& fleet) {
  PageTable table{"Sessions",
                  {"robot", "day", "session", "store", "m", "s", "map", "closures", "disagreement (m)", "sigma (m)",
                   "poses OK (%)", "reason if separate"},
                  {},
                  "Disagreement: median residual of accepted closures with other sessions at the relaxed poses. "
                  "Sigma: largest standard deviation of a position in the map."};
  const auto number = [](double value) { return urban_nav_core::formatNumber(value, 3); };
  for (const FleetSession& each : fleet.sessions)
    table.rows.push_back({each.session.robot, each.day, printName(each), each.store, number(each.distance_m),
                          number(urban_nav_core::secondsBetween(each.first, each.last)), each.map.substr(0, 8),
                          std::to_string(each.accepted) + " of " + std::to_string(each.candidates),
                          each.accepted > 0 ? number(each.disagreement_m) : "", number(each.sigma_m),
                          number(100.0 * each.good_share), reasonApart(each)});
  return table;
}

/// Returns the distance driven by robot and day, m.
PageTable daysTable(const Fleet& fleet) {
  std::map<std::pair<std::string, std::string>, std::pair<std::size_t, double>> driven;
  for (const FleetSession& each : fleet.sessions) {
    auto& [count, metres] = driven[{each.session.robot, each.day}];
    ++count;
    metres += each.distance_m;
  }
  PageTable table{"Robots and days", {"robot", "day", "sessions", "m"}, {}, ""};
  for (const auto& [key, sum] : driven)
    table.rows.push_back(
        {key.first, key.second, std::to_string(sum.first), urban_nav_core::formatNumber(sum.second, 4)});
  return table;
}

PageTable listTable(const std::string& title, const std::string& head, const std::vector<std::string>& lines) {
  PageTable table{title, {head}, {}, ""};
  for (const std::string& line : lines) table.rows.push_back({line});
  return table;
}

}  // namespace

Fleet readFleet(const std::string& folder) {
  if (!fs::is_directory(folder))
    throw urban_nav_core::UserError(folder, "is not a folder", "a folder of session stores");
  Fleet fleet;
  fleet.folder = folder;
  std::map<urban_nav_store::SessionId, FleetSession> sessions;
  const FoundFiles files = findFiles(folder);
  const std::set<std::string> failed = addFailures(files.summaries, fleet);
  for (const std::string& name : files.stores) {
    const std::string path = (fs::path(folder) / name).string();
    if (failed.count(fs::path(name).parent_path().generic_string()) > 0) continue;
    try {
      if (urban_nav_store::isRelease(path)) {
        Store release = urban_nav_store::openForReading(path, Access::Frozen);
        fleet.releases.push_back(name + ": version " + std::to_string(readReleaseHead(release).version));
        continue;
      }
      for (FleetSession& session : readSessions(path, name)) {
        FleetSession& known = sessions[session.session.id];
        if (known.store.empty() || known.in_map < session.in_map) known = std::move(session);
      }
    } catch (const urban_nav_core::Error& error) {
      fleet.unreadable.emplace_back(name, error.what());
    }
  }
  for (auto& [id, session] : sessions) fleet.sessions.push_back(std::move(session));
  std::stable_sort(fleet.sessions.begin(), fleet.sessions.end(),
                   [](const FleetSession& a, const FleetSession& b) { return a.session.start < b.session.start; });
  fleet.drifts = findDrifts(fleet.sessions);
  return fleet;
}

Page fleetPage(const Fleet& fleet) {
  Page page;
  page.title = "Fleet";
  page.subtitle = fleet.folder;
  double metres = 0.0;
  for (const FleetSession& session : fleet.sessions) metres += session.distance_m;
  const std::size_t joined = countJoined(fleet);
  page.tiles = {{std::to_string(fleet.sessions.size()), "", "sessions", Grade::Plain},
                {std::to_string(joined), "", "joined to others", Grade::Plain},
                {urban_nav_core::formatNumber(1e-3 * metres, 3), "km", "driven", Grade::Plain}};
  if (joined < fleet.sessions.size())
    page.verdicts.push_back(
        {Grade::Fair, std::to_string(fleet.sessions.size() - joined) + " sessions are not joined to others",
         "The table lists the reasons; urban_nav join makes one map of sessions that show the same places."});
  if (!fleet.failed.empty())
    page.verdicts.push_back({Grade::Bad, std::to_string(fleet.failed.size()) + " recordings could not be mapped",
                             fleet.failed.front().first + ": " + fleet.failed.front().second});
  if (!fleet.unreadable.empty())
    page.verdicts.push_back({Grade::Bad, std::to_string(fleet.unreadable.size()) + " stores cannot be read",
                             fleet.unreadable.front().second});
  if (!fleet.drifts.empty())
    page.verdicts.push_back({Grade::Fair, "Calibrations differ between sessions of one robot", fleet.drifts.front()});
  Section section{"sessions", "Sessions", "", {}, {}, {sessionTable(fleet), daysTable(fleet)}};
  if (!fleet.drifts.empty()) section.tables.push_back(listTable("Calibrations that differ", "session", fleet.drifts));
  if (!fleet.releases.empty()) section.tables.push_back(listTable("Releases", "file", fleet.releases));
  const auto addReasons = [&](const char* title, const char* head, const auto& named) {
    PageTable table{title, {head, "reason"}, {}, ""};
    for (const auto& [name, reason] : named) table.rows.push_back({name, reason});
    if (!table.rows.empty()) section.tables.push_back(std::move(table));
  };
  addReasons("Recordings that could not be mapped", "folder", fleet.failed);
  addReasons("Stores that cannot be read", "file", fleet.unreadable);
  page.sections.push_back(std::move(section));
  if (!fleet.sessions.empty()) page.sections.push_back(coverageSection(fleet));
  return page;
}

Json toJson(const Fleet& fleet) {
  Json json = Json::object({{"name", fleet.folder}, {"kind", "folder of stores"}});
  Json& sessions = json["sessions"] = Json::array();
  for (const FleetSession& each : fleet.sessions)
    sessions.append(Json::object({{"id", each.session.id},
                                  {"name", each.session.name},
                                  {"robot", each.session.robot},
                                  {"store", each.store},
                                  {"start_ns", each.session.start},
                                  {"day", each.day},
                                  {"map", each.map},
                                  {"state", each.in_map > 1 ? "joined" : "apart"},
                                  {"reason", reasonApart(each)},
                                  {"distance_m", each.distance_m},
                                  {"duration_s", urban_nav_core::secondsBetween(each.first, each.last)},
                                  {"candidates", each.candidates},
                                  {"accepted", each.accepted},
                                  {"disagreement_m", each.disagreement_m},
                                  {"sigma_m", each.sigma_m},
                                  {"ok_share", each.good_share}}));
  const auto list = [&](const char* key, const std::vector<std::string>& lines) {
    Json& rows = json[key] = Json::array();
    for (const std::string& line : lines) rows.append(line);
  };
  json["maps"] = coverageJson(fleet);
  list("releases", fleet.releases);
  list("calibrations", fleet.drifts);
  Json& unreadable = json["unreadable"] = Json::array();
  for (const auto& [name, reason] : fleet.unreadable)
    unreadable.append(Json::object({{"store", name}, {"reason", reason}}));
  Json& failed = json["failed"] = Json::array();
  for (const auto& [name, reason] : fleet.failed) failed.append(Json::object({{"folder", name}, {"reason", reason}}));
  return json;
}

}  // namespace urban_nav
