// SPDX-License-Identifier: BSD-3-Clause
#include "map/session_order.hpp"

#include <algorithm>
#include <map>

namespace urban_nav {

const std::vector<std::string>& stagesOfJoin() {
  static const std::vector<std::string> names = {"places", "loops", "graph", "lasers"};
  return names;
}

bool joinsSessions(const MapOptions& options, const StageList& stages) {
  const auto has = [&](const char* name) {
    return std::any_of(stages.begin(), stages.end(),
                       [&](const Stage* stage) { return stage->describe().name == name; });
  };
  return !options.store.empty() && has("places") && has("loops") && has("graph");
}

void orderSessions(MapContext& context) {
  const std::vector<urban_nav_store::SessionId> before = context.ids();
  std::vector<std::size_t> numbers(context.sessions.size());
  std::vector<std::string> names, previous_names;
  std::map<std::string, std::string> renamed;
  for (const urban_nav_store::Session& session : context.store->sessions().all()) {
    const auto known = std::find(before.begin(), before.end(), session.id);
    if (known == before.end()) continue;  // without poses
    const auto own = std::find_if(context.sessions.begin(), context.sessions.end(),
                                  [&](const MapSession& each) { return each.id == session.id; });
    if (own != context.sessions.end()) numbers[static_cast<std::size_t>(own - context.sessions.begin())] = names.size();
    names.push_back(urban_nav_input::uniqueName(
        session.name.empty() ? session.id : urban_nav_input::plainName(session.name), names));
    if (own == context.sessions.end()) previous_names.push_back(names.back());
    renamed[context.names[static_cast<std::size_t>(known - before.begin())]] = names.back();
  }
  context.numbers = std::move(numbers);
  context.names = std::move(names);
  context.previous.names = std::move(previous_names);
  for (urban_nav_core::MetricClosure& closure : context.closures)
    for (std::string* session : {&closure.a.session, &closure.b.session})
      if (const auto other = renamed.find(*session); other != renamed.end()) *session = other->second;
}

}  // namespace urban_nav
