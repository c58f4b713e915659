// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "base/console.hpp"
#include "base/parameters.hpp"
#include "base/plot.hpp"
#include "edits/jump.hpp"
#include "inspect/inspect.hpp"
#include "topics/loops/explanation.hpp"
#include "topics/places/place_pair.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/parameters.hpp"
#include "urban_nav_store/stored_ids.hpp"

namespace urban_nav {

using urban_nav_core::DataError;
using urban_nav_core::UserError;

namespace {

constexpr double kNear = 1.0;  // s: panoramas come twice a second

const StoredClosure& byNumber(const std::vector<StoredClosure>& closures, std::int64_t id) {
  const auto found =
      std::find_if(closures.begin(), closures.end(), [&](const StoredClosure& closure) { return closure.id == id; });
  if (found == closures.end())
    throw UserError("--closure", std::to_string(id) + ": there is no such closure",
                    closures.empty() ? "none: the store holds no closures"
                                     : "1..." + std::to_string(closures.back().id) + ", as listed without it");
  return *found;
}

/// Returns the closure nearest to two times; null if none is within kNear of both.
const StoredClosure* byTimes(const std::vector<StoredClosure>& closures, const TimeQuery& one, const TimeQuery& other) {
  const auto nearest = std::min_element(closures.begin(), closures.end(), [&](const auto& x, const auto& y) {
    return computeDistance(x, one, other) < computeDistance(y, one, other);
  });
  return nearest != closures.end() && computeDistance(*nearest, one, other) <= kNear ? &*nearest : nullptr;
}

/// Explains a pair that was never proposed.
void explainUnproposed(const Arguments& arguments, urban_nav_store::Store& store, const TimeQuery& one,
                       const TimeQuery& other, Console& console) {
  const PlacePair pair = explainPlaces(store, one, other, loadParameters(arguments).get(fabmap_node::table()));
  console.print(explain(pair));
  if (arguments.has("output")) {
    urban_nav_core::writeAtomically(arguments.get("output"), renderPage(explainOnPage(pair, store.path())));
    console.print(arguments.get("output") + "\n");
  }
  if (arguments.has("json")) urban_nav_core::writeAtomically(arguments.get("json"), explainAsJson(pair).print());
}

/// Explains the pose at a moment.
int explainJumpAt(const Arguments& arguments, Console& console) {
  if (arguments.has("T1") || arguments.has("closure"))
    throw UserError("urban_nav why", "--jump with moments or --closure", "one of them");
  urban_nav_store::Store store = urban_nav_store::openForReading(arguments.get("STORE"));
  const JumpExplanation jump = explainJump(store, arguments.get("jump"));
  console.print(explain(jump));
  if (arguments.has("output")) {
    urban_nav_core::writeAtomically(arguments.get("output"), renderPage(explainOnPage(jump, store.path())));
    console.print(arguments.get("output") + "\n");
  }
  if (arguments.has("json")) urban_nav_core::writeAtomically(arguments.get("json"), explainAsJson(jump).print());
  return 0;
}

int runWhy(const Arguments& arguments, Console& console) {
  const double cloud_half_length = loadParameters(arguments).get(urban_nav_registration::table()).cloud_half_length;
  const bool moments = arguments.has("T1") || arguments.has("T2");
  if (arguments.has("jump")) return explainJumpAt(arguments, console);
  if (arguments.has("T1") != arguments.has("T2"))
    throw UserError("urban_nav why", "one moment only", "STORE T1 T2, or STORE --closure ID");
  if (moments && arguments.has("closure")) throw UserError("urban_nav why", "moments and --closure", "one of the two");
  urban_nav_store::Store store = urban_nav_store::openForReading(arguments.get("STORE"));
  const std::vector<StoredClosure> closures = listClosures(store);
  if (!moments && !arguments.has("closure")) {
    console.print(makeList(closures));
    return 0;
  }
  const StoredClosure* found = nullptr;
  if (moments) {
    const TimeQuery one = parseTimeQuery(arguments.get("T1"), "T1"), other = parseTimeQuery(arguments.get("T2"), "T2");
    found = byTimes(closures, one, other);
    if (found == nullptr) {
      explainUnproposed(arguments, store, one, other, console);
      return 0;
    }
  } else {
    found = &byNumber(closures, arguments.integer("closure", 0, 1, 1'000'000'000));
  }
  const StoredClosure& closure = *found;
  console.print(explain(closure));
  if (arguments.has("output")) {
    urban_nav_core::writeAtomically(arguments.get("output"),
                                    renderPage(explainOnPage(closure, store, cloud_half_length)));
    console.print(arguments.get("output") + "\n");
  }
  if (arguments.has("json")) urban_nav_core::writeAtomically(arguments.get("json"), explainAsJson(closure).print());
  return 0;
}

}  // namespace

Command whyCommand() {
  Command command;
  command.name = "why";
  command.summary =
      "Explains why a loop closure was accepted, rejected or not proposed, from the evidence in a session store.";
  command.options = {
      {"STORE", "", "session.db of a map; it is only read", true, false, {}},
      {"T1",
       "",
       "a moment: s since 1970, or +S since the beginning of a session (NAME+S of that one)",
       false,
       false,
       {}},
      {"T2", "", "the other moment; without both, and without --closure, all closures are listed", false, false, {}},
      {"--closure", "ID", "the closure with this number in the list", false, false, {}},
      {"--jump",
       "T",
       "the closures that determine the pose at this moment, and how far each of them moves it",
       false,
       false,
       {}},
      {"-o,--output",
       "FILE.html",
       "the explanation as a page, with the two views, their matches and the clouds",
       false,
       false,
       {}},
      jsonOption(),
      configOption(),
      setOption(),
      threadsOption()};
  command.examples = {"urban_nav why out/session.db", "urban_nav why out/session.db +3.5 +92.1 -o why.html",
                      "urban_nav why out/session.db --closure 12", "urban_nav why out/session.db --jump +92.1"};
  command.more_help = commonHelp;
  command.run = runWhy;
  return command;
}

}  // namespace urban_nav
