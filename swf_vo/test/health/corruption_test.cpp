// SPDX-License-Identifier: BSD-3-Clause
#include "health/corruption.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <random>

#include "recordings.hpp"
#include "urban_nav_core/testing/allocations.hpp"
#include "urban_nav_core/testing/faults.hpp"

namespace swf_vo {
namespace {

using namespace urban_nav_core::testing;
using urban_nav_core::ImageView;

ImageView toView(const cv::Mat& image) {
  return {image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)};
}

cv::Mat toImage(const GreyImage& grey) {
  return cv::Mat(grey.height, grey.width, CV_8U, const_cast<std::uint8_t*>(grey.pixels.data())).clone();
}

/// A view into the rendered room.
cv::Mat room() { return toImage(inTheRoom("loop", 1.0, 70).frames[10].left); }

void fillWithRubbish(cv::Mat rows, unsigned seed) {
  std::mt19937 draw(seed);
  for (int v = 0; v < rows.rows; ++v)
    for (int u = 0; u < rows.cols; ++u) rows.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(draw() & 255U);
}

cv::Mat spoilt(const cv::Mat& image, double share, unsigned seed = 1) {
  cv::Mat result = image.clone();
  std::mt19937 draw(seed);
  for (int v = 0; v < image.rows; ++v)
    if (std::uniform_real_distribution<double>()(draw) < share)
      fillWithRubbish(result.row(v), seed + 1000U * static_cast<unsigned>(v + 1));
  return result;
}

double meanDifference(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_L1) / static_cast<double>(a.total());
}

cv::Mat withNoise(const cv::Mat& image, double sigma) {
  cv::Mat noise(image.size(), CV_16S), result;
  cv::theRNG().state = 7;
  cv::randn(noise, 0.0, sigma);
  image.convertTo(result, CV_16S);
  result += noise;
  result.convertTo(result, CV_8U);
  return result;
}

/// Stripes with these widths, px, from black to white: along u, along v, or both.
cv::Mat stripes(int along_u, int along_v) {
  cv::Mat image(288, 384, CV_8U);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) {
      const int odd = (along_u > 0 ? u / along_u : 0) + (along_v > 0 ? v / along_v : 0);
      image.at<std::uint8_t>(v, u) = odd % 2 == 0 ? 0 : 255;
    }
  return image;
}

TEST(LooksCorrupted, SparesPicturesWhateverTheirTexture) {
  EXPECT_FALSE(looksCorrupted(toView(room())));
  for (const double sigma : {6.0, 20.0, 40.0}) EXPECT_FALSE(looksCorrupted(toView(withNoise(room(), sigma)))) << sigma;
  cv::Mat blurred;
  cv::GaussianBlur(room(), blurred, cv::Size(), 4.0);
  EXPECT_FALSE(looksCorrupted(toView(blurred)));
  EXPECT_FALSE(looksCorrupted(toView(room() * 4.0))) << "over-exposed";
  EXPECT_FALSE(looksCorrupted(toView(stripes(3, 0))));
  EXPECT_FALSE(looksCorrupted(toView(stripes(0, 1))));
  EXPECT_FALSE(looksCorrupted(toView(stripes(8, 8))));
  EXPECT_FALSE(looksCorrupted(toView(cv::Mat::zeros(288, 384, CV_8U))));
  EXPECT_FALSE(looksCorrupted(ImageView()));
  EXPECT_FALSE(looksCorrupted(toView(cv::Mat::zeros(1, 20, CV_8U))));
}

TEST(LooksCorrupted, FindsAnyShareOfRubbish) {
  for (const double share : {0.05, 0.1, 0.3, 0.6, 0.9, 1.0})
    for (unsigned seed = 1; seed <= 5; ++seed)
      EXPECT_TRUE(looksCorrupted(toView(spoilt(room(), share, seed)))) << share << ", " << seed;
}

TEST(LooksCorrupted, FindsHalfAnImageOfRubbish) {
  cv::Mat image = room();
  fillWithRubbish(image.rowRange(image.rows / 2, image.rows), 3);
  EXPECT_TRUE(looksCorrupted(toView(image)));
}

TEST(LooksCorrupted, ForgivesOneRow) {
  cv::Mat image = room();
  fillWithRubbish(image.row(100), 3);
  EXPECT_FALSE(looksCorrupted(toView(image)));
}

TEST(LooksCorrupted, FindsRowsThatRectificationHasBent) {
  // Barrel distortion of a wide lens: the rows at the top are displaced by 14 px.
  cv::Mat map_u(288, 384, CV_32F), map_v(288, 384, CV_32F), bent;
  for (int v = 0; v < 288; ++v)
    for (int u = 0; u < 384; ++u) {
      const float x = static_cast<float>(u) / 192.0F - 1.0F, y = static_cast<float>(v) / 144.0F - 1.0F;
      const float scale = 1.0F - 0.1F * (x * x + y * y);
      map_u.at<float>(v, u) = 192.0F * (1.0F + x * scale);
      map_v.at<float>(v, u) = 144.0F * (1.0F + y * scale);
    }
  const auto bend = [&](const cv::Mat& image) {
    cv::remap(image, bent, map_u, map_v, cv::INTER_LINEAR);
    return toView(bent);
  };
  EXPECT_FALSE(looksCorrupted(bend(room())));
  for (const double share : {0.1, 0.3, 0.6}) EXPECT_TRUE(looksCorrupted(bend(spoilt(room(), share)))) << share;
}

// Small images have few segments, and subsampled ones are not blurred by a lens.
TEST(LooksCorrupted, SparesSmallImages) {
  for (const int width : {70, 96, 128, 192})
    for (const int interpolation : {cv::INTER_NEAREST, cv::INTER_LINEAR, cv::INTER_AREA})
      for (const auto& frame : inTheRoom("loop", 1.0, 70).frames) {
        cv::Mat small;
        cv::resize(toImage(frame.left), small, {width, width * 3 / 4}, 0, 0, interpolation);
        EXPECT_FALSE(looksCorrupted(toView(small))) << width << " " << interpolation;
      }
}

TEST(LooksCorrupted, IsNoMatterOfTheImagesPlaceInMemory) {
  const cv::Mat whole = spoilt(room(), 0.3);
  EXPECT_TRUE(looksCorrupted(toView(whole(cv::Rect(7, 5, 101, 77)))));
  EXPECT_FALSE(looksCorrupted(toView(room()(cv::Rect(7, 5, 101, 77)))));
}

TEST(LooksCorrupted, AcceptsRealImages) {
  for (const char* name : {"stereo/kitti06_000_050", "stereo/kitti_raw_0926_0005"}) {
    const std::string folder = dataFolder(name);
    if (folder.empty()) GTEST_SKIP() << "URBAN_NAV_DATA names no folder with " << name;
    const Recording recording = readSequenceFolder(folder, 0, 200);
    for (const StereoFrame& frame : recording.frames) {
      EXPECT_FALSE(looksCorrupted(frame.pair().left)) << name << ", " << frame.stamp;
      EXPECT_FALSE(looksCorrupted(frame.pair().right)) << name << ", " << frame.stamp;
    }
    const cv::Mat real = toImage(recording.frames[10].left);
    EXPECT_TRUE(looksCorrupted(toView(spoilt(real, 0.1))));
  }
}

TEST(CorruptRowRepair, LeavesWhatIsGoodWhereItIs) {
  const cv::Mat left = room(), right = room(), corrupted = spoilt(right, 0.3);
  CorruptRowRepair row_repair(left.cols, left.rows);
  const auto whole = row_repair.repair({5, toView(left), toView(right)});
  EXPECT_FALSE(whole.corrupted);
  EXPECT_EQ(whole.pair.stamp, 5);
  EXPECT_EQ(whole.pair.left.data, left.data);
  EXPECT_EQ(whole.pair.right.data, right.data);
  const auto half = row_repair.repair({6, toView(left), toView(corrupted)});
  EXPECT_TRUE(half.corrupted);
  EXPECT_EQ(half.pair.left.data, left.data);
  EXPECT_NE(half.pair.right.data, corrupted.data);
  CorruptRowRepair other(left.cols - 2, left.rows);
  EXPECT_FALSE(other.repair({7, toView(corrupted), toView(corrupted)}).corrupted);
  EXPECT_FALSE(other.repair({8, ImageView(), toView(corrupted)}).corrupted);
}

TEST(CorruptRowRepair, BridgesRubbishAndNothingElse) {
  const cv::Mat good = room();
  CorruptRowRepair row_repair(good.cols, good.rows);
  for (const double share : {0.1, 0.3, 0.6}) {
    const cv::Mat bad = spoilt(good, share);
    const ImageView view = row_repair.repair({0, toView(bad), toView(good)}).pair.left;
    const cv::Mat repaired(view.height, view.width, CV_8U, const_cast<std::uint8_t*>(view.data));
    EXPECT_LT(meanDifference(repaired, good), 0.2 * meanDifference(bad, good)) << share;
    int spared = 0, changed = 0;
    for (int v = 0; v < good.rows; ++v) {
      if (meanDifference(bad.row(v), good.row(v)) > 0.0) continue;
      ++spared;
      changed += meanDifference(repaired.row(v), good.row(v)) > 0.0 ? 1 : 0;
    }
    EXPECT_LE(changed, spared / 10) << share;
  }
}

// Neither saturated strips nor missing rows have texture: corrupted rows are found within the former, and good rows are
// kept next to the latter.
TEST(CorruptRowRepair, DistinguishesAWhiteSkyFromMissingRows) {
  cv::Mat white = room();
  white.rowRange(0, 100).setTo(255);
  CorruptRowRepair row_repair(white.cols, white.rows);
  const auto repaired = [&](const cv::Mat& image) {
    const ImageView view = row_repair.repair({0, toView(image), toView(image)}).pair.left;
    return cv::Mat(view.height, view.width, CV_8U, const_cast<std::uint8_t*>(view.data));
  };
  const cv::Mat sky = repaired(spoilt(white, 0.3)).rowRange(5, 95);
  EXPECT_LT(meanDifference(sky, cv::Mat(sky.size(), CV_8U, cv::Scalar(255))), 0.5);
  cv::Mat holes = stripes(3, 0) * 0.3 + 50;
  const cv::Mat full = holes.clone();
  for (int v = 0; v < holes.rows; v += 3) holes.row(v).setTo(0);
  EXPECT_EQ(meanDifference(repaired(holes).row(100), full.row(100)), 0.0);
}

TEST(CorruptRowRepair, SurvivesNothingButRubbishAndAllocatesNothing) {
  cv::Mat corrupted(288, 384, CV_8U);
  fillWithRubbish(corrupted, 1);
  CorruptRowRepair row_repair(384, 288);
  const AllocationCount count;
  const auto repaired = row_repair.repair({0, toView(corrupted), toView(corrupted)});
  if (countsAllocations()) {
    EXPECT_EQ(count.sofar(), 0);
  }
  EXPECT_TRUE(repaired.corrupted);
  EXPECT_EQ(repaired.pair.left.width, 384);
}

}  // namespace
}  // namespace swf_vo
