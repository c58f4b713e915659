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

ComparedFeatures featuresAt(std::uint32_t number, std::uint32_t noise, std::uint8_t cameras = 1) {
  return selectFeatures(syntheticPlace(number, noise, cameras), kEveryFeature);
}

TEST(SecondLook, SamePlaceAgreesAndAnotherDoesNot) {
  const LookAgreement same = secondLook(featuresAt(1, 0), featuresAt(1, 1)),
                      other = secondLook(featuresAt(1, 0), featuresAt(2, 1));
  EXPECT_GT(same.share, 0.4);
  EXPECT_LT(other.share, 0.15);
  EXPECT_GE(same.matches, same.agreeing);
}

bool isNearHorizon(const PlaceFeature& feature) { return std::abs(feature.v - 0.5F) < 0.1F; }

/// Panorama of about 300 features: those near the horizon are of place `level`, the others of place `away`.
PlaceObservation makePanorama(std::uint32_t level, std::uint32_t away, std::uint32_t noise) {
  PlaceObservation seen;
  seen.cameras = 5;
  for (std::uint32_t more = 0; more < 500; more += 100) {
    for (const PlaceFeature& feature : syntheticPlace(level + more, noise, 5).features)
      if (isNearHorizon(feature)) seen.features.push_back(feature);
    for (const PlaceFeature& feature : syntheticPlace(away + more, noise, 5).features)
      if (!isNearHorizon(feature)) seen.features.push_back(feature);
  }
  return seen;
}

LookAgreement compare(const PlaceObservation& a, const PlaceObservation& b) {
  return secondLook(selectFeatures(a, kEveryFeature), selectFeatures(b, kEveryFeature));
}

TEST(SecondLook, PanoramasAgreeUnderAChangeOfHeading) {
  PlaceObservation turned = makePanorama(4, 4, 1);
  for (PlaceFeature& feature : turned.features) feature.camera = static_cast<std::uint8_t>((feature.camera + 2) % 5);
  EXPECT_GT(compare(makePanorama(4, 4, 0), turned).share, 0.4);
}

TEST(SecondLook, PanoramasThatAgreeOnlyNearTheHorizonOrOnlyAwayFromItAreOfTwoPlaces) {
  const PlaceObservation here = makePanorama(4, 4, 0);
  EXPECT_GT(compare(here, makePanorama(4, 4, 1)).share, 0.4);
  for (const PlaceObservation& other : {makePanorama(4, 6, 1), makePanorama(6, 4, 1)}) {
    const LookAgreement elsewhere = compare(here, other);
    EXPECT_GT(elsewhere.whole, 0.08);
    EXPECT_LT(elsewhere.share, 0.1);
  }
  EXPECT_LT(compare(here, makePanorama(6, 6, 1)).whole, 0.03);
}

TEST(SecondLook, PanoramasAgreeInEitherOrder) {
  const LookAgreement one = secondLook(featuresAt(1, 0, 5), featuresAt(1, 1, 5)),
                      other = secondLook(featuresAt(1, 1, 5), featuresAt(1, 0, 5));
  EXPECT_GT(one.matches, 10);
  EXPECT_EQ(one.matches, other.matches);
  EXPECT_EQ(one.agreeing, other.agreeing);
  EXPECT_EQ(one.share, other.share);
}

/// Matches by definition: pairs at nearly the same elevation that are nearer than 0.8 of any alternative of either.
int countMatchesPlainly(const ComparedFeatures& a, const ComparedFeatures& b) {
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
    const ComparedFeatures a = featuresAt(1, 0, 5), b = featuresAt(other, 1, 5);
    EXPECT_EQ(secondLook(a, b).matches, countMatchesPlainly(a, b)) << other;
  }
}

TEST(SecondLook, PanoramasDoNotMatchAtAnotherElevation) {
  PlaceObservation raised = syntheticPlace(4, 1, 5), lowered = syntheticPlace(4, 0, 5);
  for (PlaceFeature& feature : raised.features) feature.v = 0.3F * feature.v;
  for (PlaceFeature& feature : lowered.features) feature.v = 0.6F + 0.3F * feature.v;
  EXPECT_EQ(secondLook(selectFeatures(raised, kEveryFeature), selectFeatures(lowered, kEveryFeature)).matches, 0);
}

TEST(SecondLook, DirectionsThatScatterDoNotAgree) {
  PlaceObservation scattered = syntheticPlace(5, 0, 5);
  for (std::size_t i = 0; i < scattered.features.size(); ++i)
    scattered.features[i].camera = static_cast<std::uint8_t>((scattered.features[i].camera + i) % 5);
  const LookAgreement agreement = secondLook(featuresAt(5, 0, 5), selectFeatures(scattered, kEveryFeature));
  EXPECT_GT(agreement.matches, 10);
  EXPECT_LT(agreement.agreeing, agreement.matches / 2);
}

TEST(SecondLook, SingleImageAndPanoramaDoNotAgree) {
  EXPECT_EQ(secondLook(featuresAt(1, 0, 1), featuresAt(1, 0, 5)).matches, 0);
}

TEST(SecondLook, EmptyObservationsDoNotAgree) {
  const ComparedFeatures nothing = selectFeatures({}, kEveryFeature);
  EXPECT_EQ(secondLook(nothing, featuresAt(1, 0)).share, 0.0);
  EXPECT_EQ(secondLook(nothing, nothing).share, 0.0);
}

TEST(ComparedFeatures, SelectsUpToTheLimit) {
  const PlaceObservation place = syntheticPlace(1, 0);
  EXPECT_EQ(selectFeatures(place, 20).size(), 20u);
  EXPECT_EQ(selectFeatures(place, kEveryFeature).size(), place.features.size());
}

TEST(ComparedFeatures, APanoramaHasAsManyAsFitInTheBytesOfASingleImage) {
  PlaceObservation place = syntheticPlace(1, 0, 5);
  place.features.resize(40);
  EXPECT_EQ(selectFeatures(place, 10).size(), 19u);  // 370 bytes of 19 each
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
  EXPECT_TRUE(isStationary(featuresAt(1, 0, 5), featuresAt(1, 0, 5)));
  EXPECT_FALSE(isStationary(featuresAt(1, 0, 5), featuresAt(2, 0, 5)));
}

TEST(IsStationary, OnlyWhereFeaturesDoNotMove) {
  EXPECT_TRUE(isStationary(featuresAt(1, 0), featuresAt(1, 0)));
  EXPECT_FALSE(isStationary(featuresAt(1, 0), featuresAt(1, 1)));
  EXPECT_FALSE(isStationary(featuresAt(1, 0), featuresAt(2, 0)));
}

}  // namespace
}  // namespace fabmap_node
