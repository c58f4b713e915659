// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/image/fast.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <set>

#include "support/opencv.hpp"

namespace urban_nav_core {
namespace {

using RowColumn = std::pair<int, int>;  // v, u: in reading order

/// Noise smoothed over `sigma` px and stretched: corners of all scores.
cv::Mat randomImage(int width, int height, double sigma, unsigned seed) {
  cv::Mat image(height, width, CV_8U);
  std::mt19937 random(seed);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(random() & 255U);
  }
  if (sigma > 0.0) cv::GaussianBlur(image, image, cv::Size(), sigma);
  cv::normalize(image, image, 0, 255, cv::NORM_MINMAX);
  return image;
}

std::set<RowColumn> byOpenCv(const cv::Mat& image, int threshold) {
  std::vector<cv::KeyPoint> found;
  cv::FAST(image, found, threshold, false, cv::FastFeatureDetector::TYPE_9_16);
  std::set<RowColumn> places;
  for (const cv::KeyPoint& point : found) places.emplace(cvRound(point.pt.y), cvRound(point.pt.x));
  return places;
}

std::set<RowColumn> places(const std::vector<Corner>& corners) {
  std::set<RowColumn> result;
  for (const Corner& corner : corners) result.emplace(corner.v, corner.u);
  return result;
}

/// Definition for a single pixel: the smallest threshold at which it is not a corner.
int plainScore(const cv::Mat& image, int v, int u) {
  const int circle[16][2] = {{0, 3},  {1, 3},   {2, 2},   {3, 1},   {3, 0},  {3, -1}, {2, -2}, {1, -3},
                             {0, -3}, {-1, -3}, {-2, -2}, {-3, -1}, {-3, 0}, {-3, 1}, {-2, 2}, {-1, 3}};
  const int centre = image.at<std::uint8_t>(v, u);
  int threshold = 0;
  for (;; ++threshold) {
    bool corner = false;
    for (const int sign : {1, -1}) {
      int run = 0;
      for (int i = 0; i < 16 + 8; ++i) {
        const int p = image.at<std::uint8_t>(v + circle[i % 16][1], u + circle[i % 16][0]);
        run = sign * (p - centre) > threshold ? run + 1 : 0;
        corner |= run >= 9;
      }
    }
    if (!corner) return threshold;
  }
}

void expectAsOpenCv(const cv::Mat& image, const std::string& name) {
  Fast fast;
  for (const int threshold : {0, 5, 12, 20, 60, 200, 254}) {
    const std::vector<Corner>& corners = fast.detect(view(image), threshold, Fast::Suppression::None);
    EXPECT_EQ(places(corners), byOpenCv(image, threshold)) << name << ", threshold " << threshold;
    EXPECT_TRUE(std::is_sorted(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
      return RowColumn(a.v, a.u) < RowColumn(b.v, b.u);
    }));
  }
}

TEST(Fast, FindsTheSetOfOpenCvOnRandomImages) {
  unsigned seed = 1;
  for (const auto& [width, height] : {std::pair{160, 120}, {161, 47}, {23, 31}, {22, 22}, {21, 9}, {10, 10}, {7, 7}}) {
    for (const double sigma : {0.0, 0.8, 2.0}) {
      expectAsOpenCv(randomImage(width, height, sigma, seed++),
                     std::to_string(width) + " wide, sigma " + std::to_string(sigma));
    }
  }
}

TEST(Fast, FindsTheSetOfOpenCvOnRealImages) {
  const char* data = std::getenv("URBAN_NAV_DATA");
  const std::string file = std::string(data != nullptr ? data : "") + "/stereo/kitti06_000_050/image_0/000000.png";
  if (!std::filesystem::exists(file))
    GTEST_SKIP() << "URBAN_NAV_DATA does not name a folder with stereo/kitti06_000_050";
  expectAsOpenCv(cv::imread(file, cv::IMREAD_GRAYSCALE), file);
}

TEST(Fast, ReadsThroughAStride) {
  const cv::Mat wide = randomImage(300, 80, 0.8, 77);
  const cv::Mat inside = wide(cv::Rect(11, 5, 203, 61));
  Fast fast;
  EXPECT_EQ(places(fast.detect(view(inside), 10, Fast::Suppression::None)), byOpenCv(inside.clone(), 10));
}

TEST(Fast, ScoreIsTheSmallestThresholdThatRefuses) {
  const cv::Mat image = randomImage(90, 70, 0.8, 5);
  Fast fast;
  const std::vector<Corner>& corners = fast.detect(view(image), 3, Fast::Suppression::None);
  ASSERT_GT(corners.size(), 100U);
  for (const Corner& corner : corners) {
    EXPECT_EQ(corner.fast, plainScore(image, corner.v, corner.u)) << corner.u << ", " << corner.v;
  }
}

TEST(Fast, SuppressionKeepsLocalMaximaAndOneOfEquals) {
  cv::Mat image = randomImage(150, 110, 1.0, 6);
  image /= 12;  // few grey levels, many equal scores
  Fast fast;
  std::map<RowColumn, int> scores;
  for (const Corner& corner : fast.detect(view(image), 1, Fast::Suppression::None))
    scores[{corner.v, corner.u}] = corner.fast;
  std::set<RowColumn> expected;
  int ties = 0;
  for (const auto& [place, score] : scores) {
    bool kept = true;
    for (int dv = -1; dv <= 1; ++dv) {
      for (int du = -1; du <= 1; ++du) {
        const RowColumn other(place.first + dv, place.second + du);
        if (other == place || scores.count(other) == 0) continue;
        ties += scores[other] == score ? 1 : 0;
        if (scores[other] > score || (scores[other] == score && other < place)) kept = false;
      }
    }
    if (kept) expected.insert(place);
  }
  EXPECT_GT(ties, 20);
  EXPECT_EQ(places(fast.detect(view(image), 1, Fast::Suppression::LocalMaximum)), expected);
}

TEST(Fast, AHigherThresholdIsAFilterOnTheScore) {
  const cv::Mat image = randomImage(150, 110, 1.0, 8);
  Fast fast;
  std::vector<Corner> low = fast.detect(view(image), 5, Fast::Suppression::LocalMaximum);
  low.erase(std::remove_if(low.begin(), low.end(), [](const Corner& c) { return c.fast <= 25; }), low.end());
  EXPECT_EQ(low, fast.detect(view(image), 25, Fast::Suppression::LocalMaximum));
}

TEST(Fast, NothingInImagesThatAreFlatTinyOrAbsent) {
  Fast fast;
  const cv::Mat flat(60, 80, CV_8U, cv::Scalar(90)), tiny(6, 80, CV_8U, cv::Scalar(90));
  EXPECT_TRUE(fast.detect(view(flat), 0, Fast::Suppression::LocalMaximum).empty());
  EXPECT_TRUE(fast.detect(view(tiny), 0, Fast::Suppression::LocalMaximum).empty());
  EXPECT_TRUE(fast.detect(ImageView{}, 0, Fast::Suppression::LocalMaximum).empty());
}

}  // namespace
}  // namespace urban_nav_core
