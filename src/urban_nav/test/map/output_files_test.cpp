// SPDX-License-Identifier: BSD-3-Clause
#include "map/output_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using urban_nav_input::testing::readFile;

SessionOdometry drive(int frames) {
  SessionOdometry run;
  for (int i = 0; i < frames; ++i) {
    SmoothedFrame settled;
    settled.stamp = 50'000'000LL * i;
    settled.T_odom_base.pose = urban_nav_core::Pose(urban_nav_core::Quaterniond::Identity(), {1.0 * i, 0.0, 0.0});
    run.settled.push_back(settled);
    OdometryFrame row;
    row.stamp = settled.stamp;
    run.frames.push_back(row);
  }
  return run;
}

/// Writes the requested files.
class FileStage final : public Stage {
 public:
  FileStage(std::string name, bool uses_closures, std::vector<std::string> files)
      : description_{name, name, true, uses_closures, false, std::move(files)} {}
  Description describe() const override { return description_; }

 private:
  Description description_;
};

class OutputFilesTest : public ::testing::Test {
 protected:
  OutputFilesTest() : context(options, console), out(folder.file("out")) {
    stages.push_back(std::make_unique<FileStage>("points", false, std::vector<std::string>{"points#.ply", "all.csv"}));
    stages.push_back(std::make_unique<FileStage>("graph", true, std::vector<std::string>{"graph#.g2o"}));
    for (const int frames : {3, 2}) {
      context.sessions.emplace_back();
      *context.sessions.back().odometry = drive(frames);
    }
    context.trajectories = odometryTrajectories(context.runs());
    for (const char* name : {"trajectory_2.tum", "trajectory_3.tum", "points_3.ply", "graph.g2o", "all.csv",
                             "closures.csv", "trajectory_old.tum", "notes.txt"})
      out.write(name, "old");
  }
  /// `selected`: the first stages.
  void write(std::size_t selected, const StageResult& of_first = {}) {
    StageList list;
    std::vector<StageResult> results(selected);
    for (std::size_t i = 0; i < selected; ++i) list.push_back(stages[i].get());
    results[0] = of_first;
    writeOutputFiles(out, context, stages, list, results);
  }
  bool has(const std::string& name) const { return std::filesystem::exists(out.file(name)); }

  const urban_nav_input::testing::TemporaryFolder folder;
  MapOptions options;
  Console console;
  MapContext context;
  const OutputFolder out;
  std::vector<std::unique_ptr<Stage>> stages;
};

TEST_F(OutputFilesTest, WritesEachSessionAndRemovesWhatIsOfEarlierRuns) {
  StageResult points;
  points.files = {{"points.ply", [] { return std::string("first"); }}, {"points_2.ply", [] { return "second"; }}};
  write(1, points);
  EXPECT_EQ(readFile(out.file("points_2.ply")), "second");
  EXPECT_NE(readFile(out.file("trajectory_2.tum")), "old");
  for (const char* name : {"trajectory.kitti", "covariance.csv", "relative_covariance_2.csv"})
    EXPECT_TRUE(has(name)) << name;
  for (const char* name : {"trajectory_3.tum", "points_3.ply", "graph.g2o", "all.csv", "closures.csv"})
    EXPECT_FALSE(has(name)) << name;
  for (const char* name : {"trajectory_old.tum", "notes.txt"}) EXPECT_TRUE(has(name)) << "not of map: " << name;
}

TEST_F(OutputFilesTest, AMapHasItsSessionsInOneFile) {
  context.trajectories[1].map = 0;
  write(2);
  EXPECT_FALSE(has("trajectory_2.tum"));
  const std::string text = readFile(out.file("trajectory.tum"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 5);
  EXPECT_EQ(readFile(out.file("closures.csv")), urban_nav_core::printClosures({}));
}

TEST_F(OutputFilesTest, PreviousSessionsStayAsTheyAre) {
  out.write("trajectory.tum", "previous");
  out.write("points.ply", "previous");
  context.previous.runs.push_back(drive(4));
  context.trajectories = odometryTrajectories(context.runs(), 1);
  write(1);
  EXPECT_EQ(readFile(out.file("trajectory.tum")), "previous");
  EXPECT_EQ(readFile(out.file("points.ply")), "previous");
  EXPECT_TRUE(has("trajectory_2.tum"));
  EXPECT_NE(readFile(out.file("trajectory_3.tum")), "old");
  EXPECT_FALSE(has("points_3.ply"));
}

TEST_F(OutputFilesTest, LocalizedPosesReplaceThoseOfTheTrajectoryAlone) {
  urban_nav_core::Trajectory localized;
  localized.append(7, urban_nav_core::Pose());
  context.trajectories[0].localized = localized;
  write(1);
  const std::string text = readFile(out.file("trajectory.tum")), kitti = readFile(out.file("trajectory.kitti"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  EXPECT_EQ(std::count(kitti.begin(), kitti.end(), '\n'), 3);
}

}  // namespace
}  // namespace urban_nav
