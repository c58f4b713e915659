// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/false_priors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "urban_nav_core/testing/dice.hpp"

namespace pose_graph {
namespace {

using urban_nav_core::testing::Dice;

constexpr int kPoses = 60;
constexpr double kStepM = 0.02, kStepRad = 0.01, kPriorM = 0.1;  // standard deviations

Rigid<2> placeOnSquare(int i) {
  Rigid<2> at;
  for (int k = 0; k < i; ++k) {
    at.t += at.R * Eigen::Vector2d(1.0, 0.0);
    if ((k + 1) % 12 == 0) at.R = at.R * Eigen::Rotation2Dd(0.5 * M_PI).toRotationMatrix();
  }
  return at;
}

std::string numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += " " + std::to_string(value);
  return text;
}

/// Draws a path whose noise is `honest` times the stated one, in its own frame.
std::string drawChain(Dice& dice, double honest = 1.0) {
  std::string text;
  for (int i = 0; i + 1 < kPoses; ++i) {
    const Rigid<2> Z = placeOnSquare(i).inverse() * placeOnSquare(i + 1);
    text += "EDGE_SE2 " + std::to_string(i) + " " + std::to_string(i + 1) +
            numbers({Z.t[0] + honest * kStepM * dice.normal(), Z.t[1] + honest * kStepM * dice.normal(),
                     std::atan2(Z.R(1, 0), Z.R(0, 0)) + honest * kStepRad * dice.normal()}) +
            numbers({1.0 / (kStepM * kStepM), 0.0, 0.0, 1.0 / (kStepM * kStepM), 0.0, 1.0 / (kStepRad * kStepRad)}) +
            "\n";
  }
  return text;
}

std::string prior(int pose, const Eigen::Vector2d& at) {
  return "EDGE_PRIOR_SE2_XY " + std::to_string(pose) + numbers({at[0], at[1]}) +
         numbers({1.0 / (kPriorM * kPriorM), 0.0, 1.0 / (kPriorM * kPriorM)}) + "\n";
}

/// Draws priors at every fifth pose, in a frame that is rotated and far away.
std::string drawPriors(Dice& dice) {
  const Eigen::Rotation2Dd turn(2.0);
  std::string text;
  for (int i = 0; i < kPoses; i += 5)
    text += prior(i, turn * placeOnSquare(i).t +
                         Eigen::Vector2d(500.0 + kPriorM * dice.normal(), -300.0 + kPriorM * dice.normal()));
  return text;
}

FileProblem<2> read(const std::string& text) {
  return makeProblem<2>(urban_nav_core::parseG2o(text, "graph.g2o"), "graph.g2o");
}

TEST(FalsePriors, CorrectOnesAreAllKept) {
  for (const double honest : {1.0, 5.0}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      Dice dice(seed);
      const std::string text = drawChain(dice, honest) + drawPriors(dice);
      const FalsePriors found = findFalsePriors(read(text));
      EXPECT_TRUE(found.rejected.empty()) << honest << ' ' << seed;
      EXPECT_EQ(found.undecided, 0u) << honest << ' ' << seed;
    }
  }
}

TEST(FalsePriors, AFewOfManyAreFound) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Dice dice(seed);
    std::string text = drawChain(dice) + drawPriors(dice);
    text += prior(33, {700.0, -260.0}) + prior(7, {503.0, -350.0}) + prior(52, {500.0, 0.0});
    const FileProblem<2> file = read(text);
    const FalsePriors found = findFalsePriors(file);
    EXPECT_EQ(found.rejected, std::vector<int>(file.priors.end() - 3, file.priors.end())) << seed;
    EXPECT_EQ(found.undecided, 0u) << seed;
  }
}

TEST(FalsePriors, OfTwoNoneIsMoreFalseThanTheOther) {
  Dice dice(1);
  const FalsePriors found = findFalsePriors(read(drawChain(dice) + prior(0, {0.0, 0.0}) + prior(40, {300.0, 0.0})));
  EXPECT_TRUE(found.rejected.empty());
  EXPECT_GT(found.undecided, 0u);
}

// The landmark is at (3, 20) in the frame of the first pose.
TEST(FalsePriors, ALandmarkTakenForAnotherIsFound) {
  Dice dice(2);
  std::string text = drawChain(dice);
  for (const int i : {3, 10, 17, 24, 31}) {
    const Rigid<2> at = placeOnSquare(i);
    Eigen::Vector2d seen = at.R.transpose() * (Eigen::Vector2d(3.0, 20.0) - at.t);
    if (i == 17) seen += Eigen::Vector2d(8.0, -5.0);
    text += "EDGE_SE2_XY " + std::to_string(i) + " 100" + numbers({seen[0], seen[1], 100.0, 0.0, 100.0}) + "\n";
  }
  const FileProblem<2> file = read(text);
  EXPECT_EQ(findFalsePriors(file).rejected, std::vector<int>{file.point_edges[2]});
}

TEST(FalsePriors, AGraphWithoutAnyHasNone) {
  Dice dice(3);
  const FalsePriors found = findFalsePriors(read(drawChain(dice)));
  EXPECT_TRUE(found.rejected.empty());
}

}  // namespace
}  // namespace pose_graph
