// SPDX-License-Identifier: BSD-3-Clause
// Colour images of KITTI folders, and the mounting of their cameras and LiDARs.
#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

#include "urban_nav_input/folder/kitti_sweeps.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav_input {
namespace {

using testing::readFile;
using testing::TemporaryFolder;
using testing::writeFile;
using urban_nav_core::Vector3d;

constexpr int kFrames = 3;
// In front of the y axis of camera 0: (0.06, 0.01, 0.02) m in its own frame.
const std::string kColourRows =
    "P2: 200 0 120 14.4 0 200 90 3.8 0 0 1 0.02\nP3: 200 0 120 -9.6 0 200 90 3.8 0 0 1 0.02\n";

/// Writes a grey pair of `image_0` and `image_1`, or a colour pair of `image_2` and `image_3`, with colour images.
std::string writeDrive(const TemporaryFolder& folder, bool with_grey_pair, int channels = 3) {
  testing::KittiStyle style;
  style.frames = kFrames;
  if (!with_grey_pair) style.left = "image_2", style.right = "image_3";
  const std::string path = folder.file("in");
  testing::makeKittiFolder(path, style);
  writeFile(path + "/calib.txt",
            readFile(path + "/calib.txt") + kColourRows + "Tr: 0 -1 0 0.1 0 0 -1 -0.2 1 0 0 -0.3\n");
  for (int i = 0; i < kFrames; ++i) {
    const cv::Mat image(180, 240, channels == 3 ? CV_8UC3 : CV_8UC1, cv::Scalar(20, 90, 200));
    std::vector<std::uint8_t> bytes;
    cv::imencode(".png", image, bytes);
    writeFile(path + "/image_2/00000" + std::to_string(i) + ".png", {bytes.begin(), bytes.end()});
  }
  return path;
}

SourceOptions withColour() {
  SourceOptions options;
  options.with_colour = true;
  return options;
}

TEST(KittiColour, ImagesNextToAGreyPairComeWithEachFrame) {
  const TemporaryFolder folder;
  const auto source = openSource({writeDrive(folder, true)}, withColour());
  ASSERT_EQ(source->info().colour_cameras.size(), 1U);
  const ColourCamera& camera = source->info().colour_cameras.front();
  EXPECT_EQ(camera.role, "colour0");
  EXPECT_EQ(camera.camera.pinhole.fx, 200.0);
  // P = K [I | t]: t = (14.4 - 120 * 0.02, 3.8 - 90 * 0.02, 200 * 0.02) / 200, and the camera is at -t.
  const Vector3d in_base = camera.T_base_camera.t() - source->info().T_base_camera.t();
  EXPECT_LT((source->info().T_base_camera.R().transpose() * in_base + Vector3d(0.06, 0.01, 0.02)).norm(), 1e-12);
  int images = 0;
  while (const std::optional<SourceItem> item = source->next())
    for (const ColourInput& input : item->colours) {
      ++images;
      EXPECT_EQ(input.stamp, item->assembled.pair.stamp);
      const cv::Mat pixels = input.image.colour().pixels;
      ASSERT_EQ(pixels.cols, 240);
      EXPECT_EQ(pixels.at<cv::Vec3b>(9, 9), cv::Vec3b(20, 90, 200));
    }
  EXPECT_EQ(images, kFrames);
  for (const std::string& note : source->info().notes) EXPECT_EQ(note.find("image_2"), std::string::npos) << note;
}

TEST(KittiColour, GreyImagesAreNamed) {
  const TemporaryFolder folder;
  const auto source = openSource({writeDrive(folder, true, 1)}, withColour());
  EXPECT_TRUE(source->info().colour_cameras.empty());
  const std::vector<std::string>& notes = source->info().notes;
  EXPECT_EQ(std::count(notes.begin(), notes.end(), "image_2 does not colour the map: its images are grey"), 1);
}

TEST(KittiColour, TheLeftImagesOfAColourPairColourTheMap) {
  const TemporaryFolder folder;
  const auto source = openSource({writeDrive(folder, false)}, withColour());
  ASSERT_EQ(source->info().colour_cameras.size(), 1U);
  EXPECT_EQ(source->info().colour_cameras.front().role, "left");
  EXPECT_TRUE(isApprox(source->info().colour_cameras.front().T_base_camera, source->info().T_base_camera, 0.0));
}

TEST(KittiColour, TheLidarOfAColourPairIsMountedRelativeToItsLeftCamera) {
  const TemporaryFolder grey, colour;
  const auto T_grey = readKittiLidar(writeDrive(grey, true)), T_colour = readKittiLidar(writeDrive(colour, false));
  ASSERT_TRUE(T_grey && T_colour);
  EXPECT_LT((T_grey->t() - Vector3d(0.1, -0.2, -0.3)).norm(), 1e-12);
  EXPECT_LT((T_colour->t() - T_grey->t() - Vector3d(0.06, 0.01, 0.02)).norm(), 1e-12);
}

}  // namespace
}  // namespace urban_nav_input
