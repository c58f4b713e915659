// SPDX-License-Identifier: BSD-3-Clause
#include "topics/stereo/stereo.hpp"

#include <gtest/gtest.h>

#include "base/parameters.hpp"
#include "commands/stages.hpp"
#include "map/map_pipeline.hpp"
#include "topics/stereo/stereo_pass.hpp"
#include "urban_nav_core/testing/parameter_effects.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_store/store.hpp"
#include "urban_nav_store/table_store.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Quaterniond;
using urban_nav_core::Vector3d;
using urban_nav_input::testing::readFile;
using urban_nav_input::testing::TemporaryFolder;
using urban_nav_store::DepthView;
using urban_nav_store::GroundView;

struct StoredScene {
  std::vector<GroundView> grounds;
  std::vector<DepthView> views;
};

/// Maps a rendered room with dense stereo at each keyframe of 5 cm, and reads the rows of the store.
StoredScene mapDensely(const TemporaryFolder& folder, const std::string& out, int threads) {
  MapOptions options;
  options.inputs = {folder.file("in")};
  options.out = folder.file(out);
  options.stages = {"vo", "stereo"};
  options.threads = threads;
  options.parameters = loadParameters(Arguments({}, addStageTables));
  options.parameters.set("dense_stereo.keyframe_distance=0.05");
  options.parameters.set("dense_stereo.keyframe_interval=0.1");
  Console console;
  runMap(options, makeStages(), console);
  urban_nav_store::Store store(folder.file(out + "/session.db"), urban_nav_store::Access::Read);
  StoredScene scene;
  const std::string id = store.sessions().all().front().id;
  urban_nav_store::TableStore<GroundView>(store).forEach(id, [&](const auto& row) { scene.grounds.push_back(row); });
  urban_nav_store::TableStore<DepthView>(store).forEach(id, [&](const auto& row) { scene.views.push_back(row); });
  return scene;
}

TEST(StereoStage, StoresGroundAndDepthOfKeyframesWhateverTheThreads) {
  const TemporaryFolder folder;
  urban_nav_input::testing::makeKittiFolder(folder.file("in"));
  const StoredScene one = mapDensely(folder, "one", 1), two = mapDensely(folder, "two", 2);
  ASSERT_GE(one.views.size(), 2U);
  ASSERT_EQ(one.grounds.size(), one.views.size());
  ASSERT_EQ(two.views.size(), one.views.size());
  for (std::size_t i = 0; i < one.views.size(); ++i) {
    EXPECT_EQ(one.views[i].stamp, two.views[i].stamp);
    EXPECT_EQ(one.views[i].packed, two.views[i].packed);
    EXPECT_EQ(one.grounds[i].up, two.grounds[i].up);
    EXPECT_EQ(one.grounds[i].verdict, two.grounds[i].verdict);
    const DepthView::Samples samples = one.views[i].samples();
    std::size_t answered = 0;
    for (const float disparity : samples.disparity) answered += disparity > 0.0F ? 1 : 0;
    EXPECT_GT(answered, samples.disparity.size() / 4);
    EXPECT_GT(one.views[i].baseline, 0.0);
  }
  const std::string summary = readFile(folder.file("one/summary.json"));
  for (const char* key : {"dense_stereo", "pairs", "ms_median", "valid_share"})
    EXPECT_NE(summary.find("\"" + std::string(key) + "\":"), std::string::npos) << key;
  EXPECT_NE(readFile(folder.file("one/report.html")).find("Dense stereo"), std::string::npos);
}

TEST(StereoKeyframes, AreSelectedByDistanceAngleAndTime) {
  StereoKeyframeSelector selector{dense_stereo::Parameters()};  // 0.25 m, 10 deg, 0.25 s
  const auto at = [](double x, double turn) {
    return Pose(Quaterniond(Eigen::AngleAxisd(turn, Vector3d::UnitZ())), Vector3d(x, 0.0, 0.0));
  };
  constexpr urban_nav_core::StampNs kSecond = 1'000'000'000;
  EXPECT_TRUE(selector.select(0, at(0.0, 0.0))) << "the first";
  EXPECT_FALSE(selector.select(kSecond / 10, at(1.0, 0.0))) << "too soon";
  EXPECT_TRUE(selector.select(kSecond / 2, at(1.0, 0.0)));
  EXPECT_FALSE(selector.select(2 * kSecond, at(1.2, 0.0))) << "too near";
  EXPECT_TRUE(selector.select(3 * kSecond, at(1.2, 0.2)));
  StereoKeyframeSelector resumed{dense_stereo::Parameters()};
  resumed.keep(3 * kSecond, at(1.2, 0.2));
  EXPECT_FALSE(resumed.select(4 * kSecond, at(1.3, 0.2)));
  EXPECT_TRUE(resumed.select(4 * kSecond, at(1.5, 0.2)));
}

/// Keyframes of a drive of 4 s at 0.5 m/s and 0.2 rad/s, in tenths of a second.
std::string selectKeyframes(const dense_stereo::Parameters& parameters) {
  constexpr urban_nav_core::StampNs kTenth = 100'000'000;
  StereoKeyframeSelector selector(parameters);
  std::string selected;
  for (int i = 0; i <= 40; ++i) {
    const Quaterniond q(Eigen::AngleAxisd(0.02 * i, Vector3d::UnitZ()));
    if (selector.select(kTenth * i, Pose(q, Vector3d(0.05 * i, 0.0, 0.0)))) selected += std::to_string(i) + " ";
  }
  return selected;
}

TEST(StereoKeyframes, AreSelectedOtherwiseWithOtherParameters) {
  const std::string faults = urban_nav_core::testing::findChangesWithoutEffect(
      dense_stereo::table(),
      {{"drive", selectKeyframes, {{"keyframe_distance", 0.5}, {"keyframe_angle", 0.05}, {"keyframe_interval", 1.0}}}});
  EXPECT_EQ(faults, "");
}

TEST(StereoMatcher, KeepsOtherPointsWithAnotherSpacing) {
  const TemporaryFolder folder;
  urban_nav_input::testing::makeKittiFolder(folder.file("in"));
  const auto source = urban_nav_input::openSource({folder.file("in")}, {});
  const auto frame = source->next();
  ASSERT_TRUE(frame);
  urban_nav_input::SourceInfo info = source->info();
  info.lasers.push_back(
      {"laser_left", Pose(Quaterniond(Eigen::AngleAxisd(M_PI / 2.0, Vector3d::UnitX())), Vector3d::Zero())});
  const auto pointsWith = [&](const dense_stereo::Parameters& parameters) {
    StereoMatcher matcher(parameters, info, "session", true);
    matcher.add(frame->assembled, 0, false);
    return matcher.next()->points->packed;
  };
  const std::string faults = urban_nav_core::testing::findChangesWithoutEffect(
      dense_stereo::table(), {{"a pair", pointsWith, {{"point_spacing", 0.3}}}});
  EXPECT_EQ(faults, "");
}

TEST(StereoRuns, ComeBackFromTheirBytes) {
  StereoRun run;
  run.keyframes.push_back({5, 20.0, "none", "", 0.9, 0.5, "found", 0.01, 1.1, 2000, 3});
  run.pictures.push_back({0, "caption", {1, 2, 3}, 10, 20});
  run.picture_step = 4;
  run.last_T_odom_base = Pose(Quaterniond::Identity(), Vector3d(1.0, 2.0, 3.0));
  const std::string bytes = StereoPass::packStereoRun(run);
  StereoRun back = StereoPass::unpackStereoRun(bytes);
  EXPECT_EQ(StereoPass::packStereoRun(back), bytes);
  EXPECT_EQ(back.keyframes.front().height, 1.1);
  EXPECT_THROW(StereoPass::unpackStereoRun(bytes.substr(0, bytes.size() / 2)), urban_nav_core::DataError);
}

}  // namespace
}  // namespace urban_nav
