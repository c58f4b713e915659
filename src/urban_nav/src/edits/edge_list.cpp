// SPDX-License-Identifier: BSD-3-Clause
#include "edits/edge_list.hpp"

#include <algorithm>
#include <map>

#include "map/previous_sessions.hpp"
#include "topics/loops/explanation.hpp"
#include "urban_nav_store/edit_journal.hpp"

namespace urban_nav {

using urban_nav_store::Store;
using urban_nav_store::StoredEdit;

namespace {

/// Returns the action and arguments of an edit, quoted for a shell: "reject 3". `numbers`: IDs of the edges of the
/// store.
std::string printCommand(const StoredEdit& edit, const std::map<urban_nav_store::EdgeKey, std::int64_t>& numbers) {
  if (!edit.arguments.empty()) return edit.action + " " + edit.arguments;
  // A pin is an edge from the origin of its map, which depends on other edits; it is identified by its source.
  const auto number = std::find_if(numbers.begin(), numbers.end(), [&](const auto& each) {
    return urban_nav_store::isOfEdit(edit.edge.source) ? std::get<5>(each.first) == edit.edge.source
                                                       : each.first == edgeKey(edit.edge);
  });
  return edit.action + " " + (number == numbers.end() ? std::string("?") : std::to_string(number->second));
}

}  // namespace

std::vector<StoredClosure> listEditableClosures(Store& store) {
  std::vector<StoredClosure> closures;
  for (StoredClosure& closure : listClosures(store))
    if (closure.edge.kind != urban_nav_store::EdgeKind::Plane) closures.push_back(std::move(closure));
  return closures;
}

std::vector<ListedEdit> listEdits(Store& store) {
  const std::map<urban_nav_store::EdgeKey, std::int64_t> numbers = urban_nav_store::readEdgeNumbers(store);
  std::vector<ListedEdit> edits;
  for (const StoredEdit& edit : urban_nav_store::EditJournal(store).all())
    edits.push_back({edit.number, printCommand(edit, numbers), edit.undone, edit.undone && !edit.dropped});
  return edits;
}

std::string listEdges(Store& store) {
  std::string text = makeList(listEditableClosures(store));
  const std::vector<ListedEdit> edits = listEdits(store);
  text += edits.empty() ? "no edits\n" : "edits:\n";
  for (const ListedEdit& edit : edits)
    text += "  " + std::to_string(edit.number) + "  " + edit.command + (edit.undone ? "  (undone)" : "") + "\n";
  return text;
}

Json edgesAsJson(Store& store) {
  const PreviousSessions sessions = readPreviousSessions(store, {});
  std::map<urban_nav_store::SessionId, std::string> names;
  for (std::size_t s = 0; s < sessions.ids.size(); ++s) names[sessions.ids[s]] = sessions.names[s];
  const auto findName = [&](const urban_nav_store::SessionId& id) {
    const auto name = names.find(id);
    return name == names.end() ? id : name->second;
  };
  Json json = Json::object();
  Json& closures = json["closures"] = Json::array();
  for (const StoredClosure& closure : listEditableClosures(store)) {
    const urban_nav_store::Edge& edge = closure.edge;
    closures.append(Json::object({{"id", closure.id},
                                  {"session_a", findName(edge.a.session)},
                                  {"stamp_a_ns", edge.a.stamp},
                                  {"session_b", findName(edge.b.session)},
                                  {"stamp_b_ns", edge.b.stamp},
                                  {"kind", toString(edge.kind)},
                                  {"verdict", toString(edge.verdict)},
                                  {"reason", edge.reason},
                                  {"weight", edge.weight}}));
  }
  Json& edits = json["edits"] = Json::array();
  for (const ListedEdit& edit : listEdits(store))
    edits.append(Json::object({{"number", edit.number}, {"command", edit.command}, {"undone", edit.undone}}));
  return json;
}

}  // namespace urban_nav
