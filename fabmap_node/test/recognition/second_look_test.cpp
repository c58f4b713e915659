// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/second_look.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

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

/// Features near the horizon of two synthetic places, combined with those away from it of two others.
PlaceObservation farFieldOver(std::uint32_t far, std::uint32_t ground, std::uint32_t noise) {
  PlaceObservation seen;
  seen.cameras = 5;
  const auto isFar = [](const PlaceFeature& feature) { return std::abs(feature.v - 0.5F) < 0.08F; };
  for (const std::uint32_t more : {0u, 10u}) {
    for (const PlaceFeature& feature : syntheticPlace(far + more, noise, 5).features)
      if (isFar(feature)) seen.features.push_back(feature);
    for (const PlaceFeature& feature : syntheticPlace(ground + more, noise, 5).features)
      if (!isFar(feature)) seen.features.push_back(feature);
  }
  return seen;
}

TEST(SecondLook, WhatIsFarAwayDoesNotTellPanoramasApart) {
  const LookFeatures here = lookFeatures(farFieldOver(4, 4, 0), kEveryFeature);
  const LookAgreement same = secondLook(here, lookFeatures(farFieldOver(4, 4, 1), kEveryFeature)),
                      elsewhere = secondLook(here, lookFeatures(farFieldOver(4, 6, 1), kEveryFeature));
  EXPECT_GT(same.share, 0.3);
  EXPECT_GT(elsewhere.whole, 0.03);
  EXPECT_LT(elsewhere.share, 0.3 * elsewhere.whole);
}

TEST(SecondLook, PanoramasAgreeInEitherOrder) {
  const LookAgreement one = secondLook(lookAt(1, 0, 5), lookAt(1, 1, 5)),
                      other = secondLook(lookAt(1, 1, 5), lookAt(1, 0, 5));
  EXPECT_GT(one.matches, 10);
  EXPECT_EQ(one.matches, other.matches);
  EXPECT_EQ(one.agreeing, other.agreeing);
  EXPECT_EQ(one.share, other.share);
}

/// Matches by definition: pairs at nearly the same elevation that are nearer than 0.8 of any alternative of either.
int countMatchesPlainly(const LookFeatures& a, const LookFeatures& b) {
  const auto level = [](const PanoramaFeature& f, int k) {
    return static_cast<int>((f.middle >> k & 1) + (f.top >> k & 1));
  };
  const auto distance = [&](std::size_t i, std::size_t j) {
    int sum = 0;
    for (int k = 0; k < kLookElements; ++k) sum += std::abs(level(a.panorama[i], k) - level(b.panorama[j], k));
    return sum;
  };
  const auto isAllowed = [&](std::size_t i, std::size_t j) {
    return std::abs(a.panorama[i].direction.y() - b.panorama[j].direction.y()) <= 0.12F;
  };
  const auto isClear = [&](std::size_t i, std::size_t j) {
    double second = 57.0;  // mean of unrelated descriptors
    for (std::size_t k = 0; k < b.size(); ++k)
      if (k != j && isAllowed(i, k)) second = std::min(second, static_cast<double>(distance(i, k)));
    for (std::size_t k = 0; k < a.size(); ++k)
      if (k != i && isAllowed(k, j)) second = std::min(second, static_cast<double>(distance(k, j)));
    return distance(i, j) < 0.8 * second;
  };
  int matches = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      if (isAllowed(i, j) && isClear(i, j)) ++matches;
  return matches;
}

TEST(SecondLook, MatchesOfPanoramasAreThoseOfThePlainDefinition) {
  for (const std::uint32_t other : {1u, 2u, 3u}) {
    const LookFeatures a = lookAt(1, 0, 5), b = lookAt(other, 1, 5);
    EXPECT_EQ(secondLook(a, b).matches, countMatchesPlainly(a, b)) << other;
  }
}

TEST(SecondLook, PanoramasDoNotMatchAtAnotherElevation) {
  PlaceObservation raised = syntheticPlace(4, 1, 5), lowered = syntheticPlace(4, 0, 5);
  for (PlaceFeature& feature : raised.features) feature.v = 0.3F * feature.v;
  for (PlaceFeature& feature : lowered.features) feature.v = 0.6F + 0.3F * feature.v;
  EXPECT_EQ(secondLook(lookFeatures(raised, kEveryFeature), lookFeatures(lowered, kEveryFeature)).matches, 0);
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

TEST(LookFeatures, APanoramaHasAsManyAsFitInTheBytesOfASingleImage) {
  PlaceObservation place = syntheticPlace(1, 0, 5);
  place.features.resize(40);
  EXPECT_EQ(lookFeatures(place, 10).size(), 19u);  // 370 bytes of 19 each
}

TEST(PanoramaFeature, LevelsAreRanksOfTheElements) {
  std::array<unsigned, kLookElements> elements{};
  for (std::size_t k = 0; k < elements.size(); ++k) elements[k] = static_cast<unsigned>(7 * ((k * 37) % 64));
  const PanoramaFeature feature = rankElements(elements);
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const std::size_t rank = elements[k] / 7;
    EXPECT_EQ(feature.middle >> k & 1, rank > 20 ? 1u : 0u) << rank;
    EXPECT_EQ(feature.top >> k & 1, rank > 42 ? 1u : 0u) << rank;
  }
  for (unsigned& element : elements) element = 3 * element + 11;
  EXPECT_EQ(rankElements(elements).middle, feature.middle);
  EXPECT_EQ(rankElements(elements).top, feature.top);
  EXPECT_EQ(rankElements({}).middle, 0u) << "equal elements have no rank";
}

TEST(IsStationary, Panoramas) {
  EXPECT_TRUE(isStationary(lookAt(1, 0, 5), lookAt(1, 0, 5)));
  EXPECT_FALSE(isStationary(lookAt(1, 0, 5), lookAt(2, 0, 5)));
}

TEST(IsStationary, OnlyWhereFeaturesDoNotMove) {
  EXPECT_TRUE(isStationary(lookAt(1, 0), lookAt(1, 0)));
  EXPECT_FALSE(isStationary(lookAt(1, 0), lookAt(1, 1)));
  EXPECT_FALSE(isStationary(lookAt(1, 0), lookAt(2, 0)));
}

}  // namespace
}  // namespace fabmap_node
