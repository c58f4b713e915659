// SPDX-License-Identifier: BSD-3-Clause
#include "view/state_json.hpp"

#include <cstring>
#include <map>

#include "base/version.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_store/edit_journal.hpp"

namespace urban_nav {

using urban_nav_core::StampedPose;
using urban_nav_store::StoredTrajectory;

namespace {

Json sessionAsJson(const StoredTrajectory& each, std::size_t map) {
  const std::vector<StampedPose>& path = each.T_map_base;
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i].pose.t() - path[i - 1].pose.t()).norm();
  return Json::object(
      {{"id", each.session.id},
       {"name", each.session.name.empty() ? each.session.id : each.session.name},
       {"map", map},
       {"begin", path.empty() ? std::string() : urban_nav_core::printStamp(path.front().stamp)},
       {"seconds", path.empty() ? 0.0 : urban_nav_core::secondsBetween(path.front().stamp, path.back().stamp)},
       {"poses", path.size()},
       {"length_m", length}});
}

Json endAsJson(const urban_nav_store::NodeRef& ref, double seconds,
               const std::map<urban_nav_store::SessionId, std::size_t>& places) {
  const auto place = places.find(ref.session);
  return Json::object({{"session", place == places.end() ? Json() : Json(place->second)},
                       {"seconds", seconds},
                       {"t", urban_nav_core::printStamp(ref.stamp)}});
}

/// `session`: index in the list of sessions; `begin`: stamp of its first pose.
Json testAsJson(const urban_nav_store::StoredTest& test, std::size_t session, urban_nav_core::StampNs begin) {
  return Json::object({{"name", test.name},
                       {"verdict", test.verdict},
                       {"session", session},
                       {"from", urban_nav_core::secondsBetween(begin, test.from)},
                       {"to", urban_nav_core::secondsBetween(begin, test.to)},
                       {"sentence", test.sentence}});
}

}  // namespace

void appendFloat32(std::string& bytes, double value) {
  const auto number = static_cast<float>(value);
  std::uint32_t bits = 0;
  std::memcpy(&bits, &number, sizeof bits);
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(bits >> shift & 255U);
}

Json stateAsJson(const ShownState& state) {
  Json json = Json::object({{"revision", state.revision},
                            {"version", suiteVersion()},
                            {"store", state.store},
                            {"read_only", state.read_only},
                            {"written_by_another", state.written_by_another}});
  std::map<urban_nav_store::SessionId, std::size_t> places;
  std::vector<urban_nav_core::StampNs> begins;
  Json& sessions = json["sessions"] = Json::array();
  for (std::size_t m = 0; m < state.maps.size(); ++m)
    for (const StoredTrajectory& each : state.maps[m]) {
      const std::size_t place = places.size();
      places[each.session.id] = place;
      begins.push_back(each.T_map_base.empty() ? 0 : each.T_map_base.front().stamp);
      sessions.append(sessionAsJson(each, m));
    }
  Json& closures = json["closures"] = Json::array();
  for (const StoredClosure& closure : state.closures)
    closures.append(Json::object({{"id", closure.id},
                                  {"kind", toString(closure.edge.kind)},
                                  {"verdict", toString(closure.edge.verdict)},
                                  {"reason", closure.edge.reason},
                                  {"weight", closure.edge.weight},
                                  {"added", urban_nav_store::isOfEdit(closure.edge.source)},
                                  {"a", endAsJson(closure.edge.a, closure.since_a, places)},
                                  {"b", endAsJson(closure.edge.b, closure.since_b, places)}}));
  Json& tests = json["tests"] = Json::array();
  for (const urban_nav_store::StoredTest& test : state.tests)
    if (const auto place = places.find(test.session); place != places.end())
      tests.append(testAsJson(test, place->second, begins[place->second]));
  Json& edits = json["edits"] = Json::array();
  bool any_in_force = false, any_redoable = false;
  for (const ListedEdit& edit : state.edits) {
    edits.append(Json::object({{"number", edit.number}, {"command", edit.command}, {"undone", edit.undone}}));
    any_in_force = any_in_force || !edit.undone;
    any_redoable = any_redoable || edit.redoable;
  }
  json["can_undo"] = any_in_force;
  json["can_redo"] = any_redoable;
  return json;
}

void appendPath(std::string& bytes, const std::vector<StampedPose>& path) {
  for (const StampedPose& pose : path) {
    appendFloat32(bytes, urban_nav_core::secondsBetween(path.front().stamp, pose.stamp));
    for (int axis = 0; axis < 3; ++axis) appendFloat32(bytes, pose.pose.t()(axis));
  }
}

}  // namespace urban_nav
