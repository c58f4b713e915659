// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "dense_stereo/dense_stereo.hpp"

namespace dense_stereo {
namespace {

/// Middlebury pair with ground truth; skipped without the data.
class MiddleburyPair : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const char* data = std::getenv("URBAN_NAV_DATA");
    if (data == nullptr) GTEST_SKIP() << "URBAN_NAV_DATA is not set";
    const std::string folder = std::string(data) + "/dense/" + GetParam();
    left = cv::imread(folder + "/im2.png", cv::IMREAD_GRAYSCALE);
    right = cv::imread(folder + "/im6.png", cv::IMREAD_GRAYSCALE);
    truth = cv::imread(folder + "/disp2.png", cv::IMREAD_UNCHANGED);
    visible = cv::imread(folder + "/nonocc.png", cv::IMREAD_UNCHANGED);
    if (left.empty() || truth.empty()) GTEST_SKIP() << folder << " is absent";
  }
  static urban_nav_core::ImageView view(const cv::Mat& image) {
    return {image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)};
  }

  cv::Mat left, right, truth, visible;
};

TEST_P(MiddleburyPair, IsDenseAndRarelyWrong) {
  DenseStereo stereo{Parameters()};
  const DisparityImage& image = stereo.process({0, view(left), view(right)}).image;
  int pixels = 0, answered = 0, wrong = 0, sure_wrong = 0, sure = 0;
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u) {
      if (visible.at<std::uint8_t>(v, u) == 0) continue;
      ++pixels;
      if (!image.isValid(u, v)) continue;
      ++answered;
      const std::size_t at = image.index(u, v);
      const bool is_wrong = std::abs(image.disparity[at] - 0.25F * truth.at<std::uint8_t>(v, u)) > 1.0F;
      wrong += is_wrong ? 1 : 0;
      if (image.variance[at] > 0.14F * 0.14F) continue;
      ++sure;
      sure_wrong += is_wrong ? 1 : 0;
    }
  EXPECT_GT(answered, 0.95 * pixels);
  EXPECT_LT(wrong, (std::string(GetParam()) == "teddy" ? 0.05 : 0.03) * answered);
  EXPECT_LT(static_cast<double>(sure_wrong) / sure, 0.5 * wrong / answered) << "small variances mark good pixels";
}

TEST_P(MiddleburyPair, IsReportedWhenSwapped) {
  DenseStereo stereo{Parameters()};
  EXPECT_EQ(stereo.process({0, view(right), view(left)}).status.reason, static_cast<int>(Reason::Swapped));
}

INSTANTIATE_TEST_SUITE_P(QuarterSize, MiddleburyPair, ::testing::Values("teddy", "cones"));

TEST(Unmatched, ImagesOfNoiseAreLeftEmpty) {
  cv::Mat left(240, 320, CV_8UC1), right(240, 320, CV_8UC1);
  cv::RNG random(7);
  for (const double deviation : {3.0, 30.0}) {
    random.fill(left, cv::RNG::NORMAL, 128, deviation);
    random.fill(right, cv::RNG::NORMAL, 128, deviation);
    DenseStereo stereo{Parameters()};
    const urban_nav_core::ImageView l{left.data, 320, 240, 320}, r{right.data, 320, 240, 320};
    EXPECT_LT(stereo.process({0, l, r}).answered, 0.03) << deviation;
  }
}

}  // namespace
}  // namespace dense_stereo
