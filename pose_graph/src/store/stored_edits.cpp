// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/stored_edits.hpp"

#include <map>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/edit_journal.hpp"

namespace pose_graph {

using urban_nav_store::StoredEdit;

namespace {

const std::map<std::string, Edit::Action>& actions() {
  static const std::map<std::string, Edit::Action> all = {
      {"reject", Edit::Action::Reject}, {"accept", Edit::Action::Accept}, {"remove", Edit::Action::Remove},
      {"measure", Edit::Action::Add},   {"assert", Edit::Action::Add},    {"pin", Edit::Action::Pin},
      {"cut", Edit::Action::Cut},       {"origin", Edit::Action::Origin}};
  return all;
}

}  // namespace

std::vector<Edit> readEdits(urban_nav_store::Store& store, const std::vector<SessionId>& ids,
                            const std::vector<std::string>& names) {
  std::map<SessionId, std::string> name;
  for (std::size_t i = 0; i < ids.size(); ++i) name[ids[i]] = names[i];
  std::vector<Edit> edits;
  for (const StoredEdit& stored : urban_nav_store::EditJournal(store).standing()) {
    const auto action = actions().find(stored.action);
    if (action == actions().end())
      throw urban_nav_core::DataError(
          store.path(), "edit " + std::to_string(stored.number) + " is of an unknown kind, \"" + stored.action + "\"",
          "the edits of this version");
    if (name.count(stored.edge.a.session) == 0 || name.count(stored.edge.b.session) == 0) continue;
    Edit edit;
    edit.action = action->second;
    edit.number = stored.number;
    edit.a = {name.at(stored.edge.a.session), stored.edge.a.stamp};
    edit.b = {name.at(stored.edge.b.session), stored.edge.b.stamp};
    edit.kind = stored.edge.kind;
    edit.source = stored.edge.source;
    edit.measured = stored.edge.measured;
    edit.evidence = stored.evidence;
    edit.p_base = stored.p_base;
    edit.p_map = stored.p_map;
    edit.sigma = stored.sigma;
    edits.push_back(std::move(edit));
  }
  return edits;
}

}  // namespace pose_graph
