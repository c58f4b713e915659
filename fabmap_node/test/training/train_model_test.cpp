// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/training/train_model.hpp"

#include <gtest/gtest.h>

#include "fabmap_node/recognition/place_recogniser.hpp"
#include "support/synthetic_places.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {
namespace {

using testing::syntheticPlace;

constexpr urban_nav_core::StampNs kOneSecond = 1'000'000'000;

/// Drives at different places; each place is in three consecutive images.
std::vector<TrainingDrive> syntheticDrives() {
  std::vector<TrainingDrive> drives(4);
  for (std::uint32_t d = 0; d < drives.size(); ++d)
    for (std::uint32_t i = 0; i < 45; ++i)
      drives[d].push_back({i * kOneSecond, syntheticPlace(100 * d + i / 3, i % 3)});
  return drives;
}

TrainingOptions smallOptions() {
  TrainingOptions options;
  options.k_means.words = 250;
  options.k_means.iterations = 5;
  options.sampled_places = 50;
  return options;
}

const TrainedModel& trainedOnce() {
  static const TrainedModel trained = trainModel(syntheticDrives(), smallOptions());
  return trained;
}

PlaceDescription describeSynthetic(const PlaceObservation& observation) {
  return PlaceDescriber(trainedOnce().model, {}, 1000).describe(observation);
}

TEST(TrainModel, HasTheRequestedSizes) {
  EXPECT_EQ(trainedOnce().model.vocabulary.size(), 250u);
  EXPECT_EQ(trainedOnce().model.sampled_places.size(), 50u);
}

// Neighbours of a drive at one image per second are 10 m apart, and do not show one place.
TEST(TrainModel, TakesTheSuppliedCalibrationsWhateverTheDrives) {
  PlaceModel supplied = trainedOnce().model;
  useSuppliedCalibrations(supplied);
  EXPECT_EQ(printModel(trainedOnce().model), printModel(supplied));
  ASSERT_TRUE(supplied.single_sequence && supplied.panorama_sequence);
  PlaceEvidence nothing, everything;
  everything.word_ratio = everything.word_margin = everything.look = everything.look_margin = everything.sequence = 0.5;
  for (const PlaceCalibration& each :
       {supplied.single, *supplied.single_sequence, supplied.panorama, *supplied.panorama_sequence}) {
    EXPECT_LT(each.probability(nothing), 0.1);
    EXPECT_GT(each.probability(everything), 0.99);
  }
}

TEST(TrainModel, DoesNotDependOnTheNumberOfThreads) {
  const urban_nav_core::ThreadLimit limit(1);
  EXPECT_EQ(printModel(trainModel(syntheticDrives(), smallOptions()).model), printModel(trainedOnce().model));
}

TEST(TrainModel, StationaryCameraCountsOnce) {
  std::vector<TrainingDrive> drives = syntheticDrives();
  for (int i = 0; i < 30; ++i) drives[0].push_back({(100 + i) * kOneSecond, syntheticPlace(99, 0)});
  EXPECT_EQ(trainModel(std::move(drives), smallOptions()).report.stationary, 29u);
}

TEST(TrainModel, RefusesTooFewDescriptors) {
  EXPECT_THROW(trainModel({{{0, syntheticPlace(1, 0)}}}, smallOptions()), urban_nav_core::UserError);
  EXPECT_THROW(trainModel({}, smallOptions()), urban_nav_core::UserError);
}

TEST(PlaceRecogniser, RecognisesTheSecondVisitAndNothingBefore) {
  PlaceRecogniser recogniser(trainedOnce().model, {});
  recogniser.beginSession();
  double highest_new = 0.0;
  for (std::uint32_t i = 0; i < 40; ++i)
    highest_new = std::max(
        highest_new, recogniser.process(i * kOneSecond, describeSynthetic(syntheticPlace(5000 + i, 0))).probability);
  for (std::uint32_t i = 0; i < 15; ++i) {
    const PlaceRecognition found =
        recogniser.process((40 + i) * kOneSecond, describeSynthetic(syntheticPlace(5000 + i, 1)));
    ASSERT_TRUE(found.match);
    EXPECT_EQ(found.match->place, i);
    EXPECT_GT(found.probability, highest_new);
    EXPECT_GT(found.match->log_likelihood, found.match->log_likelihood_new);
  }
}

TEST(PlaceRecogniser, PlacesWithinTheMaskAreNoCandidates) {
  PlaceRecogniser recogniser(trainedOnce().model, {});
  recogniser.beginSession();
  EXPECT_FALSE(recogniser.process(0, describeSynthetic(syntheticPlace(1, 0))).match);
  EXPECT_FALSE(recogniser.process(19 * kOneSecond, describeSynthetic(syntheticPlace(1, 1))).match);
  EXPECT_TRUE(recogniser.process(21 * kOneSecond, describeSynthetic(syntheticPlace(1, 2))).match);
  recogniser.beginSession();
  EXPECT_TRUE(recogniser.process(22 * kOneSecond, describeSynthetic(syntheticPlace(1, 1))).match);
}

TEST(PlaceRecogniser, ReportsObservationsWithTooFewFeaturesAndStoresNone) {
  PlaceRecogniser recogniser(trainedOnce().model, {});
  EXPECT_EQ(recogniser.process(0, describeSynthetic({})).status, ObservationStatus::TooFewFeatures);
  EXPECT_EQ(recogniser.places(), 0u);
}

TEST(PlaceModel, ReadsBackWhatWasPrinted) {
  const std::string bytes = printModel(trainedOnce().model);
  const PlaceModel read = parseModel(bytes, "model");
  EXPECT_EQ(printModel(read), bytes);
  EXPECT_EQ(read.sampled_places, trainedOnce().model.sampled_places);
  EXPECT_EQ(read.vocabulary.centres(), trainedOnce().model.vocabulary.centres());
  EXPECT_EQ(read.tree.p, trainedOnce().model.tree.p);
}

// Theirs are for another comparison of descriptors and another evidence of sequences.
TEST(PlaceModel, ModelsOfEarlierVersionsTakeTheSuppliedCalibrations) {
  PlaceModel written = trainedOnce().model, supplied = written;
  written.single.bias = written.panorama.bias = -1.0;
  written.single_sequence = written.single;
  written.panorama_sequence = written.panorama;
  useSuppliedCalibrations(supplied);
  for (const std::uint32_t version : {2u, 4u}) {
    const PlaceModel read =
        parseModel(urban_nav_core::seal("places model", version, printModelContent(written)), "model");
    EXPECT_EQ(printModelContent(read), printModelContent(supplied)) << version;
  }
  EXPECT_EQ(printModelContent(parseModel(printModel(written), "model")), printModelContent(written));
}

TEST(PlaceModel, ModelsOfOpenCvFeaturesAreRefusedByName) {
  const std::string orb("\2\0\0\0", 4);  // the kind of features, which version 3 of the file begins with
  const std::string bytes = urban_nav_core::seal("places model", 3, orb + printModelContent(trainedOnce().model));
  try {
    parseModel(bytes, "city.places");
    ADD_FAILURE();
  } catch (const urban_nav_core::DataError& error) {
    const std::string text = error.what();
    for (const char* part : {"city.places", "OpenCV", "upright"}) EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

TEST(PlaceModel, TruncatedAndDamagedFilesAreRefusedByName) {
  const std::string bytes = printModel(trainedOnce().model);
  for (const std::size_t size : {std::size_t{0}, std::size_t{10}, bytes.size() / 2, bytes.size() - 1}) {
    try {
      parseModel(std::string_view(bytes).substr(0, size), "city.places");
      ADD_FAILURE() << size;
    } catch (const urban_nav_core::DataError& error) {
      EXPECT_NE(std::string(error.what()).find("city.places"), std::string::npos);
    }
  }
  std::string damaged = bytes;
  damaged[bytes.size() / 2] = static_cast<char>(damaged[bytes.size() / 2] ^ 1);
  EXPECT_THROW(parseModel(damaged, "model"), urban_nav_core::DataError);
}

TEST(PlaceModel, ContentThatIsDamagedUnderAValidChecksumIsRefused) {
  const auto result =
      urban_nav_core::testing::fuzzText({printModelContent(trainedOnce().model)}, [](const std::string& content) {
        try {
          parseModelContent(content, "model");
        } catch (const urban_nav_core::DataError& error) {
          throw urban_nav_core::UserError(error.parts());
        }
      });
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.refused, 0);
}

TEST(PlaceModel, HashIdentifiesTheContent) {
  EXPECT_EQ(modelHash("a").size(), 16u);
  EXPECT_NE(modelHash("a"), modelHash("b"));
}

}  // namespace
}  // namespace fabmap_node
