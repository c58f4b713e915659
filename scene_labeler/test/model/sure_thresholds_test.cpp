// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/model/sure_thresholds.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "labelling/sure_rule.hpp"
#include "scene_labeler/labelling/superpixels.hpp"
#include "training/sure_validation.hpp"

namespace scene_labeler {
namespace {

/// Held-out returns of two classes without patches.
struct HeldOutSites {
  HeldOutPatches held_out;
  LabelModel model;

  HeldOutSites() {
    held_out.points.classes = 2;
    model.classes = {SceneClass::Paved, SceneClass::Wall};
  }
  /// Adds returns of class 0 with an answer of this probability; the class of the first ones is another one.
  void add(std::uint16_t site, float probability, int returns, int wrong) {
    for (int i = 0; i < returns; ++i) {
      const bool is_wrong = i < wrong;
      held_out.points.scores.push_back(std::log(probability));
      held_out.points.scores.push_back(std::log(1.0F - probability));
      held_out.points.labels.push_back(is_wrong ? 1 : 0);
      held_out.points.weights.push_back(1.0F);
      held_out.patches.push_back(kNoPatch);
      held_out.sites.push_back(site);
    }
  }
};

const SureThresholds::Row& rowAt(const SureThresholds& thresholds, float least) {
  for (const SureThresholds::Row& row : thresholds.rows())
    if (row.least >= least) return row;
  return thresholds.rows().back();
}

TEST(SureThresholds, CountWrongAnswersAmongTheSureOnesOfEqualSites) {
  HeldOutSites sites;
  for (const std::uint16_t site : {std::uint16_t{0}, std::uint16_t{1}}) {
    const int times = site == 0 ? 1 : 10;  // a site counts the same, whatever its number of returns
    sites.add(site, 0.99F, 100 * times, 1 * times);
    sites.add(site, 0.72F, 100 * times, 20 * times);
  }
  const SureThresholds thresholds = measureSureThresholds(sites.held_out, sites.model);
  EXPECT_NEAR(rowAt(thresholds, 0.5F).wrong, 0.105F, 1e-5F);
  EXPECT_NEAR(rowAt(thresholds, 0.5F).answered, 1.0F, 1e-5F);
  EXPECT_NEAR(rowAt(thresholds, 0.75F).wrong, 0.01F, 1e-5F);
  EXPECT_NEAR(rowAt(thresholds, 0.75F).answered, 0.5F, 1e-5F);
  EXPECT_FLOAT_EQ(thresholds.rowFor(0.98).least, 0.75F);
  EXPECT_FLOAT_EQ(thresholds.rowFor(0.85).least, 0.5F);
}

TEST(SureThresholds, AreRaisedWhereSitesDiffer) {
  HeldOutSites equal, apart;
  for (std::uint16_t site = 0; site < 4; ++site) {
    equal.add(site, 0.9F, 100, 2);
    apart.add(site, 0.9F, 100, site == 0 ? 8 : 0);
  }
  EXPECT_NEAR(rowAt(measureSureThresholds(equal.held_out, equal.model), 0.5F).wrong, 0.02F, 1e-5F);
  EXPECT_NEAR(rowAt(measureSureThresholds(apart.held_out, apart.model), 0.5F).wrong, 0.02F + 0.02F, 1e-5F)
      << "standard deviation of the sites over the root of their number";
}

TEST(SureThresholds, NeedTwoSites) {
  HeldOutSites one;
  one.add(3, 0.9F, 100, 2);
  EXPECT_TRUE(measureSureThresholds(one.held_out, one.model).empty());
}

TEST(SureThresholds, ThatAreNotReachedAreReplacedByTheMostPreciseOneThatAnswersAQuarter) {
  const SureThresholds thresholds(
      {{0.5F, 0.2F, 1.0F}, {0.7F, 0.1F, 0.6F}, {0.9F, 0.06F, 0.3F}, {0.99F, 0.03F, 0.01F}});
  EXPECT_FLOAT_EQ(thresholds.rowFor(0.98).least, 0.9F);
  EXPECT_FLOAT_EQ(thresholds.rowFor(0.89).least, 0.7F);
}

LabelModel modelWithThresholds() {
  LabelModel model;
  model.sure = SureThresholds({{0.5F, 0.05F, 1.0F}, {0.6F, 0.02F, 0.9F}, {0.8F, 0.01F, 0.8F}, {0.9F, 0.004F, 0.7F}});
  return model;
}

TEST(SureRules, RaiseTheThresholdWithTheNoveltyOfThePlace) {
  const LabelModel model = modelWithThresholds();
  const SureRule known(model, {false, 0.05, 0.0}), between(model, {false, 0.15, 0.0}),
      strange(model, {false, 0.4, 0.0}), other_device(model, {true, 0.0, 0.0});
  for (const float probability : {0.55F, 0.7F, 0.85F, 0.95F}) {
    EXPECT_EQ(known.isUnsure(probability, probability, false), probability < 0.6F);
    EXPECT_EQ(between.isUnsure(probability, probability, false), probability < 0.8F);
    EXPECT_EQ(strange.isUnsure(probability, probability, false), probability < 0.9F);
    EXPECT_EQ(other_device.isUnsure(probability, probability, false), probability < 0.9F);
  }
  EXPECT_FALSE(known.testsNovelty());
  EXPECT_TRUE(strange.testsNovelty());
}

TEST(SureRules, ReturnsOutsideTheTrainingDataAreUnsureOnlyWhereTheyAreRare) {
  const LabelModel model = modelWithThresholds();
  const SureRule rare(model, {false, 0.0, 0.02}), common(model, {false, 0.0, 0.5});
  EXPECT_TRUE(rare.isUnsure(0.99F, 0.99F, true));
  EXPECT_FALSE(common.isUnsure(0.99F, 0.99F, true));
  EXPECT_TRUE(common.isUnsure(0.85F, 0.85F, true));
  EXPECT_TRUE(rare.isUnsure(0.99F, 0.45F, false)) << "no class reaches half of the stated probability";
}

TEST(SureRules, FollowThePrecision) {
  LabelModel model = modelWithThresholds();
  model.precision = 0.99;
  EXPECT_TRUE(SureRule(model, {false, 0.0, 0.0}).isUnsure(0.7F, 0.7F, false));
  model.precision = 0.9;
  EXPECT_FALSE(SureRule(model, {false, 0.0, 0.0}).isUnsure(0.55F, 0.55F, false));
}

}  // namespace
}  // namespace scene_labeler
