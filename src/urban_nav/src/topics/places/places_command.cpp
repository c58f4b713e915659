// SPDX-License-Identifier: BSD-3-Clause
#include "base/console.hpp"
#include "base/json.hpp"
#include "base/parameters.hpp"
#include "fabmap_node/replay/openfabmap_file.hpp"
#include "fabmap_node/replay/replay.hpp"
#include "topics/places/places.hpp"
#include "topics/places/places_actions.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace {

int runReplay(const Arguments& arguments, Console& console) {
  checkCommonOptions(arguments);
  const urban_nav_core::ThreadLimit threads(static_cast<int>(arguments.integer("threads", 0, 1, 1024)));
  const fabmap_node::ReplayModel model = fabmap_node::replayModelFromName(arguments.get("model"));
  const fabmap_node::WordSets bags = fabmap_node::readBagsOfWords(arguments.get("BOW"));
  const bool learnt = !arguments.has("tree");
  const fabmap_node::ChowLiuTree tree =
      learnt ? fabmap_node::learnChowLiuTree(bags) : fabmap_node::readTree(arguments.get("tree"));
  urban_nav_core::AtomicFile file(arguments.get("output"));
  file.write("query,place,ll,p\n");
  std::int64_t rows = 0;
  std::string line;
  fabmap_node::replay(bags, tree, model, [&file, &rows, &line](const fabmap_node::ReplayRow& row) {
    line = std::to_string(row.query) + "," + std::to_string(row.place) + ",";
    urban_nav_core::appendNumber(line, row.log_likelihood);
    line += ",";
    urban_nav_core::appendNumber(line, row.probability);
    file.write(line += "\n");
    ++rows;
  });
  file.commit();
  if (arguments.has("tree-out")) fabmap_node::writeTree(arguments.get("tree-out"), tree);
  console.info(std::to_string(bags.observations.size()) + " observations of " + std::to_string(bags.vocabulary_size) +
               " words, tree " + (learnt ? "learnt" : "read") + ", " + std::to_string(rows) + " rows");
  if (arguments.has("json")) {
    Json json = Json::object();
    json["observations"] = static_cast<std::int64_t>(bags.observations.size());
    json["words"] = static_cast<std::int64_t>(bags.vocabulary_size);
    json["rows"] = rows;
    json["information_nats"] = fabmap_node::totalInformation(tree, bags);
    urban_nav_core::writeAtomically(arguments.get("json"), json.print());
  }
  return 0;
}

Command replayAction() {
  Command action;
  action.name = "replay";
  action.summary = "Runs FAB-MAP's inference on bags of words computed elsewhere, row by row in their order.";
  action.options = {
      {"BOW",
       "",
       "bags of words as openFABMAP writes them: YAML of OpenCV, also .gz, one row per image",
       true,
       false,
       {}},
      {"--model", "NAME", "model of inference", true, false, fabmap_node::replayModelNames()},
      {"-o,--output", "OUT.csv", "table to write: query,place,ll,p; place -1 is a new place", true, false, {}},
      {"--tree", "FILE", "Chow-Liu tree in openFABMAP's format (default: trained from BOW)", false, false, {}},
      {"--tree-out", "FILE", "writes the tree that was used in the same format", false, false, {}},
      jsonOption(),
      configOption(),
      setOption(),
      threadsOption()};
  action.examples = {"urban_nav places replay bow.yml.gz --model chowliu -o likelihoods.csv --tree tree.yml.gz"};
  action.more_help = commonHelp;
  action.run = runReplay;
  return action;
}

}  // namespace

Command placesCommand() {
  Command command;
  command.name = "places";
  command.summary = "Place recognition by appearance (FAB-MAP).";
  command.actions = {placesTrainAction(), placesQueryAction(), placesEvaluateAction(), replayAction()};
  return command;
}

}  // namespace urban_nav
