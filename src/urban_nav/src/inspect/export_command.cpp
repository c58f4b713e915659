// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "base/command_parameters.hpp"
#include "base/console.hpp"
#include "base/json.hpp"
#include "base/parameters.hpp"
#include "inspect/export_options.hpp"
#include "inspect/geopackage/store_geopackage.hpp"
#include "inspect/inspect.hpp"
#include "inspect/numbered_path.hpp"
#include "inspect/results/result_recording.hpp"
#include "inspect/store_export.hpp"
#include "inspect/store_results.hpp"
#include "map/output_folder.hpp"
#include "map/stage_result.hpp"
#include "topics/labels/labelled_map.hpp"
#include "topics/lasers/map_crs.hpp"
#include "topics/lasers/map_export.hpp"
#include "topics/places/place_export.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/stored_ids.hpp"

namespace urban_nav {

using urban_nav_core::UserError;
using urban_nav_store::Store;
using urban_nav_store::StoredTrajectory;

namespace {

constexpr double kMapImageShare = 0.1;  // of memory_mb, for decoded images

using Maps = std::vector<std::vector<StoredTrajectory>>;

MapFilePaths mapFilePaths(const Arguments& arguments, std::size_t number) {
  const auto path = [&](const char* option) {
    return arguments.has(option) ? numberedPath(arguments.get(option), number) : std::string();
  };
  MapFilePaths paths{path("ply"), path("pcd"), path("las"), path("grid"), path("ortho")};
  paths.mesh = path("mesh");
  paths.geotiff = path("geotiff");
  paths.elevation = path("elevation");
  paths.slope = path("slope");
  paths.traversability = path("traversability");
  paths.octomap = path("octomap");
  paths.crs = arguments.get("crs") == "local" ? "" : arguments.get("crs");
  paths.control = arguments.get("control");
  return paths;
}

/// Throws UserError if an option is given and its file has another extension.
void checkExtension(const Arguments& arguments, const std::string& option, const std::vector<std::string>& extensions) {
  const std::string path = arguments.get(option);
  if (path.empty()) return;
  const std::string found = std::filesystem::path(path).extension().string();
  if (std::find(extensions.begin(), extensions.end(), found) == extensions.end())
    throw UserError("--" + option, path, "a name that ends in " + extensions.front());
}

void checkCrs(const Arguments& arguments) {
  const std::string crs = arguments.get("crs");
  if (arguments.has("crs") && crs != "local") parseCrs(crs);
  const auto world_file = [&](const char* option) { return withExtension(arguments.get(option), ".pgw"); };
  if (arguments.has("crs") && crs != "local" && arguments.has("ortho") && arguments.has("grid") &&
      world_file("ortho") == world_file("grid"))
    throw UserError("--ortho, --grid", "both would write " + world_file("grid"), "names that differ before the ending");
  if (!arguments.has("control")) return;
  if (!arguments.has("crs") || crs == "local" || crs == "auto")
    throw UserError("--control", arguments.has("crs") ? "--crs " + crs : "no --crs",
                    "--crs EPSG:N, the system of the surveyed points");
}

void checkFormats(const Arguments& arguments) {
  const bool any = mapFilePaths(arguments, 0).any() || arguments.has("tum") || arguments.has("kitti") ||
                   arguments.has("g2o") || arguments.has("places") || arguments.has("mcap") ||
                   arguments.has("results") || arguments.has("gpkg");
  if (!any)
    throw UserError("urban_nav export", "no format is given",
                    "--tum, --kitti, --g2o, --ply, --pcd, --las, --grid, --ortho, --geotiff, --elevation, --slope, "
                    "--traversability, --octomap, --mesh, --gpkg or --mcap FILE, or --places or --results DIR");
  checkCrs(arguments);
  const MapFilePaths placed = mapFilePaths(arguments, 0);
  if (arguments.has("crs") && !placed.areInCrs() && !arguments.has("gpkg"))
    throw UserError("--crs", "no file whose coordinates it sets",
                    "--crs with --las, --geotiff, --elevation, --slope, --traversability, --grid, --ortho, --mesh or "
                    "--gpkg FILE");
  if (arguments.has("mcap")) checkResultPath(arguments.get("mcap"));
  checkExtension(arguments, "ortho", {".png"});
  checkExtension(arguments, "mesh", {".ply"});
  checkExtension(arguments, "octomap", {".bt"});
  checkExtension(arguments, "grid", {".yaml"});
  for (const char* option : {"geotiff", "elevation", "slope", "traversability"})
    checkExtension(arguments, option, {".tif", ".tiff"});
}

/// Written files, for the user and for --json.
class Written {
 public:
  explicit Written(Console& console) : console_(console) { json_["files"] = Json::array(); }

  void write(const std::string& path, const std::string& text, const std::string& what) {
    urban_nav_core::writeAtomically(path, text);
    note(path, what);
  }
  void note(const std::string& path, const std::string& what) {
    console_.info(what);
    console_.print(path + "\n");
    Json file = Json::object();
    file["path"] = path;
    file["content"] = what;
    json_["files"].append(file);
  }
  void leftOut(const std::string& sentence) { console_.info("left out: " + sentence); }
  /// Notes the georeference of a map.
  void noteReference(const ExportedMap& made) {
    console_.info(made.crs);
    Json reference = Json::object();
    reference["epsg"] = made.epsg;
    if (made.control.empty()) reference["fixes"] = made.reference->fixes;
    reference["residual_m_median"] = made.reference->residual;
    reference["position_sigma_m"] = made.reference->position_sigma;
    reference["height_sigma_m"] = made.reference->height_sigma;
    reference["heading_sigma_deg"] = made.reference->heading_sigma * 180.0 / M_PI;
    if (!made.control.empty()) {
      Json& control = reference["control"] = Json::array();
      for (const MapCrs::ControlError& point : made.control) {
        control.append(Json::object({{"name", point.name}, {"error_m", point.error}}));
        console_.info("  " + point.name + ": " + urban_nav_core::formatNumber(point.error, 3) +
                      " m from its surveyed position");
      }
    }
    json_["crs"] = std::move(reference);
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
         (map.size() == 1 ? " session" : " sessions") + (relaxed ? "" : ", by odometry");
}

void writeMaps(Store& store, const Maps& maps, const Arguments& arguments, Written& written) {
  const double memory_mb = kMapImageShare * loadParameters(arguments).get(commandTable()).memory_mb;
  std::size_t number = 0;
  for (const std::vector<StoredTrajectory>& map : maps) {
    const MapFilePaths paths = mapFilePaths(arguments, number);
    if (!holdsMap(store, map) && (number > 0 || &map != &maps.back()))
      continue;  // the last one throws if there is no map
    const ExportedMap made = exportMap(store, map, paths, memory_mb, labelAttributes);
    if (made.reference) written.noteReference(made);
    const std::string points = made.points > 0 ? std::to_string(made.points) + " points of " : "";
    for (const std::string& path : made.files) written.note(path, points + describe(map));
    ++number;
  }
}

/// Writes the files of `map` into a folder.
void writeResults(Store& store, const Maps& maps, const Arguments& arguments, Written& written) {
  if (arguments.has("session"))
    throw UserError("--results", "not with --session", "--results for all sessions, or a single format");
  const OutputFolder folder(arguments.get("results"));
  const StoredResults results = readResults(store);
  for (const StoredResults::File& file : results.files)
    written.write(folder.file(file.name), file.content, "as map writes it");
  for (const std::string& sentence : results.left_out) written.leftOut(sentence);
  const double memory_mb = kMapImageShare * loadParameters(arguments).get(commandTable()).memory_mb;
  for (const std::vector<StoredTrajectory>& map : maps) {
    if (!holdsMap(store, map)) continue;
    MapFilePaths paths;
    paths.ply = folder.file("map" + fileSuffix(numberOfSession(store, map.front().map)) + ".ply");
    for (const std::string& path : exportMap(store, map, paths, memory_mb, labelAttributes).files)
      written.note(path, describe(map));
  }
}

int runExport(const Arguments& arguments, Console& console) {
  checkCommonOptions(arguments);
  checkFormats(arguments);
  Store store = urban_nav_store::openForReading(arguments.get("STORE"), urban_nav_store::Access::Frozen);
  const Maps maps = readMaps(store, selectSessions(store, arguments.all("session")));
  if (maps.empty()) throw urban_nav_core::DataError(store.path(), "holds no session", "");
  if (arguments.has("control") && maps.size() > 1)
    throw UserError("--control", store.path() + " holds " + std::to_string(maps.size()) + " maps",
                    "--session with the sessions of the map that the points are of");
  Written written(console);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (arguments.has("tum"))
      written.write(numberedPath(arguments.get("tum"), i), exportTum(store, maps[i]), describe(maps[i]));
    if (arguments.has("kitti"))
      written.write(numberedPath(arguments.get("kitti"), i), exportKitti(store, maps[i]), describe(maps[i]));
  }
  if (arguments.has("g2o")) {
    const ExportedGraph graph = exportG2o(store, maps);
    written.write(
        arguments.get("g2o"), graph.text,
        std::to_string(graph.vertices) + " vertices, " + std::to_string(graph.edges) + " edges" +
            (graph.left_out > 0 ? "; " + std::to_string(graph.left_out) + " that are not accepted left out" : "") +
            (graph.outside > 0 ? "; " + std::to_string(graph.outside) + " to poses that are not exported left out"
                               : ""));
  }
  if (arguments.has("places")) {
    const ExportedPlaces places = exportPlaces(store, maps, arguments.get("places"));
    for (const std::string& path : places.files)
      written.note(path,
                   std::to_string(places.places) + " places, " + std::to_string(places.thumbnails) + " thumbnails");
  }
  if (arguments.has("gpkg")) {
    writeGeoPackage(store, maps, arguments.get("gpkg"), arguments.get("crs"), arguments.get("control"));
    written.note(arguments.get("gpkg"), "trajectories, closures, coverage and quality as layers");
  }
  if (arguments.has("results")) writeResults(store, maps, arguments, written);
  if (arguments.has("mcap"))
    for (const std::string& path :
         recordResults(store, maps, arguments.get("mcap"),
                       kMapImageShare * loadParameters(arguments).get(commandTable()).memory_mb, {}))
      written.note(path, "poses, transforms, closures, places and points as MCAP");
  if (mapFilePaths(arguments, 0).any()) writeMaps(store, maps, arguments, written);
  if (arguments.has("json")) urban_nav_core::writeAtomically(arguments.get("json"), written.json().print());
  return 0;
}

}  // namespace

Command exportCommand() {
  Command command;
  command.name = "export";
  command.summary = "Writes the contents of a session store in the formats of other programs.";
  command.options = exportOptions();
  command.examples = {"urban_nav export out/session.db --tum trajectory.tum --g2o graph.g2o",
                      "urban_nav export out/session.db --las map.las --grid map.yaml --ortho map.png"};
  command.more_help = commonHelp;
  command.run = runExport;
  return command;
}

}  // namespace urban_nav
