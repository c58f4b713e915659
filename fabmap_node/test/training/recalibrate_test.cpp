// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/training/recalibrate.hpp"

#include <gtest/gtest.h>

#include "fabmap_node/training/train_model.hpp"
#include "support/synthetic_places.hpp"
#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {
namespace {

using testing::syntheticPlace;

/// Places 20 m apart, each in four observations on every day.
LocatedDay locatedDay(std::uint32_t day) {
  LocatedDay made;
  for (std::uint32_t i = 0; i < 80; ++i)
    made.push_back({i * 30'000'000'000, syntheticPlace(7000 + i / 4, day + i % 4),
                    Eigen::Vector3d(20.0 * (i / 4) + i % 4, 0.0, 0.0)});
  return made;
}

PlaceModel modelOfSyntheticDrives() {
  std::vector<TrainingDrive> drives(3);
  for (std::uint32_t d = 0; d < 3; ++d)
    for (std::uint32_t i = 0; i < 40; ++i)
      drives[d].push_back({urban_nav_core::StampNs{i} * 1'000'000'000, syntheticPlace(100 * d + i / 2, i % 2)});
  TrainingOptions options;
  options.k_means.words = 250;
  options.k_means.iterations = 4;
  return trainModel(std::move(drives), options).model;
}

TEST(Recalibrate, SeparatesPlacesOfOtherDays) {
  PlaceModel model = modelOfSyntheticDrives();
  std::vector<LocatedSite> sites = {{locatedDay(0), locatedDay(1)}};
  for (LocatedDay& day : sites[0])
    for (LocatedImage& image : day) image.observation.cameras = 5;
  const RecalibrationReport report = recalibrate(model, sites, {});
  EXPECT_GT(report.right, 30u);
  EXPECT_GT(report.wrong, 30u);
  PlaceEvidence same, other;
  same.word_ratio = same.word_margin = 1.0;
  same.look = same.look_margin = 0.8;
  other.look = 0.1;
  EXPECT_GT(model.panorama.probability(same), 0.9);
  EXPECT_LT(model.panorama.probability(other), 0.1);
}

TEST(Recalibrate, WithoutPanoramasKeepsTheirCalibrations) {
  PlaceModel model = modelOfSyntheticDrives();
  model.panorama.bias = -12.5;
  const PlaceCalibration single = model.single;
  recalibrate(model, {{locatedDay(0), locatedDay(1)}}, {});
  EXPECT_EQ(model.panorama.bias, -12.5);
  EXPECT_NE(model.single.bias, single.bias);
}

TEST(Recalibrate, StatesLowerProbabilitiesAmongSimilarSites) {
  const PlaceModel model = modelOfSyntheticDrives();
  std::vector<LocatedSite> sites = {{locatedDay(0), locatedDay(1)}};
  PlaceModel alone = model, beside_its_double = model;
  recalibrate(alone, sites, {});
  sites.push_back({locatedDay(2)});  // the same views, at another site
  recalibrate(beside_its_double, sites, {});
  PlaceEvidence same;
  same.word_ratio = same.word_margin = 1.0;
  same.look = same.look_margin = 0.8;
  same.sequence = 1.0;
  EXPECT_LT(beside_its_double.single.probability(same), alone.single.probability(same));
  ASSERT_TRUE(alone.single_sequence && beside_its_double.single_sequence);
  EXPECT_LT(beside_its_double.single_sequence->probability(same), alone.single_sequence->probability(same));
}

TEST(Recalibrate, RefusesWhatShowsNoDifference) {
  PlaceModel model = modelOfSyntheticDrives();
  EXPECT_THROW(recalibrate(model, {{locatedDay(0)}}, {}), urban_nav_core::UserError);
  EXPECT_THROW(recalibrate(model, {{locatedDay(0)}, {locatedDay(1)}}, {}), urban_nav_core::UserError);
  EXPECT_THROW(recalibrate(model, {{LocatedDay(), LocatedDay()}}, {}), urban_nav_core::UserError);
}

}  // namespace
}  // namespace fabmap_node
