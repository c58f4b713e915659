// SPDX-License-Identifier: BSD-3-Clause
#include "labelling/spread.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace scene_labeler {
namespace {

/// Two surfaces 20 m apart, of ten visible points each with the classes 0 and 1; one hidden point in each and one far
/// from both.
TEST(Spread, GivesHiddenPointsTheClassOfTheirSurroundings) {
  std::vector<Eigen::Vector3f> points;
  std::vector<std::uint8_t> is_shown, is_hidden;
  std::vector<float> logs;
  const auto add = [&](float x, bool shown, float p) {
    points.emplace_back(x, 0.0F, 0.0F);
    is_shown.push_back(shown ? 1 : 0);
    is_hidden.push_back(shown ? 0 : 1);
    logs.push_back(std::log(p));
    logs.push_back(std::log(1.0F - p));
  };
  for (int i = 0; i < 10; ++i) add(0.1F * static_cast<float>(i), true, 0.95F);
  for (int i = 0; i < 10; ++i) add(20.0F + 0.1F * static_cast<float>(i), true, 0.05F);
  add(0.5F, false, 0.4F);
  add(20.5F, false, 0.6F);
  add(80.0F, false, 0.4F);
  const std::vector<float> before = logs;
  spreadToHidden(points, is_shown, is_hidden, {SceneClass::Wall, SceneClass::Foliage}, logs);
  EXPECT_GT(std::exp(logs[2 * 20]), 0.8F);
  EXPECT_GT(std::exp(logs[2 * 21 + 1]), 0.8F);
  EXPECT_EQ(logs[2 * 22], before[2 * 22]) << "no neighbours";
  for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(logs[i], before[i]) << "visible points are unchanged";
  EXPECT_NEAR(std::exp(logs[40]) + std::exp(logs[41]), 1.0F, 1e-5F);
}

TEST(Spread, SurroundingsDetermineTheKindOfGroundAndShapeTheRest) {
  std::vector<Eigen::Vector3f> points;
  std::vector<float> logs;
  const auto add = [&](const std::vector<float>& p) {
    points.emplace_back(0.02F * static_cast<float>(points.size()), 0.0F, 0.0F);
    for (const float one : p) logs.push_back(std::log(one));
  };
  for (int i = 0; i < 10; ++i) add({0.03F, 0.95F, 0.02F});
  add({0.97F, 0.02F, 0.01F});        // by shape a lawn
  add({0.0001F, 0.0001F, 0.9998F});  // by shape a car
  std::vector<std::uint8_t> is_shown(12, 1), is_hidden(12, 0);
  for (const std::size_t i : {10U, 11U}) std::swap(is_shown[i], is_hidden[i]);
  spreadToHidden(points, is_shown, is_hidden, {SceneClass::Grass, SceneClass::DirtPath, SceneClass::Vehicle}, logs);
  EXPECT_GT(logs[3 * 10 + 1], logs[3 * 10]) << "dirt, as its neighbours";
  EXPECT_GT(std::exp(logs[3 * 11 + 2]), 0.9F);
}

TEST(SmoothLabels, OutvotesAStrayLabelAndKeepsLogProbabilities) {
  std::vector<Eigen::Vector3f> points;
  std::vector<float> logs;
  for (int i = 0; i < 20; ++i) {
    const float p = i == 10 ? 0.4F : 0.9F;
    points.emplace_back(0.05F * static_cast<float>(i), 0.0F, 0.0F);
    logs.push_back(std::log(p));
    logs.push_back(std::log(1.0F - p));
  }
  smoothLabels(points, std::vector<std::uint8_t>(points.size(), 1), 2, logs);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_GT(logs[2 * i], logs[2 * i + 1]) << i;
    EXPECT_NEAR(std::exp(logs[2 * i]) + std::exp(logs[2 * i + 1]), 1.0F, 1e-5F);
  }
}

}  // namespace
}  // namespace scene_labeler
