// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/second_look.hpp"

#include <gtest/gtest.h>

#include "support/synthetic_places.hpp"

namespace fabmap_node {
namespace {

using testing::syntheticPlace;

constexpr std::size_t kEveryFeature = 1000;

LookFeatures lookAt(std::uint32_t number, std::uint32_t noise, std::uint8_t cameras = 1) {
  return lookFeatures(syntheticPlace(number, noise, cameras), kEveryFeature);
}

TEST(SecondLook, SamePlaceAgreesAndAnotherDoesNot) {
  const LookAgreement same = secondLook(lookAt(1, 0), lookAt(1, 1)), other = secondLook(lookAt(1, 0), lookAt(2, 1));
  EXPECT_GT(same.share, 0.4);
  EXPECT_LT(other.share, 0.15);
  EXPECT_GE(same.matches, same.agreeing);
}

TEST(SecondLook, PanoramasAgreeUnderAChangeOfHeading) {
  PlaceObservation turned = syntheticPlace(4, 1, 5);
  for (PlaceFeature& feature : turned.features) feature.camera = static_cast<std::uint8_t>((feature.camera + 2) % 5);
  EXPECT_GT(secondLook(lookAt(4, 0, 5), lookFeatures(turned, kEveryFeature)).share, 0.4);
}

/// Features above the horizon of two synthetic places, combined with those below it of two others.
PlaceObservation skyOver(std::uint32_t sky, std::uint32_t ground, std::uint32_t noise) {
  PlaceObservation seen;
  seen.cameras = 5;
  for (const std::uint32_t more : {0u, 10u}) {
    for (const PlaceFeature& feature : syntheticPlace(sky + more, noise, 5).features)
      if (feature.v < 0.45F) seen.features.push_back(feature);
    for (const PlaceFeature& feature : syntheticPlace(ground + more, noise, 5).features)
      if (feature.v >= 0.45F) seen.features.push_back(feature);
  }
  return seen;
}

TEST(SecondLook, TheSameSkyOverAnotherPlaceIsNoAgreement) {
  const LookFeatures here = lookFeatures(skyOver(4, 4, 0), kEveryFeature);
  const LookAgreement same = secondLook(here, lookFeatures(skyOver(4, 4, 1), kEveryFeature)),
                      elsewhere = secondLook(here, lookFeatures(skyOver(4, 6, 1), kEveryFeature));
  EXPECT_GT(same.share, 0.3);
  EXPECT_GT(elsewhere.whole, 0.1);
  EXPECT_LT(elsewhere.share, 0.05);
}

TEST(SecondLook, DirectionsThatScatterDoNotAgree) {
  PlaceObservation scattered = syntheticPlace(5, 0, 5);
  for (std::size_t i = 0; i < scattered.features.size(); ++i)
    scattered.features[i].camera = static_cast<std::uint8_t>((scattered.features[i].camera + i) % 5);
  const LookAgreement agreement = secondLook(lookAt(5, 0, 5), lookFeatures(scattered, kEveryFeature));
  EXPECT_GT(agreement.matches, 10);
  EXPECT_LT(agreement.agreeing, agreement.matches / 2);
}

TEST(SecondLook, SingleImageAndPanoramaDoNotAgree) {
  EXPECT_EQ(secondLook(lookAt(1, 0, 1), lookAt(1, 0, 5)).matches, 0);
}

TEST(SecondLook, EmptyObservationsDoNotAgree) {
  const LookFeatures nothing = lookFeatures({}, kEveryFeature);
  EXPECT_EQ(secondLook(nothing, lookAt(1, 0)).share, 0.0);
  EXPECT_EQ(secondLook(nothing, nothing).share, 0.0);
}

TEST(LookFeatures, SelectsUpToTheLimit) {
  const PlaceObservation place = syntheticPlace(1, 0);
  EXPECT_EQ(lookFeatures(place, 20).size(), 20u);
  EXPECT_EQ(lookFeatures(place, kEveryFeature).size(), place.features.size());
}

TEST(IsStationary, OnlyWhereFeaturesDoNotMove) {
  EXPECT_TRUE(isStationary(lookAt(1, 0), lookAt(1, 0)));
  EXPECT_FALSE(isStationary(lookAt(1, 0), lookAt(1, 1)));
  EXPECT_FALSE(isStationary(lookAt(1, 0), lookAt(2, 0)));
}

}  // namespace
}  // namespace fabmap_node
