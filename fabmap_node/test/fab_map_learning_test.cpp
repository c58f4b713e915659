// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "fabmap_node/fab_map.hpp"
#include "support/synthetic_model.hpp"

namespace fabmap_node {
namespace {

using testing::syntheticPlace;
using urban_nav_core::StampNs;

constexpr StampNs kLearningSecond = 1'000'000'000;
constexpr double kPlaceSpacing = 6.0;  // m between places
constexpr std::uint32_t kPlaces = 25, kFirstPlace = 5000;

const PlaceModel& learningModel() {
  static const PlaceModel model = testing::trainOnSyntheticPlaces(-6.0, {0.0, 0.0, 6.0, 12.0});
  return model;
}

/// An observation of a place in some light: the first `share` of its features are those of daylight, the others belong
/// to that light.
PlaceDescription describeInLight(std::uint32_t place, std::uint32_t light, double share, std::uint32_t noise) {
  PlaceObservation seen = syntheticPlace(place, noise);
  const PlaceObservation other = syntheticPlace(place + 100000 * light, noise);
  for (std::size_t i = static_cast<std::size_t>(share * 60.0); i < seen.features.size(); ++i)
    seen.features[i] = other.features[i];
  return PlaceDescriber(learningModel(), {}, 280).describe(seen);
}

/// Three days past the same places: by day, at dusk, and at night, which resembles dusk more than day.
class Days {
 public:
  explicit Days(bool learns) : map_(learningModel(), Parameters()) {
    drive("day", 0, 1.0);
    drive("dusk", 1, 0.5);
    if (!learns) return;
    for (std::uint32_t i = 0; i < kPlaces; ++i) confirm("day", 0, "dusk", 1, i);
  }

  void confirm(const std::string& a, std::uint32_t day_a, const std::string& b, std::uint32_t day_b, std::uint32_t i) {
    map_.confirm({{a, stamp(day_a, i)}, {b, stamp(day_b, i)}, kPlaceSpacing * i, kPlaceSpacing * i, 0.3, true});
  }
  /// Returns the belief at each place of another day, of places from `first` on.
  std::vector<PlaceBelief> drive(const std::string& name, std::uint32_t light, double share,
                                 std::uint32_t first = kFirstPlace) {
    map_.beginSession(name);
    std::vector<PlaceBelief> beliefs;
    for (std::uint32_t i = 0; i < kPlaces; ++i)
      beliefs.push_back(
          map_.process(stamp(day_, i), describeInLight(first + i, light, share, day_), kPlaceSpacing * i).belief);
    ++day_;
    return beliefs;
  }
  static StampNs stamp(std::uint32_t day, std::uint32_t i) { return (10000 * day + i) * kLearningSecond; }
  FabMap& map() { return map_; }

 private:
  FabMap map_;
  std::uint32_t day_ = 0;
};

/// Returns the probability of the place of the first day; 0 if another one is its likeliest.
double ofFirstDay(const PlaceBelief& belief, std::uint32_t i) {
  for (const LikelyPlace& place : belief.likeliest)
    if (place.at.session == "day" && place.at.stamp == Days::stamp(0, i)) return place.probability;
  return 0.0;
}

TEST(FabMapLearning, AnAppearanceOfAnotherDayMakesAPlaceMoreCertain) {
  Days knowing(true), plain(false);
  const auto with = knowing.drive("night", 1, 0.25), without = plain.drive("night", 1, 0.25);
  double sum_with = 0.0, sum_without = 0.0;
  for (std::uint32_t i = 0; i < kPlaces; ++i) {
    EXPECT_GE(ofFirstDay(with[i], i), ofFirstDay(without[i], i) - 1e-9) << i;
    sum_with += ofFirstDay(with[i], i) / kPlaces;
    sum_without += ofFirstDay(without[i], i) / kPlaces;
  }
  EXPECT_GT(sum_with, sum_without + 0.3);
  EXPECT_GT(sum_with, 0.9);
}

TEST(FabMapLearning, NothingElseBecomesKnown) {
  Days knowing(true);
  for (const PlaceBelief& belief : knowing.drive("elsewhere", 1, 0.25, 8000)) {
    EXPECT_NE(belief.knowledge, PlaceKnowledge::Known);
    EXPECT_GT(belief.p_new, 0.5);
  }
  Days again(true);
  const auto beliefs = again.drive("night", 1, 0.25);
  for (std::uint32_t i = 0; i < kPlaces; ++i)
    for (const LikelyPlace& place : beliefs[i].likeliest) {
      const bool is_right = place.at.stamp % (10000 * kLearningSecond) == i * kLearningSecond;
      EXPECT_LT(is_right ? 0.0 : place.probability, 0.9) << i;
    }
}

TEST(FabMapLearning, AWithdrawnClosureLeavesNothing) {
  Days withdrawn(true), plain(false);
  for (std::uint32_t i = 0; i < kPlaces; ++i)
    withdrawn.map().withdraw({"day", Days::stamp(0, i)}, {"dusk", Days::stamp(1, i)});
  const auto a = withdrawn.drive("night", 1, 0.25), b = plain.drive("night", 1, 0.25);
  for (std::uint32_t i = 0; i < kPlaces; ++i) {
    EXPECT_EQ(a[i].p_new, b[i].p_new) << i;
    ASSERT_EQ(a[i].likeliest.size(), b[i].likeliest.size());
  }
}

TEST(FabMapLearning, WhatIsAskedDoesNotGrowWithTheNumberOfDays) {
  Days days(true);
  constexpr std::uint32_t kDays = 12;
  for (std::uint32_t day = 2; day < kDays; ++day) {
    const std::string name = std::to_string(day);
    days.drive(name, day, 0.5);
    for (std::uint32_t i = 0; i < kPlaces; ++i) days.confirm("day", 0, name, day, i);
  }
  EXPECT_EQ(days.map().places(), kDays * kPlaces);
  EXPECT_EQ(days.map().places() - days.map().forgotten(), PlaceGroups::kMostAppearances * kPlaces);
}

TEST(FabMapLearning, ConfirmationsOfUnknownSessionsAreIgnored) {
  Days days(false);
  days.confirm("sunday", 0, "dusk", 1, 3);
  days.confirm("day", 0, "sunday", 1, 3);
  EXPECT_EQ(days.map().forgotten(), 0U);
}

}  // namespace
}  // namespace fabmap_node
