// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/sequence_folder.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/testing/textured_room.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core::testing {
namespace {

namespace fs = std::filesystem;

class SequenceFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "sequence_folder_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    root_ = name;
  }
  void TearDown() override { fs::remove_all(root_); }

  static RenderedSequence sequence() {
    SequenceOptions options;
    options.camera = {100.0, 100.0, 63.5, 47.5, 128, 96, 0.12, 0.5};
    options.first_stamp = 0;
    return RenderedSequence(texturedRoom(), namedMotion("loop", "room", 1), options);
  }

  fs::path root_;
};

TEST_F(SequenceFolder, HoldsImagesTimesAndTruth) {
  RenderedSequence rendered = sequence();
  const fs::path folder = root_ / "new";
  ASSERT_EQ(writeSequenceFolder(rendered, 4, FaultFilter({}, 1), folder.string()), 4);
  for (int i = 0; i < 4; ++i) {
    const StereoFrame& frame = rendered.frame(i);
    const std::string name = "00000" + std::to_string(i) + ".png";
    const cv::Mat left = cv::imread((folder / "image_0" / name).string(), cv::IMREAD_UNCHANGED);
    const cv::Mat right = cv::imread((folder / "image_1" / name).string(), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(left.type(), CV_8U);
    EXPECT_EQ(std::vector<std::uint8_t>(left.datastart, left.dataend), frame.left.pixels);
    EXPECT_EQ(std::vector<std::uint8_t>(right.datastart, right.dataend), frame.right.pixels);
  }
  EXPECT_EQ(readTimes((folder / "times.txt").string()),
            (std::vector<StampNs>{0, 50'000'000, 100'000'000, 150'000'000}));
  const std::vector<Pose> poses = readKitti((folder / "poses.txt").string());
  ASSERT_EQ(poses.size(), 4U);
  EXPECT_TRUE(isApprox(poses[0], Pose(), 1e-12));
  EXPECT_TRUE(isApprox(poses[3], rendered.T_world_camera(0).inverse() * rendered.T_world_camera(3), 1e-12));
}

TEST_F(SequenceFolder, DroppedFramesAreNotCountedAndMissingImagesAreMissing) {
  RenderedSequence rendered = sequence();
  const int written =
      writeSequenceFolder(rendered, 6, FaultFilter({parseFault("drop:0.05:0.1"), parseFault("noright:0.2:0.05")}, 1),
                          (root_ / "f").string());
  EXPECT_EQ(written, 4);
  EXPECT_EQ(readTimes((root_ / "f" / "times.txt").string()),
            (std::vector<StampNs>{0, 150'000'000, 200'000'000, 250'000'000}));
  EXPECT_TRUE(fs::exists(root_ / "f" / "image_0" / "000002.png"));
  EXPECT_FALSE(fs::exists(root_ / "f" / "image_1" / "000002.png"));
  EXPECT_FALSE(fs::exists(root_ / "f" / "image_0" / "000004.png"));
}

TEST_F(SequenceFolder, AFolderWithSomethingInItIsLeftAlone) {
  RenderedSequence rendered = sequence();
  fs::create_directories(root_ / "full" / "mine");
  EXPECT_THROW(writeSequenceFolder(rendered, 1, FaultFilter({}, 1), (root_ / "full").string()), UserError);
  EXPECT_FALSE(fs::exists(root_ / "full" / "calib.txt"));
}

TEST_F(SequenceFolder, IsReadBackAsItIsRecorded) {
  RenderedSequence rendered = sequence();
  writeSequenceFolder(rendered, 3, FaultFilter({}, 1), (root_ / "f").string());
  const Recording read = readSequenceFolder((root_ / "f").string()), recorded = record(rendered, 3);
  ASSERT_EQ(recorded.frames.size(), 3U);
  ASSERT_EQ(recorded.truth.size(), 3U);
  EXPECT_EQ(recorded.camera.left.fx, read.camera.left.fx);
  EXPECT_EQ(recorded.camera.left.height, read.camera.left.height);
  EXPECT_NEAR(recorded.camera.baseline, read.camera.baseline, 1e-12);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(recorded.frames[i].stamp, read.frames[i].stamp);
    EXPECT_EQ(recorded.frames[i].left.pixels, read.frames[i].left.pixels);
    EXPECT_EQ(recorded.frames[i].right.pixels, read.frames[i].right.pixels);
    EXPECT_TRUE(isApprox(recorded.truth[i], read.truth[i], 1e-12)) << i;
  }
}

TEST_F(SequenceFolder, ReadsBackAnyPieceOfIt) {
  RenderedSequence rendered = sequence();
  const std::string folder = (root_ / "f").string();
  writeSequenceFolder(rendered, 5, FaultFilter({parseFault("noright:0.1:0.05")}, 1), folder);
  const Recording piece = readSequenceFolder(folder, 2, 2);
  ASSERT_EQ(piece.frames.size(), 2U);
  ASSERT_EQ(piece.truth.size(), 2U);
  EXPECT_TRUE(piece.frames[0].right.pixels.empty());
  const StereoFrame& drawn = rendered.frame(3);
  EXPECT_EQ(piece.frames[1].stamp, drawn.stamp);
  EXPECT_EQ(piece.frames[1].left.pixels, drawn.left.pixels);
  EXPECT_EQ(piece.frames[1].right.pixels, drawn.right.pixels);
  EXPECT_TRUE(isApprox(piece.truth[0], Pose(), 1e-12));
  EXPECT_TRUE(isApprox(piece.truth[1], rendered.T_world_camera(2).inverse() * rendered.T_world_camera(3), 1e-12));
  EXPECT_EQ(piece.camera.left.fx, 100.0);
  EXPECT_EQ(piece.camera.left.width, 128);
  EXPECT_NEAR(piece.camera.baseline, 0.12, 1e-12);
  EXPECT_EQ(readSequenceFolder(folder).frames.size(), 5U);
  EXPECT_THROW(readSequenceFolder(folder, 5), UserError);
  EXPECT_THROW(readSequenceFolder((root_ / "nowhere").string()), UserError);
}

TEST(DataFolder, IsEmptyWhereThereIsNone) { EXPECT_EQ(dataFolder("no/such/folder/anywhere"), ""); }

}  // namespace
}  // namespace urban_nav_core::testing
