// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include "command_line/console.hpp"
#include "command_line/json.hpp"
#include "commands/commands.hpp"
#include "inspect/store_export.hpp"
#include "pipeline/parameters.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_core::UserError;
using urban_nav_store::Access;
using urban_nav_store::Store;
using urban_nav_store::StoredTrajectory;

namespace {

using Maps = std::vector<std::vector<StoredTrajectory>>;

/// "out.tum", "out_2.tum" and so on.
std::string numbered(const std::string& path, std::size_t number) {
  if (number == 0) return path;
  const std::filesystem::path given(path);
  return (given.parent_path() / (given.stem().string() + "_" + std::to_string(number + 1) + given.extension().string()))
      .string();
}

void checkFormats(const Arguments& arguments) {
  for (const char* later : {"ply", "pcd", "las"})
    if (arguments.has(later))
      throw UserError("--" + std::string(later), "is not in this version: the store holds no map of points yet",
                      "--tum, --kitti, --g2o");
  if (!arguments.has("tum") && !arguments.has("kitti") && !arguments.has("g2o"))
    throw UserError("urban_nav export", "no format is asked for", "--tum FILE, --kitti FILE, --g2o FILE");
}

/// What is written, for the user and for --json.
class Written {
 public:
  explicit Written(Console& console) : console_(console) { json_["files"] = Json::array(); }

  void write(const std::string& path, const std::string& text, const std::string& what) {
    urban_nav_core::writeAtomically(path, text);
    console_.info(what);
    console_.print(path + "\n");
    Json file = Json::object();
    file["path"] = path;
    file["content"] = what;
    json_["files"].append(file);
  }
  const Json& json() const { return json_; }

 private:
  Console& console_;
  Json json_ = Json::object();
};

std::string describe(const std::vector<StoredTrajectory>& map) {
  std::size_t poses = 0;
  bool relaxed = true;
  for (const StoredTrajectory& each : map) {
    poses += each.T_map_base.size();
    relaxed = relaxed && each.relaxed;
  }
  return std::to_string(poses) + " poses of " + std::to_string(map.size()) +
         (map.size() == 1 ? " session" : " sessions") + (relaxed ? "" : ", as odometry says");
}

int runExport(const Arguments& arguments, Console& console) {
  checkCommonOptions(arguments);
  checkFormats(arguments);
  Store store(arguments.get("STORE"), Access::Read);
  const Maps maps = readMaps(store, selectSessions(store, arguments.all("session")));
  if (maps.empty()) throw urban_nav_core::DataError(store.path(), "holds no session", "");
  Written written(console);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (arguments.has("tum"))
      written.write(numbered(arguments.get("tum"), i), exportTum(store, maps[i]), describe(maps[i]));
    if (arguments.has("kitti"))
      written.write(numbered(arguments.get("kitti"), i), exportKitti(store, maps[i]), describe(maps[i]));
  }
  if (arguments.has("g2o")) {
    const ExportedGraph graph = exportG2o(store, maps);
    written.write(
        arguments.get("g2o"), graph.text,
        std::to_string(graph.vertices) + " vertices, " + std::to_string(graph.edges) + " edges" +
            (graph.left_out > 0 ? "; " + std::to_string(graph.left_out) + " that are not accepted left out" : ""));
  }
  if (arguments.has("json")) urban_nav_core::writeAtomically(arguments.get("json"), written.json().print());
  return 0;
}

}  // namespace

Command exportCommand() {
  Command command;
  command.name = "export";
  command.summary = "Writes what a session store holds in other programs' formats.";
  command.options = {
      {"STORE", "", "session.db of a map; it is only read", true, false, {}},
      {"--tum",
       "FILE",
       "base_link in map, a line per pose; maps that did not join go to FILE_2 and so on",
       false,
       false,
       {}},
      {"--kitti", "FILE", "the left camera relative to its first pose, a line per stereo frame", false, false, {}},
      {"--g2o", "FILE", "the pose graph: all nodes, accepted edges", false, false, {}},
      {"--ply", "FILE", "not in this version", false, false, {}},
      {"--pcd", "FILE", "not in this version", false, false, {}},
      {"--las", "FILE", "not in this version", false, false, {}},
      {"--session", "ID", "only sessions whose id or name begins so (default: all)", false, true, {}},
      jsonOption(),
      configOption(),
      setOption(),
      threadsOption()};
  command.examples = {"urban_nav export out/session.db --tum trajectory.tum --g2o graph.g2o"};
  command.more_help = commonHelp;
  command.run = runExport;
  return command;
}

}  // namespace urban_nav
