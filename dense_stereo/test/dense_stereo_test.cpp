// SPDX-License-Identifier: BSD-3-Clause
#include "dense_stereo/dense_stereo.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/surfaces.hpp"
#include "urban_nav_core/testing/allocations.hpp"

namespace dense_stereo {
namespace {

using testing_support::SlantedPair;
using urban_nav_core::Health;

double medianError(const SlantedPair& scene, const DisparityImage& image, bool absolute) {
  std::vector<double> errors;
  for (int v = 8; v < image.height - 8; ++v)
    for (int u = 40; u < image.width - 8; ++u) {
      if (!image.isValid(u, v)) continue;
      const double error = static_cast<double>(image.disparity[image.index(u, v)]) - scene.disparity(u, v);
      errors.push_back(absolute ? std::abs(error) : error);
    }
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  return *middle;
}

TEST(DenseStereo, MeasuresSlantedSurfacesBetweenWholePixels) {
  const SlantedPair scene(256, 192, 20.3, 0.04, 0.09, 1.0);
  DenseStereo stereo{Parameters()};
  const StereoResult& result = stereo.process(scene.pair());
  EXPECT_EQ(result.status.health, Health::Ok) << result.status.sentence;
  EXPECT_GT(result.answered, 0.8);
  EXPECT_LT(medianError(scene, result.image, true), 0.06);
  EXPECT_NEAR(medianError(scene, result.image, false), 0.0, 0.02);
}

TEST(DenseStereo, ReportsExchangedImages) {
  const SlantedPair scene(256, 192, 20.3, 0.0, 0.0, 1.0);
  DenseStereo stereo{Parameters()};
  const StereoResult& result = stereo.process({0, scene.pair().right, scene.pair().left});
  EXPECT_EQ(result.status.health, Health::Lost);
  EXPECT_EQ(result.status.reason, static_cast<int>(Reason::Swapped));
  EXPECT_NE(result.status.sentence.find("swap"), std::string::npos);
  EXPECT_EQ(result.answered, 0.0);
}

TEST(DenseStereo, CompensatesUnequalExposureAndReportsIt) {
  const SlantedPair equal(256, 192, 20.3, 0.04, 0.09, 1.0), darker(256, 192, 20.3, 0.04, 0.09, 0.6);
  DenseStereo stereo{Parameters()};
  const double answered = stereo.process(equal.pair()).answered;
  const StereoResult& result = stereo.process(darker.pair());
  EXPECT_GT(result.answered, answered - 0.02);
  EXPECT_EQ(result.status.health, Health::Degraded);
  EXPECT_EQ(result.status.reason, static_cast<int>(Reason::ExposureDiffers));
}

TEST(DenseStereo, AnswersMissingAndUnequalImagesWithAStatus) {
  const SlantedPair scene(256, 192, 20.3, 0.0, 0.0, 1.0), larger(272, 192, 20.3, 0.0, 0.0, 1.0);
  DenseStereo stereo{Parameters()};
  EXPECT_EQ(stereo.process({}).status.reason, static_cast<int>(Reason::ImageMissing));
  const StereoResult& result = stereo.process({0, scene.pair().left, larger.pair().right});
  EXPECT_EQ(result.status.reason, static_cast<int>(Reason::SizesDiffer));
  EXPECT_NE(result.status.sentence.find("272x192"), std::string::npos) << result.status.sentence;
}

TEST(DenseStereo, ReportsByHowMuchRowsDisagree) {
  const SlantedPair scene(256, 192, 20.3, 0.0, 0.0, 1.0);
  DenseStereo stereo{Parameters()};
  EXPECT_NEAR(stereo.process(scene.pair()).row_offset, 0.0, 0.1);
  for (const int rows : {1, 3, 5}) {
    urban_nav_core::StereoPair pair =
        scene.pair();  // the right image begins above the left one, so it is shifted down
    pair.left.data += rows * pair.left.stride;
    pair.left.height -= rows;
    pair.right.height -= rows;
    const StereoResult& result = stereo.process(pair);
    EXPECT_EQ(result.status.reason, static_cast<int>(Reason::RowsDisagree)) << rows << ": " << result.status.sentence;
    EXPECT_NEAR(result.row_offset, rows, 0.5) << result.status.sentence;
  }
}

TEST(DenseStereo, EveryAnswerIsFiniteAndHasAPositiveVariance) {
  const SlantedPair scene(250, 190, 20.3, 0.04, 0.09, 1.0);
  DenseStereo stereo{Parameters()};
  const DisparityImage& image = stereo.process(scene.pair()).image;
  for (std::size_t i = 0; i < image.disparity.size(); ++i) {
    ASSERT_TRUE(std::isfinite(image.disparity[i]) && std::isfinite(image.variance[i]));
    ASSERT_EQ(image.disparity[i] >= 0.0F, image.variance[i] > 0.0F);
  }
}

TEST(DenseStereo, DependsOnNoEarlierPair) {
  const SlantedPair scene(256, 192, 20.3, 0.04, 0.09, 1.0), other(256, 192, 31.0, -0.02, 0.05, 0.8);
  DenseStereo fresh{Parameters()}, used{Parameters()};
  used.process(other.pair());
  EXPECT_EQ(fresh.process(scene.pair()).image.disparity, used.process(scene.pair()).image.disparity);
  EXPECT_EQ(fresh.process(scene.pair()).image.variance, used.process(scene.pair()).image.variance);
}

TEST(DenseStereo, AllocatesNothingInSteadyState) {
  if (!urban_nav_core::testing::countsAllocations()) GTEST_SKIP() << "allocations are not counted here";
  const SlantedPair scene(256, 192, 20.3, 0.04, 0.09, 1.0);
  DenseStereo stereo{Parameters()};
  stereo.process(scene.pair());
  const urban_nav_core::testing::AllocationCount count;
  stereo.process(scene.pair());
  EXPECT_EQ(count.sofar(), 0);
}

}  // namespace
}  // namespace dense_stereo
