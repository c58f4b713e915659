// SPDX-License-Identifier: BSD-3-Clause
#include "stages/vo/vo_state.hpp"

#include <gtest/gtest.h>

#include "input/open.hpp"
#include "stages/vo/vo_files.hpp"
#include "support/folders.hpp"
#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {
namespace {

VoRun someRun(int frames) {
  const testing::TemporaryFolder folder;
  testing::KittiStyle style;
  style.frames = frames;
  testing::makeKittiFolder(folder.file("in"), style);
  const std::unique_ptr<Source> source = openSource({folder.file("in")}, {});
  VoStage stage(swf_vo::Parameters(), source->info());
  while (const std::optional<StereoInput> input = source->next()) stage.process(*input);
  stage.finish({"a fault"}, {{0, {0.1, 0.2, 9.8}}, {50'000'000, {0.1, 0.3, 9.7}}});
  return stage.run();
}

TEST(VoState, comesBackBitByBit) {
  const VoRun run = someRun(20);
  const std::string bytes = packVoRun(run);
  std::optional<VoRun> back = unpackVoRun(bytes);
  ASSERT_TRUE(back);
  EXPECT_TRUE(packVoRun(*back) == bytes);
  back->input = run.input;
  back->camera = run.camera;
  back->T_base_camera = run.T_base_camera;
  EXPECT_EQ(trajectoryTum(*back), trajectoryTum(run));
  EXPECT_EQ(trajectoryKitti(*back), trajectoryKitti(run));
  EXPECT_EQ(covarianceCsv(*back), covarianceCsv(run));
  EXPECT_EQ(relativeCovarianceCsv(*back), relativeCovarianceCsv(run));
  EXPECT_EQ(graphG2o(*back), graphG2o(run));
  EXPECT_TRUE(landmarksPly(*back) == landmarksPly(run));
  EXPECT_EQ(statsCsv({&*back}), statsCsv({&run}));
  ASSERT_EQ(back->pictures.size(), run.pictures.size());
  EXPECT_FALSE(run.pictures.empty());
  EXPECT_EQ(back->pictures.front().jpeg, run.pictures.front().jpeg);
  EXPECT_EQ(back->faults, run.faults);
  ASSERT_EQ(back->forces.size(), 2U);
  EXPECT_EQ(back->forces[1].force, run.forces[1].force);
}

TEST(VoState, survivesAnything) {
  VoRun run = someRun(3);
  run.landmarks.erase(std::next(run.landmarks.begin(), 3), run.landmarks.end());
  const auto result = urban_nav_core::testing::fuzzText({packVoRun(run)}, [](const std::string& text) {
    if (!unpackVoRun(text)) throw urban_nav_core::DataError("x", "refused", "");
  });
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.accepted, 0);
  EXPECT_GT(result.refused, 0);
}

}  // namespace
}  // namespace urban_nav
