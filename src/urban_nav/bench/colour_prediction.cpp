// SPDX-License-Identifier: BSD-3-Clause
// Accuracy of map colours for held-out panoramas: every fifth panorama is removed from a copy of the store, the map is
// coloured from the others, and its projections into the removed ones are compared with them, with one gain per image.
//
//   urban_nav-bench-colour_prediction [-o FILE.json] OUT...
//
// OUT: folders of `urban_nav map --stages vo,lasers` (or more) of sessions with panoramas.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "laser_mapper/laser_map.hpp"
#include "topics/lasers/map_colour.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/pictures/stored_panorama_view.hpp"
#include "urban_nav_registration/session/adopted_calibration.hpp"
#include "urban_nav_registration/visibility/depth_map.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav::bench {

using laser_mapper::LaserMap;
using laser_mapper::MapPoint;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector3d;
using urban_nav_core::testing::cell;
using urban_nav_registration::ImagePoint;
using urban_nav_registration::Picture;
using urban_nav_store::Store;
using urban_nav_store::StoredPanorama;
using urban_nav_store::StoredPanoramaCamera;
using urban_nav_store::TableStore;

constexpr std::size_t kLeftOutShare = 5;  // one of this number
constexpr double kMemoryMb = 400.0;
constexpr double kFarthestPoint = 20.0, kNearestPoint = 0.3;  // m
constexpr StampNs kLongestGap = 500'000'000;
constexpr double kSaturated = 250.0, kDark = 4.0;

using Bgr = std::array<double, 3>;

/// Returns CIE 1976 L*a*b* of an sRGB colour, white D65.
std::array<double, 3> toLab(const Bgr& bgr) {
  std::array<double, 3> linear{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double value = std::clamp(bgr[c] / 255.0, 0.0, 1.0);
    linear[c] = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  }
  const auto [blue, green, red] = linear;
  const auto curve = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
  const double x = curve((0.4124 * red + 0.3576 * green + 0.1805 * blue) / 0.9505),
               y = curve(0.2126 * red + 0.7152 * green + 0.0722 * blue),
               z = curve((0.0193 * red + 0.1192 * green + 0.9505 * blue) / 1.089);
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

double deltaE(const Bgr& a, const Bgr& b) {
  const auto p = toLab(a), q = toLab(b);
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

/// A held-out image and the colours predicted by the map.
struct LeftOutView {
  urban_nav_core::RawCamera camera;
  Pose T_camera_map;
  Picture picture;
  urban_nav_registration::DepthMap depth;
  std::vector<Bgr> predicted, shown;

  std::optional<ImagePoint> project(const MapPoint& point) const {
    const Vector3d q = T_camera_map * point.p.cast<double>();
    if (q.z() < kNearestPoint || q.norm() > kFarthestPoint) return std::nullopt;
    const auto pixel = camera.project(q);
    if (!pixel || pixel->x() < 0.0 || pixel->y() < 0.0 || pixel->x() > picture.width - 1.0 ||
        pixel->y() > picture.height - 1.0)
      return std::nullopt;
    return ImagePoint{pixel->x(), pixel->y(), q.norm()};
  }
};

/// Removes every fifth panorama from the store and returns its views.
std::vector<LeftOutView> leaveOut(Store& store, const laser_mapper::MappedSession& session) {
  std::map<std::int64_t, StoredPanoramaCamera> cameras;
  TableStore<StoredPanoramaCamera>(store).forEach(session.id,
                                                  [&](const StoredPanoramaCamera& row) { cameras[row.camera] = row; });
  std::set<StampNs> stamps;
  TableStore<StoredPanorama> panoramas(store);
  panoramas.forEach(session.id, [&](const StoredPanorama& row) { stamps.insert(row.stamp); });
  std::set<StampNs> left_out;
  std::size_t number = 0;
  for (const StampNs stamp : stamps)
    if (number++ % kLeftOutShare == kLeftOutShare / 2) left_out.insert(stamp);
  const auto correction = urban_nav_registration::panoramaCorrection(store, session.id);
  std::vector<LeftOutView> views;
  std::vector<StoredPanorama> removed;
  panoramas.forEach(session.id, [&](const StoredPanorama& row) {
    if (left_out.count(row.stamp) == 0) return;
    const auto camera = cameras.find(row.camera);
    const auto T_map_base = session.T_map_base->at(row.stamp - correction.delay, kLongestGap);
    removed.push_back({row.session, row.camera, row.stamp, {}});
    if (camera == cameras.end() || !T_map_base) return;
    const urban_nav_core::RawCamera raw = urban_nav_registration::storedRawCamera(camera->second);
    views.push_back({raw,
                     (*T_map_base * correction.T_correction * camera->second.T_base_camera).inverse(),
                     urban_nav_registration::decodePicture(row.jpeg),
                     urban_nav_registration::DepthMap(raw.pinhole),
                     {},
                     {}});
  });
  for (const StoredPanorama& row : removed) panoramas.remove(row);
  store.commit();
  return views;
}

/// Returns the mean of the pixels covered by a map point.
Bgr patchMean(const Picture& picture, const ImagePoint& at, double edge, double focal) {
  const int half = std::clamp(static_cast<int>(std::lround(0.5 * (edge * focal / at.depth - 1.0))), 0, 3);
  const int u0 = static_cast<int>(std::lround(at.u)), v0 = static_cast<int>(std::lround(at.v));
  Bgr sum{};
  double count = 0.0;
  for (int v = std::max(0, v0 - half); v <= std::min(picture.height - 1, v0 + half); ++v)
    for (int u = std::max(0, u0 - half); u <= std::min(picture.width - 1, u0 + half); ++u) {
      const std::size_t first = 3 * static_cast<std::size_t>(v * picture.width + u);
      for (std::size_t c = 0; c < 3; ++c) sum[c] += picture.bgr[first + c];
      count += 1.0;
    }
  for (double& value : sum) value /= count;
  return sum;
}

void predict(const std::vector<MapPoint>& points, const std::vector<std::uint8_t>& is_coloured, double voxel,
             LeftOutView& view) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_coloured[i] == 0) continue;
    const MapPoint& point = points[i];
    const auto at = view.project(point);
    if (!at) continue;
    const urban_nav_registration::ViewedPoint viewed{view.T_camera_map * point.p.cast<double>(),
                                                     view.T_camera_map.q() * point.normal.cast<double>()};
    if (!view.depth.isVisible(*at, viewed)) continue;
    const Bgr shown = patchMean(view.picture, *at, voxel, view.camera.pinhole.fx);
    if (std::any_of(shown.begin(), shown.end(), [](double value) { return value < kDark || value > kSaturated; }))
      continue;
    view.predicted.push_back(
        {static_cast<double>(point.blue), static_cast<double>(point.green), static_cast<double>(point.red)});
    view.shown.push_back(shown);
  }
}

double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Returns the differences of the colours in a view after its gain, the median ratio of green.
std::vector<double> differences(const LeftOutView& view) {
  std::vector<double> ratios, made;
  for (std::size_t i = 0; i < view.shown.size(); ++i)
    if (view.predicted[i][1] > kDark) ratios.push_back(view.shown[i][1] / view.predicted[i][1]);
  const double gain = ratios.empty() ? 1.0 : quantile(ratios, 0.5);
  for (std::size_t i = 0; i < view.shown.size(); ++i) {
    Bgr scaled = view.predicted[i];
    for (double& value : scaled) value *= gain;
    made.push_back(deltaE(scaled, view.shown[i]));
  }
  return made;
}

void measure(const std::string& folder, urban_nav_core::testing::BenchTable& table) {
  const std::string path = (std::filesystem::temp_directory_path() / "urban_nav_colour_prediction.db").string();
  urban_nav_store::removeStore(path);
  std::filesystem::copy_file(std::filesystem::path(folder) / "session.db", path);
  std::optional<Store> store(std::in_place, path, urban_nav_store::Access::Write);
  const auto maps = urban_nav_store::readMaps(*store, store->sessions().all());
  const urban_nav_store::StoredTrajectory& first = maps.at(0).at(0);
  const auto parameters = laser_mapper::storedMapParameters(*store, first.session.id);
  if (!parameters) throw urban_nav_core::DataError(folder, "holds no map of laser points", "");
  const Trajectory trajectory(first.T_map_base);
  const laser_mapper::MappedSession session{first.session.id, &trajectory, nullptr};
  std::vector<LeftOutView> views = leaveOut(*store, session);
  LaserMap map(*parameters, *store, {session});
  map.load();
  const auto colouriser = makeColouriser(*store, {session}, parameters->voxel, kMemoryMb);
  if (!colouriser || views.empty()) throw urban_nav_core::DataError(folder, "holds too few panoramas", "");
  map.forEachTile([&](const laser_mapper::Tile&, const std::vector<MapPoint>& points) {
    colouriser->addSurface(points);
    for (LeftOutView& view : views)
      for (const MapPoint& point : points)
        if (const auto at = view.project(point)) view.depth.add(*at, parameters->voxel);
  });
  colouriser->equalise();
  std::size_t all = 0, coloured = 0;
  map.forEachTile([&](const laser_mapper::Tile&, std::vector<MapPoint> points) {
    for (MapPoint& point : points) point.red = point.green = point.blue = 0;  // colours are 1...255
    coloured += colouriser->colour(points);
    all += points.size();
    std::vector<std::uint8_t> is_coloured;
    for (const MapPoint& point : points) is_coloured.push_back(point.red != 0 ? 1 : 0);
    for (LeftOutView& view : views) predict(points, is_coloured, parameters->voxel, view);
  });
  std::vector<double> found;
  for (const LeftOutView& view : views) {
    const std::vector<double> of_view = differences(view);
    found.insert(found.end(), of_view.begin(), of_view.end());
  }
  const std::size_t pixels = found.size();
  table.add({std::filesystem::path(folder).filename().string(), std::to_string(colouriser->views()),
             std::to_string(views.size()), std::to_string(pixels), cell(quantile(found, 0.5), 1),
             cell(quantile(found, 0.95), 1),
             cell(100.0 * static_cast<double>(coloured) / static_cast<double>(all), 1)});
  store.reset();
  urban_nav_store::removeStore(path);
}

}  // namespace urban_nav::bench

int main(int argc, char** argv) {
  urban_nav_core::testing::BenchTable table({"session", "images that colour", "images left out", "points compared",
                                             "delta-E, median", "delta-E, 95 %", "points coloured, %"},
                                            argc, argv);
  std::string output;
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "-o" && i + 1 < argc) output = argv[++i];
    else urban_nav::bench::measure(argv[i], table);
  }
  table.note(
      "Every fifth panorama is left out and predicted, with one gain an image; differences in CIE 1976 L\\*a\\*b\\*.");
  std::fputs(table.text().c_str(), stdout);
  if (!output.empty()) table.write(output);
  return 0;
}
