// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/fab_map.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "support/synthetic_model.hpp"

namespace fabmap_node {
namespace {

using testing::syntheticPlace;
using urban_nav_core::StampNs;

constexpr StampNs kPlaceSecond = 1'000'000'000;

/// Model of synthetic places, with a calibration that announces clear matches.
const PlaceModel& syntheticModel() {
  static const PlaceModel model = testing::trainOnSyntheticPlaces(-20.0, {0.0, 0.0, 60.0, 0.0});
  return model;
}

PlaceDescription describeNumber(std::uint32_t number, std::uint32_t noise) {
  return PlaceDescriber(syntheticModel(), {}, 280).describe(syntheticPlace(number, noise));
}

TEST(FabMap, GivesTheSameWithDescriptorsReadFromTheStore) {
  std::map<std::pair<std::size_t, StampNs>, std::string> looks;
  FabMap plain(syntheticModel(), Parameters());
  FabMap reading(syntheticModel(), Parameters(), [&looks](std::size_t session, StampNs stamp) {
    return looks.at({session, stamp});
  });
  std::size_t closures = 0;
  for (std::uint32_t day = 0; day < 2; ++day) {
    plain.beginSession("day");
    reading.beginSession("day");
    for (std::uint32_t i = 0; i < 30; ++i) {
      const StampNs stamp = (1000 * day + i) * kPlaceSecond;
      const PlaceDescription description = describeNumber(5000 + i, day);
      const PlaceOutput a = plain.process(stamp, description, 6.0 * i),
                        b = reading.process(stamp, description, 6.0 * i);
      looks[{day, stamp}] = description.look;
      EXPECT_EQ(a.belief.p_new, b.belief.p_new) << i;
      EXPECT_EQ(a.belief.agreeing, b.belief.agreeing) << i;
      ASSERT_EQ(a.closures.size(), b.closures.size()) << i;
      closures += a.closures.size();
    }
  }
  EXPECT_GT(closures, 0u);
  EXPECT_TRUE(reading.place(0).look.empty());
  EXPECT_FALSE(plain.place(0).look.empty());
}

TEST(FabMap, AnnouncesARevisitAndProposesItOnce) {
  FabMap map(syntheticModel(), Parameters());
  map.beginSession("monday");
  for (std::uint32_t i = 0; i < 40; ++i) {
    const PlaceOutput output = map.process(i * kPlaceSecond, describeNumber(5000 + i, 0), 6.0 * i);
    EXPECT_EQ(output.belief.knowledge, PlaceKnowledge::New) << i;
    EXPECT_TRUE(output.closures.empty()) << i;
  }
  map.beginSession("tuesday");
  for (std::uint32_t i = 10; i < 20; ++i) {
    const PlaceOutput output =
        map.process(1000 * kPlaceSecond + i * kPlaceSecond, describeNumber(5000 + i, 1), 6.0 * (i - 10));
    EXPECT_EQ(output.belief.knowledge, PlaceKnowledge::Known) << i;
    ASSERT_EQ(output.closures.size(), 1u) << i;
    EXPECT_EQ(output.closures[0].a.session, "monday");
    EXPECT_EQ(output.closures[0].a.stamp, i * kPlaceSecond);
    EXPECT_EQ(output.closures[0].b.session, "tuesday");
    EXPECT_EQ(output.closures[0].probability, output.belief.likeliest.at(0).probability);
    EXPECT_NEAR(output.belief.p_new + output.closures[0].probability, 1.0, 1e-12);
  }
}

TEST(FabMap, APlacePassedAgainOnOneDayIsProposedForAnotherDay) {
  FabMap map(syntheticModel(), Parameters());
  map.beginSession("monday");
  for (std::uint32_t i = 0; i < 40; ++i) map.process(i * kPlaceSecond, describeNumber(5000 + i, 0), 6.0 * i);
  map.beginSession("tuesday");
  const auto drive = [&map](std::uint32_t number, std::uint32_t noise, std::uint32_t i) {
    return map.process((1000 + i) * kPlaceSecond, describeNumber(number, noise), 6.0 * i);
  };
  for (std::uint32_t i = 0; i < 10; ++i) drive(5010 + i, 3, i);
  for (std::uint32_t i = 10; i < 35; ++i) drive(9000 + i, 3, i);
  const PlaceOutput output = drive(5012, 4, 35);
  ASSERT_EQ(output.closures.size(), 2u);
  EXPECT_EQ(output.closures[0].a.session, "tuesday");
  EXPECT_EQ(output.closures[0].a.stamp, 1002 * kPlaceSecond);
  EXPECT_EQ(output.closures[1].a.session, "monday");
  EXPECT_EQ(output.closures[1].a.stamp, 12 * kPlaceSecond);
  ASSERT_EQ(output.belief.likeliest.size(), 2u) << "the likeliest place of each session";
  EXPECT_GE(output.belief.likeliest[0].probability, output.belief.likeliest[1].probability);
  EXPECT_DOUBLE_EQ(output.belief.p_new, 1.0 - output.belief.likeliest[0].probability);
}

TEST(FabMap, EachSessionHasItsLikeliestPlaceAndAClosure) {
  FabMap map(syntheticModel(), Parameters());
  const std::vector<std::string> days = {"monday", "tuesday", "wednesday"};
  for (std::uint32_t day = 0; day < 2; ++day) {
    map.beginSession(days[day]);
    for (std::uint32_t i = 0; i < 40; ++i)
      map.process((1000 * day + i) * kPlaceSecond, describeNumber(5000 + i, day), 6.0 * i);
  }
  map.beginSession(days[2]);
  for (std::uint32_t i = 0; i < 35; ++i)
    map.process((2000 + i) * kPlaceSecond, describeNumber(i == 2 ? 5012 : 9000 + i, 2), 6.0 * i);
  const PlaceOutput output = map.process(2040 * kPlaceSecond, describeNumber(5012, 3), 6.0 * 40);
  std::map<std::string, StampNs> stamps;
  for (const LikelyPlace& place : output.belief.likeliest) stamps[place.at.session] = place.at.stamp;
  EXPECT_EQ(output.belief.likeliest.size(), 3u);
  EXPECT_EQ(stamps,
            (std::map<std::string, StampNs>{
                {"monday", 12 * kPlaceSecond}, {"tuesday", 1012 * kPlaceSecond}, {"wednesday", 2002 * kPlaceSecond}}));
  EXPECT_EQ(output.closures.size(), 3u);
  for (std::size_t i = 1; i < output.belief.likeliest.size(); ++i)
    EXPECT_LE(output.belief.likeliest[i].probability, output.belief.likeliest[i - 1].probability);
}

TEST(FabMap, APlaceOfTodayDoesNotChangeTheProbabilityOfYesterdays) {
  const auto yesterdays = [](bool is_known_today) {
    FabMap map(syntheticModel(), Parameters());
    map.beginSession("monday");
    for (std::uint32_t i = 0; i < 40; ++i) map.process(i * kPlaceSecond, describeNumber(5000 + i, 0), 6.0 * i);
    map.beginSession("tuesday");
    for (std::uint32_t i = 0; i < 35; ++i)
      map.process((1000 + i) * kPlaceSecond, describeNumber(i == 2 && is_known_today ? 5012 : 9000 + i, 3), 6.0 * i);
    const PlaceOutput output = map.process(1040 * kPlaceSecond, describeNumber(5012, 3), 6.0 * 40);
    for (const LikelyPlace& place : output.belief.likeliest)
      if (place.at.session == "monday" && place.at.stamp == 12 * kPlaceSecond) return place.probability;
    return -1.0;
  };
  EXPECT_GT(yesterdays(false), 0.0);
  EXPECT_DOUBLE_EQ(yesterdays(true), yesterdays(false));
}

TEST(FabMap, PlacesOfAtMostSixSessionsAreReturned) {
  FabMap map(syntheticModel(), Parameters());
  for (std::uint32_t day = 0; day < 9; ++day) {
    map.beginSession("day " + std::to_string(day));
    map.addPlace(1000 * day * kPlaceSecond, describeNumber(7, day), 0.0);
  }
  map.beginSession("today");
  const PlaceOutput output = map.process(20'000 * kPlaceSecond, describeNumber(7, 10), 0.0);
  EXPECT_EQ(output.belief.likeliest.size(), PlaceRecogniser::kMostSessions);
}

TEST(FabMap, DistancesAreInterpolatedBetweenThePlacesOfASession) {
  FabMap map(syntheticModel(), Parameters());
  map.beginSession("monday");
  for (std::uint32_t i = 0; i < 3; ++i) map.process(i * kPlaceSecond, describeNumber(5000 + i, 0), 6.0 * i);
  map.beginSession("tuesday");
  map.process(0, describeNumber(6000, 0), 100.0);
  EXPECT_EQ(map.travelled({"monday", kPlaceSecond}), 6.0);
  EXPECT_EQ(map.travelled({"monday", kPlaceSecond + kPlaceSecond / 2}), 9.0);
  EXPECT_EQ(map.travelled({"tuesday", 0}), 100.0);
  EXPECT_EQ(map.travelled({"monday", 3 * kPlaceSecond}), std::nullopt);
  EXPECT_EQ(map.travelled({"sunday", 0}), std::nullopt);
}

TEST(FabMap, StationaryRobotCountsOnce) {
  FabMap map(syntheticModel(), Parameters());
  map.beginSession("monday");
  for (std::uint32_t i = 0; i < 60; ++i) {
    const PlaceOutput output = map.process(i * kPlaceSecond, describeNumber(7, 0), 0.0);
    EXPECT_EQ(output.belief.is_stationary, i > 0);
    EXPECT_TRUE(output.closures.empty());
  }
  EXPECT_EQ(map.places(), 1u);
}

TEST(FabMap, PlacesOfEarlierSessionsAreCandidatesAndUnusableOnesAreNot) {
  FabMap map(syntheticModel(), Parameters());
  map.beginSession("earlier");
  map.addPlace(0, describeNumber(1, 0), 0.0);
  map.addPlace(1, PlaceDescription{ObservationStatus::Dark, 1, 0, {}, {}}, 1.0);
  EXPECT_EQ(map.places(), 1u);
  map.beginSession("now");
  const PlaceOutput dark = map.process(5, PlaceDescription{ObservationStatus::Dark, 1, 0, {}, {}}, 0.0);
  EXPECT_EQ(dark.belief.observation, ObservationStatus::Dark);
  EXPECT_TRUE(dark.belief.likeliest.empty());
  const PlaceOutput again = map.process(6, describeNumber(1, 1), 0.0);
  ASSERT_EQ(again.closures.size(), 1u);
  EXPECT_EQ(again.closures[0].a.session, "earlier");
}

}  // namespace
}  // namespace fabmap_node
