// SPDX-License-Identifier: BSD-3-Clause
#include "topics/places/place_export.hpp"

#include <filesystem>
#include <map>

#include "fabmap_node/store/model_rows.hpp"
#include "topics/places/stored_verdicts.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_model.hpp"
#include "urban_nav_store/tables/stored_place.hpp"

namespace urban_nav {

namespace fs = std::filesystem;

using urban_nav_core::printNumber;
using urban_nav_core::StampNs;
using urban_nav_store::StoredModel;
using urban_nav_store::StoredPlace;
using urban_nav_store::StoredTrajectory;
using urban_nav_store::TableStore;

namespace {

constexpr StampNs kMostInterpolated = 1'000'000'000;  // ns between the poses around a place
constexpr const char* kThumbnailFolder = "thumbnails";

void makeFolder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw urban_nav_core::UserError(path.string(), "cannot be made: " + error.message(), "");
}

urban_nav_core::Trajectory toTrajectory(const StoredTrajectory& stored) {
  urban_nav_core::Trajectory trajectory;
  for (const urban_nav_core::StampedPose& pose : stored.T_map_base) trajectory.append(pose.stamp, pose.pose);
  return trajectory;
}

std::vector<std::string> poseCells(const urban_nav_core::Trajectory& trajectory, StampNs stamp) {
  const auto pose = trajectory.empty() ? std::nullopt : trajectory.at(stamp, kMostInterpolated);
  if (!pose) return std::vector<std::string>(7);
  std::vector<std::string> cells;
  for (const double value :
       {pose->t().x(), pose->t().y(), pose->t().z(), pose->q().x(), pose->q().y(), pose->q().z(), pose->q().w()})
    cells.push_back(printNumber(value));
  return cells;
}

/// Writes places of sessions one after another.
class PlaceExportFolder {
 public:
  PlaceExportFolder(urban_nav_store::Store& store, const fs::path& folder)
      : store_(store), folder_(folder), verdicts_(store) {
    makeFolder(folder_ / kThumbnailFolder);
  }

  void add(const StoredTrajectory& stored) {
    const urban_nav_core::Trajectory trajectory = toTrajectory(stored);
    TableStore<StoredPlace>(store_).forEach(stored.session.id, [&](const StoredPlace& row) {
      std::vector<std::string> cells = {stored.map, stored.session.id, std::to_string(row.stamp)};
      for (std::string& cell : poseCells(trajectory, row.stamp)) cells.push_back(std::move(cell));
      for (const std::string& cell : {std::to_string(row.cameras), std::to_string(row.missing), row.status, row.model,
                                      writeThumbnail(row), verdicts_.find(row.session, row.stamp)})
        cells.push_back(cell);
      table_ += urban_nav_core::printCsvRow(cells);
      ++made_.places;
    });
    TableStore<StoredModel>(store_).forEach(stored.session.id, [&](const StoredModel& row) {
      if (row.stage == "fabmap_node") models_[row.hash] = fabmap_node::modelBytes(row, store_.path());
    });
  }

  ExportedPlaces finish() {
    write("places.csv", table_);
    for (const auto& [hash, bytes] : models_) write(hash + ".places", bytes);
    return std::move(made_);
  }
  bool empty() const { return made_.places == 0; }

 private:
  std::string writeThumbnail(const StoredPlace& row) {
    if (row.thumbnail.empty()) return "";
    const std::string name =
        std::string(kThumbnailFolder) + "/" + row.session + "_" + std::to_string(row.stamp) + ".jpg";
    urban_nav_core::writeAtomically((folder_ / name).string(), row.thumbnail);
    ++made_.thumbnails;
    return name;
  }
  void write(const std::string& name, const std::string& bytes) {
    made_.files.push_back((folder_ / name).string());
    urban_nav_core::writeAtomically(made_.files.back(), bytes);
  }

  urban_nav_store::Store& store_;
  const fs::path folder_;
  const StoredVerdicts verdicts_;
  std::string table_ = "map,session,stamp_ns,x,y,z,qx,qy,qz,qw,cameras,missing,status,model,thumbnail,verdict\n";
  std::map<std::string, std::string> models_;  // bytes by hash
  ExportedPlaces made_;
};

}  // namespace

ExportedPlaces exportPlaces(urban_nav_store::Store& store, const std::vector<std::vector<StoredTrajectory>>& maps,
                            const std::string& folder) {
  PlaceExportFolder places(store, folder);
  for (const auto& map : maps)
    for (const StoredTrajectory& session : map) places.add(session);
  if (places.empty())
    throw urban_nav_core::DataError(store.path(), "holds no places", "a map made with --stages places");
  return places.finish();
}

}  // namespace urban_nav
