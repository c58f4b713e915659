// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/folder/kitti_sweeps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {
namespace {

using testing::TemporaryFolder;
using testing::writeFile;
using urban_nav_core::Beam;
using urban_nav_core::Sweep;

constexpr int kRings = 16, kColumns = 360, kSweeps = 12;
constexpr const char* kTr = "Tr: 0 -1 0 0.1 0 0 -1 -0.2 1 0 0 -0.3\n";

/// Points of a room, ring by ring from the top, each by rising azimuth from 0.
std::string sweepBytes() {
  std::string bytes;
  for (int ring = kRings - 1; ring >= 0; --ring)
    for (int column = 0; column < kColumns; ++column) {
      const double azimuth = 2.0 * M_PI * (column + 0.5) / kColumns, elevation = (2.0 * ring - 20.0) * M_PI / 180.0;
      const float point[] = {static_cast<float>(10.0 * std::cos(azimuth)), static_cast<float>(10.0 * std::sin(azimuth)),
                             static_cast<float>(10.0 * std::tan(elevation)), 0.5F};
      bytes.append(reinterpret_cast<const char*>(point), sizeof(point));
    }
  return bytes;
}

std::string numbered(int i, const char* form = "%06d.bin") {
  char name[32];
  std::snprintf(name, sizeof(name), form, i);
  return name;
}

void writeSweeps(const std::string& folder, const std::string& inside, int sweeps = kSweeps) {
  std::string times;
  for (int i = 0; i < sweeps; ++i) {
    writeFile(folder + "/" + inside + "/" + numbered(i), sweepBytes());
    times += std::to_string(0.1 * i + 5.0) + "\n";
  }
  writeFile(folder + "/times.txt", times);
}

SourceOptions withSweeps() {
  SourceOptions options;
  options.with_sweeps = true;
  return options;
}

std::vector<SweepInput> readAll(Source& source) {
  std::vector<SweepInput> sweeps;
  while (std::optional<SourceItem> item = source.next())
    for (SweepInput& sweep : item->sweeps) sweeps.push_back(std::move(sweep));
  return sweeps;
}

std::string catchError(const std::string& folder, const SourceOptions& options) {
  try {
    openSource({folder}, options);
  } catch (const urban_nav_core::Error& error) {
    return error.what();
  }
  return "";
}

TEST(KittiSweeps, TheBenchmarksAreDeskewed) {
  const TemporaryFolder folder;
  writeSweeps(folder.file("in"), "velodyne");
  writeFile(folder.file("in/calib.txt"), kTr);
  const auto source = openSource({folder.file("in")}, withSweeps());
  EXPECT_FALSE(source->info().has_images);
  EXPECT_EQ(source->info().frames, kSweeps);
  ASSERT_EQ(source->info().inputs.size(), 1U);
  EXPECT_EQ(source->info().inputs[0].role, "points0");
  EXPECT_TRUE(source->info().inputs[0].lidar->deskewed);
  EXPECT_EQ(source->info().inputs[0].lidar->rings, kRings);
  EXPECT_FALSE(source->info().inputs[0].lidar->times.areKnown());
  const std::vector<SweepInput> sweeps = readAll(*source);
  ASSERT_EQ(sweeps.size(), static_cast<std::size_t>(kSweeps));
  for (int i = 0; i < kSweeps; ++i) {
    const Sweep& sweep = sweeps[static_cast<std::size_t>(i)].sweep;
    EXPECT_EQ(sweep.reference, 5'000'000'000 + 100'000'000 * i);
    EXPECT_EQ(sweep.times, Sweep::Times::Deskewed);
    EXPECT_EQ(sweep.beams.size(), static_cast<std::size_t>(kRings * kColumns));
  }
  EXPECT_NEAR(sweeps[0].sweep.beams[0].intensity, 127.5F, 1e-3F);
  EXPECT_TRUE(source->sensorFindings().empty());
}

TEST(KittiSweeps, TheMountingIsThatOfTheCalibration) {
  const TemporaryFolder folder;
  writeSweeps(folder.file("in"), "velodyne_points/data");
  writeFile(folder.file("in/calib_velo_to_cam.txt"), "calib_time: 1\nR: 0 -1 0 0 0 -1 1 0 0\nT: 0.1 -0.2 -0.3\n");
  const auto raw = openSource({folder.file("in")}, withSweeps());
  const urban_nav_core::Pose T_base_lidar = raw->info().inputs.at(0).lidar->T_base_lidar;
  EXPECT_LT((T_base_lidar.t() - urban_nav_core::Vector3d(-0.3, -0.1, 0.2)).norm(), 1e-9);
  EXPECT_LT((T_base_lidar.R() - urban_nav_core::Matrix3d::Identity()).norm(), 1e-9);
  writeFile(folder.file("in/calib.txt"), "Tr: 0 -1 0 0.5 0 0 -1 -0.2 1 0 0 -0.3\n");
  const auto both = openSource({folder.file("in")}, withSweeps());
  EXPECT_NEAR(both->info().inputs.at(0).lidar->T_base_lidar.t().y(), -0.5, 1e-9) << "Tr counts";
  EXPECT_EQ(both->info().T_base_camera.R(), urban_nav_ros::opticalInBody().R());
}

TEST(KittiSweeps, RawOnesHaveTheTimeOfTheirDirection) {
  for (const char* inside : {"velodyne_points/data", "velodyne_points"}) {
    const TemporaryFolder folder;
    writeSweeps(folder.file("in"), inside);
    writeFile(folder.file("in/calib.txt"), kTr);
    const auto source = openSource({folder.file("in")}, withSweeps());
    EXPECT_FALSE(source->info().inputs.at(0).lidar->deskewed) << inside;
    const std::vector<SweepInput> sweeps = readAll(*source);
    ASSERT_EQ(sweeps.size(), static_cast<std::size_t>(kSweeps)) << inside;
    const Sweep& sweep = sweeps[3].sweep;
    EXPECT_EQ(sweep.reference, 5'300'000'000);
    EXPECT_EQ(sweep.times, Sweep::Times::Measured);
    for (const Beam& beam : sweep.beams) {
      const double azimuth =
          std::atan2(static_cast<double>(beam.direction.y()), static_cast<double>(beam.direction.x()));
      const double share = 0.5 * (1.0 - azimuth / M_PI);
      ASSERT_NEAR(1e-9 * static_cast<double>(beam.stamp - sweep.reference), 0.1 * (share - 0.5), 1e-6);
      ASSERT_NEAR(std::asin(beam.direction.z()) * 180.0 / M_PI, 2.0 * beam.ring - 20.0, 0.01);
    }
  }
}

TEST(KittiSweeps, ImagesAndSweepsAreOneSession) {
  const TemporaryFolder folder;
  testing::KittiStyle style;
  style.frames = 6;
  testing::makeKittiFolder(folder.file("in"), style);
  const std::string calibration = testing::readFile(folder.file("in/calib.txt"));
  writeFile(folder.file("in/calib.txt"), calibration + kTr);
  for (int i = 0; i < 6; ++i) writeFile(folder.file("in/velodyne/" + numbered(i)), sweepBytes());
  const auto source = openSource({folder.file("in")}, withSweeps());
  EXPECT_TRUE(source->info().has_images);
  EXPECT_EQ(source->info().inputs.size(), 3U);
  int pairs = 0;
  std::size_t sweeps = 0;
  while (const std::optional<SourceItem> item = source->next()) {
    for (const SweepInput& sweep : item->sweeps) EXPECT_LE(sweep.sweep.reference, item->assembled.pair.stamp);
    sweeps += item->sweeps.size();
    pairs += item->has_pair;
    EXPECT_EQ(sweeps, static_cast<std::size_t>(pairs)) << "a sweep comes with the pair of its time";
  }
  EXPECT_EQ(pairs, 6);
  const auto without = openSource({folder.file("in")}, {});
  while (const std::optional<SourceItem> item = without->next()) EXPECT_TRUE(item->has_pair && item->sweeps.empty());
}

TEST(KittiSweeps, FaultsAreNamedAndTheOthersRead) {
  const TemporaryFolder folder;
  writeSweeps(folder.file("in"), "velodyne_points");
  writeFile(folder.file("in/calib.txt"), kTr);
  writeFile(folder.file("in/velodyne_points/" + numbered(4)), "");
  writeFile(folder.file("in/velodyne_points/" + numbered(7)), sweepBytes().substr(0, 16 * 3000 + 7));
  std::string nan = sweepBytes();
  const float value = NAN;
  for (std::size_t i = 0; i < nan.size(); i += 4) std::memcpy(&nan[i], &value, 4);
  writeFile(folder.file("in/velodyne_points/" + numbered(9)), nan);
  const auto source = openSource({folder.file("in")}, withSweeps());
  EXPECT_EQ(readAll(*source).size(), static_cast<std::size_t>(kSweeps - 2));
  std::string kinds;
  for (const Finding& finding : source->sensorFindings()) kinds += std::string(toString(finding.kind)) + " ";
  EXPECT_NE(kinds.find("sweep_gap"), std::string::npos) << kinds;
  EXPECT_NE(kinds.find("points_invalid"), std::string::npos) << kinds;
}

TEST(KittiSweeps, UnsuitableFoldersAreNamed) {
  const TemporaryFolder folder;
  writeSweeps(folder.file("in"), "velodyne");
  EXPECT_NE(catchError(folder.file("in"), withSweeps()).find("Tr"), std::string::npos);
  EXPECT_NE(catchError(folder.file("in"), {}).find("has no images"), std::string::npos);
  writeFile(folder.file("in/calib.txt"), kTr);
  SourceOptions options = withSweeps();
  options.points.times = urban_nav_core::parsePointTimes("time,s,header");
  EXPECT_NE(catchError(folder.file("in"), options).find("points_time"), std::string::npos);
  writeFile(folder.file("in/times.txt"), "0.0\n0.1\n");
  EXPECT_NE(catchError(folder.file("in"), withSweeps()).find("2 stamps for sweeps 0 to 11"), std::string::npos);
}

TEST(KittiSweeps, TheUserDecidesWhetherTheyAreDeskewed) {
  const TemporaryFolder folder;
  writeSweeps(folder.file("in"), "velodyne");
  writeFile(folder.file("in/calib.txt"), kTr);
  SourceOptions options = withSweeps();
  options.points.deskewed = false;
  EXPECT_EQ(readAll(*openSource({folder.file("in")}, options)).front().sweep.times, Sweep::Times::Measured);
  options.points.times = urban_nav_core::PointTimes();
  EXPECT_EQ(readAll(*openSource({folder.file("in")}, options)).front().sweep.times, Sweep::Times::Unknown);
}

}  // namespace
}  // namespace urban_nav_input
