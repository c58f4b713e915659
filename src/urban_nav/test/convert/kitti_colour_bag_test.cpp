// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "convert/convert.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using urban_nav_input::ColourInput;
using urban_nav_input::testing::readFile;
using urban_nav_input::testing::TemporaryFolder;
using urban_nav_input::testing::writeFile;

struct ReadColours {
  urban_nav_input::SourceInfo info;
  std::vector<ColourInput> images;
};

ReadColours readColours(const std::string& input) {
  urban_nav_input::SourceOptions options;
  options.with_colour = true;
  const auto source = urban_nav_input::openSource({input}, options);
  ReadColours read;
  const auto take = [&read](const std::vector<ColourInput>& images) {
    read.images.insert(read.images.end(), images.begin(), images.end());
  };
  while (const auto item = source->next()) {
    if (item->bag_end) take(item->bag_end->colours);
    take(item->colours);
  }
  if (source->bagEnd()) take(source->bagEnd()->colours);
  take(source->colours());
  read.info = source->info();
  return read;
}

TEST(KittiColourBag, ColourImagesOfABagAreThoseOfTheFolder) {
  const TemporaryFolder folder;
  urban_nav_input::testing::KittiStyle style;
  style.frames = 3;
  const std::string in = folder.file("in");
  urban_nav_input::testing::makeKittiFolder(in, style);
  writeFile(in + "/calib.txt", readFile(in + "/calib.txt") +
                                   "P2: 200 0 120 14.4 0 200 90 3.8 0 0 1 0.02\nP3: 200 0 120 -9.6 0 200 90 3.8 0 0 1 "
                                   "0.02\n");
  for (int i = 0; i < style.frames; ++i) {
    std::vector<std::uint8_t> bytes;
    cv::imencode(".png", cv::Mat(180, 240, CV_8UC3, cv::Scalar(20, 90, 40 * i)), bytes);
    writeFile(in + "/image_2/00000" + std::to_string(i) + ".png", {bytes.begin(), bytes.end()});
  }
  Console console;
  const Converted converted = convertStereoFolder(in, folder.file("out.bag"), {}, console);
  EXPECT_EQ(converted.counts.at("/colour/image_raw/compressed"), style.frames);
  const ReadColours a = readColours(in), b = readColours(folder.file("out.bag"));
  ASSERT_EQ(a.info.colour_cameras.size(), 1U);
  ASSERT_EQ(b.info.colour_cameras.size(), 1U);
  const urban_nav_input::ColourCamera &of_a = a.info.colour_cameras[0], &of_b = b.info.colour_cameras[0];
  EXPECT_TRUE(isApprox(of_a.T_base_camera, of_b.T_base_camera, 1e-9));
  EXPECT_EQ(of_a.camera.pinhole.fx, of_b.camera.pinhole.fx);
  EXPECT_TRUE(of_b.camera.distortion.isNone());
  ASSERT_EQ(a.images.size(), static_cast<std::size_t>(style.frames));
  ASSERT_EQ(b.images.size(), a.images.size());
  for (std::size_t i = 0; i < a.images.size(); ++i)
    EXPECT_EQ(cv::norm(a.images[i].image.colour().pixels, b.images[i].image.colour().pixels, cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace urban_nav
