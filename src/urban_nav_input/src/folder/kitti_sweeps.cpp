// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/folder/kitti_sweeps.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "urban_nav_core/io/kitti_lidar.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/folder/kitti_layout.hpp"

namespace urban_nav_input {

namespace fs = std::filesystem;
using urban_nav_core::CloudField;

namespace {

constexpr double kTurn = 0.1;                      // s, of KITTI's HDL-64E
constexpr std::size_t kStored = 16, kRecord = 24;  // bytes of a point: in the file, with time and ring
constexpr std::size_t kFewestRings = 8, kMostRings = 128;

float readFloat(const std::uint8_t* bytes) {
  std::uint32_t bits = 0;
  for (std::uint32_t i = 0; i < 4; ++i) bits |= static_cast<std::uint32_t>(bytes[i]) << 8U * i;
  float value = 0.0F;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

/// Returns the file of this name in the folder or above it; empty without one.
std::string findFile(const std::string& folder, const char* name) {
  const fs::path above = fs::absolute(fs::path(folder) / ".").lexically_normal().parent_path().parent_path();
  for (const fs::path& path : {fs::path(folder) / name, above / name})
    if (fs::is_regular_file(path)) return path.string();
  return {};
}

/// Returns T_camera_lidar of the rectified camera 0.
std::optional<urban_nav_core::Pose> readFirstCameraLidar(const std::string& folder) {
  const std::string calibration = (fs::path(folder) / "calib.txt").string();
  if (fs::exists(calibration))
    if (const auto T = urban_nav_core::parseKittiTr(urban_nav_core::readTextFile(calibration), calibration)) return T;
  const std::string velodyne = findFile(folder, "calib_velo_to_cam.txt");
  if (velodyne.empty()) return std::nullopt;
  const urban_nav_core::Pose T_raw_lidar =
      urban_nav_core::parseKittiVeloToCam(urban_nav_core::readTextFile(velodyne), velodyne);
  const std::string cameras = findFile(folder, "calib_cam_to_cam.txt");
  if (cameras.empty()) return T_raw_lidar;
  const auto R = urban_nav_core::parseKittiRectification(urban_nav_core::readTextFile(cameras), cameras);
  return R ? urban_nav_core::Pose(*R, urban_nav_core::Vector3d::Zero()) * T_raw_lidar : T_raw_lidar;
}

}  // namespace

std::optional<KittiSweepLayout> findKittiSweeps(const std::string& folder) {
  for (const bool is_deskewed : {true, false}) {
    const std::string name = is_deskewed ? "velodyne" : "velodyne_points";
    const fs::path outside = fs::path(folder) / name, inside = outside / "data";
    for (const fs::path& files : {inside, outside}) {
      if (!fs::is_directory(files)) continue;
      KittiSweepLayout layout{folder, name, files.string(), is_deskewed};
      if (!listKittiSweeps(layout).empty()) return layout;
    }
  }
  return std::nullopt;
}

std::map<std::int64_t, std::string> listKittiSweeps(const KittiSweepLayout& layout) {
  std::map<std::int64_t, std::string> sweeps;
  for (const fs::directory_entry& entry : fs::directory_iterator(layout.files)) {
    const std::string stem = entry.path().stem().string();
    const bool is_number =
        !stem.empty() && std::all_of(stem.begin(), stem.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    if (!is_number || entry.path().extension() != ".bin") continue;
    if (const auto number = urban_nav_core::parseInteger(stem)) sweeps[*number] = entry.path().string();
  }
  return sweeps;
}

std::vector<std::pair<urban_nav_core::StampNs, std::string>> stampKittiSweeps(const KittiSweepLayout& layout,
                                                                              double rate,
                                                                              std::vector<std::string>& notes) {
  const std::map<std::int64_t, std::string> files = listKittiSweeps(layout);
  const KittiLayout places{layout.folder, layout.files, layout.files, urban_nav_core::KittiPair::Grey};
  const std::pair<std::int64_t, std::int64_t> numbers(files.begin()->first, files.rbegin()->first);
  requireNumberedFrames(layout.files, numbers, files.size());
  const std::vector<urban_nav_core::StampNs> stamps = stampKittiFrames(places, "sweeps", numbers, rate, notes);
  std::vector<std::pair<urban_nav_core::StampNs, std::string>> stamped;
  for (const auto& [number, path] : files)
    stamped.emplace_back(stamps[static_cast<std::size_t>(number - numbers.first)], path);
  std::stable_sort(stamped.begin(), stamped.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  return stamped;
}

std::optional<urban_nav_core::Pose> readKittiLidar(const std::string& folder) {
  const std::optional<urban_nav_core::Pose> T_first_lidar = readFirstCameraLidar(folder);
  const std::optional<KittiLayout> layout = findKittiLayout(folder);
  if (!T_first_lidar || !layout) return T_first_lidar;
  return urban_nav_core::Pose(urban_nav_core::Quaterniond::Identity(), readKittiOffset(folder, layout->pair)) *
         *T_first_lidar;
}

KittiCloud::KittiCloud(const std::string& path, urban_nav_core::StampNs stamp) : stamp_(stamp) {
  std::string stored;
  try {
    stored = urban_nav_core::readBytes(path);
  } catch (const urban_nav_core::UserError& error) {
    fault_ = error.what();
    return;
  }
  if (stored.size() % kStored != 0)
    fault_ = path + ": " + std::to_string(stored.size()) + " bytes are not a multiple of the 16 bytes of a point";
  const std::size_t points = stored.size() / kStored;
  bytes_.assign(points * kRecord, 0);
  for (std::size_t i = 0; i < points; ++i) std::memcpy(&bytes_[i * kRecord], &stored[i * kStored], kStored);
  addTimesAndRings(points);
}

void KittiCloud::addTimesAndRings(std::size_t points) {
  std::vector<std::uint16_t> rings;  // from the first in the file
  rings.reserve(points);
  double before = 0.0;
  std::size_t ring = 0;
  for (std::size_t i = 0; i < points; ++i) {
    std::uint8_t* record = &bytes_[i * kRecord];
    const double x = static_cast<double>(readFloat(record)), y = static_cast<double>(readFloat(record + 4));
    const auto time = static_cast<float>(kTurn * (urban_nav_core::shareOfTurn(x, y, true) - 0.5));
    std::memcpy(record + kStored, &time, sizeof(time));
    const double azimuth = std::atan2(y, x), positive = azimuth < 0.0 ? azimuth + 2.0 * M_PI : azimuth;
    if (i > 0 && positive - before < -M_PI && ring < kMostRings) ++ring;
    before = positive;
    rings.push_back(static_cast<std::uint16_t>(ring));
  }
  has_rings_ = ring + 1 >= kFewestRings && ring + 1 <= kMostRings;
  for (std::size_t i = 0; has_rings_ && i < points; ++i) {
    // Counted from the lowest rings, which always hit the ground; top rings may have no points.
    const auto from_below = static_cast<std::uint16_t>(ring - rings[i]);
    std::memcpy(&bytes_[i * kRecord + kStored + 4], &from_below, sizeof(from_below));
  }
}

urban_nav_core::CloudView KittiCloud::view(bool is_deskewed) const {
  using Number = CloudField::Number;
  urban_nav_core::CloudView view;
  view.stamp = stamp_;
  view.width = static_cast<std::uint32_t>(bytes_.size() / kRecord);
  view.height = 1;
  view.point_step = kRecord;
  view.row_step = bytes_.size();
  view.fields = {{"x", 0, Number::Float32},
                 {"y", 4, Number::Float32},
                 {"z", 8, Number::Float32},
                 {"intensity", 12, Number::Float32}};
  if (!is_deskewed) view.fields.push_back({"azimuth", kStored, Number::Float32});
  if (has_rings_) view.fields.push_back({"ring", kStored + 4, Number::UInt16});
  view.data = bytes_.data();
  view.size = bytes_.size();
  return view;
}

}  // namespace urban_nav_input
