// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/light.hpp"

#include <gtest/gtest.h>

#include <map>
#include <opencv2/core.hpp>

#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_sim/session.hpp"

namespace urban_nav_sim {
namespace {

/// Output of the first fifth of a second of a session, in order.
struct SessionOutput {
  std::vector<cv::Mat> stereo, panorama;
  std::vector<ViewTruth> views;
  std::vector<urban_nav_core::PlanarScan> scans;
  std::vector<urban_nav_core::Pose> truth;
};

SessionOutput run(const std::string& world, Light light, int threads = 2) {
  const urban_nav_core::ThreadLimit limit(threads);
  SessionOptions options;
  options.world = world;
  options.seed = 7;
  options.day = 2;
  options.light = light;
  options.duration = 0.2;  // a panorama and three pairs
  options.sensors = {Sensor::Stereo, Sensor::Ladybug, Sensor::Lasers};
  options.views = {Sensor::Stereo, Sensor::Ladybug, Sensor::Lasers};
  Session session(options);
  SessionOutput output;
  while (const auto arrival = session.next()) {
    output.truth.push_back(session.truth(arrival->taken));
    if (const auto* pair = std::get_if<StereoMeasurement>(&arrival->measurement)) output.stereo.push_back(pair->left);
    if (const auto* one = std::get_if<LadybugMeasurement>(&arrival->measurement)) output.panorama.push_back(one->image);
    if (const auto* one = std::get_if<LaserMeasurement>(&arrival->measurement)) output.scans.push_back(one->scan);
    if (const auto* one = std::get_if<ViewTruth>(&arrival->measurement)) output.views.push_back(*one);
  }
  return output;
}

double mean(const std::vector<cv::Mat>& images) {
  double sum = 0.0;
  for (const cv::Mat& image : images) {
    const cv::Scalar of_image = cv::mean(image);
    sum += image.channels() == 1 ? of_image[0] : (of_image[0] + of_image[1] + of_image[2]) / 3.0;
  }
  return sum / static_cast<double>(images.size());
}

/// Share of the pixels below a quarter of white in all channels.
double darkShare(const std::vector<cv::Mat>& images) {
  double dark = 0.0, all = 0.0;
  for (const cv::Mat& image : images) {
    cv::Mat is_dark;
    cv::inRange(image, cv::Scalar::all(0), cv::Scalar::all(63), is_dark);
    dark += cv::countNonZero(is_dark);
    all += static_cast<double>(is_dark.total());
  }
  return dark / all;
}

void expectSameTruth(const SessionOutput& a, const SessionOutput& b) {
  ASSERT_EQ(a.truth.size(), b.truth.size());
  for (std::size_t i = 0; i < a.truth.size(); ++i) EXPECT_TRUE(a.truth[i].matrix() == b.truth[i].matrix()) << i;
  ASSERT_EQ(a.scans.size(), b.scans.size());
  for (std::size_t i = 0; i < a.scans.size(); ++i) EXPECT_EQ(a.scans[i].ranges, b.scans[i].ranges) << i;
  ASSERT_EQ(a.views.size(), b.views.size());
  for (std::size_t i = 0; i < a.views.size(); ++i) {
    EXPECT_EQ(a.views[i].stamp, b.views[i].stamp);
    EXPECT_EQ(cv::norm(a.views[i].surface_class, b.views[i].surface_class, cv::NORM_INF), 0.0) << i;
    EXPECT_EQ(cv::countNonZero(a.views[i].depth != b.views[i].depth), 0) << i;
  }
}

class LightOfWorlds : public ::testing::TestWithParam<std::string> {};

TEST_P(LightOfWorlds, DarkensImagesAndLeavesTheTruthAndTheLasersAsTheyAre) {
  const SessionOutput day = run(GetParam(), Light::Day), dusk = run(GetParam(), Light::Dusk),
                      night = run(GetParam(), Light::Night);
  ASSERT_GE(day.stereo.size(), 2U);
  ASSERT_EQ(day.panorama.size(), 5U);
  ASSERT_GT(day.scans.size(), 10U);
  for (const auto images : {&SessionOutput::stereo, &SessionOutput::panorama}) {
    EXPECT_GT(mean(day.*images), mean(dusk.*images));
    EXPECT_GT(mean(dusk.*images), mean(night.*images));
    EXPECT_LT(darkShare(day.*images), darkShare(dusk.*images));
    EXPECT_LT(darkShare(dusk.*images), darkShare(night.*images));
    EXPECT_LT(darkShare(night.*images), 0.995);  // lamps and windows
  }
  expectSameTruth(day, dusk);
  expectSameTruth(day, night);
}

INSTANTIATE_TEST_SUITE_P(Towns, LightOfWorlds, ::testing::Values("street", "quad"),
                         [](const auto& of) { return of.param; });

TEST(SessionLight, SameBytesAtNightForAnyNumberOfThreads) {
  const SessionOutput one = run("quad", Light::Night, 1), two = run("quad", Light::Night, 2);
  ASSERT_EQ(one.stereo.size(), two.stereo.size());
  for (std::size_t i = 0; i < one.stereo.size(); ++i)
    EXPECT_EQ(cv::norm(one.stereo[i], two.stereo[i], cv::NORM_INF), 0.0);
  for (std::size_t i = 0; i < one.panorama.size(); ++i)
    EXPECT_EQ(cv::norm(one.panorama[i], two.panorama[i], cv::NORM_INF), 0.0);
}

TEST(SessionLight, WordsAreThoseOfTheList) {
  for (const Light light : {Light::Day, Light::Dusk, Light::Night}) EXPECT_EQ(parseLight(toString(light)), light);
  try {
    parseLight("dawn", "/simulator/light");
    FAIL() << "no error";
  } catch (const urban_nav_core::UserError& error) {
    const std::string text = error.what();
    for (const char* part : {"/simulator/light", "\"dawn\"", "day, dusk, night"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace urban_nav_sim
