// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/training/train_model.hpp"

#include <algorithm>
#include <iterator>

#include "fabmap_node/recognition/compact_look.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {

using urban_nav_core::UserError;

namespace {

std::size_t removeStationary(TrainingDrive& drive, std::size_t look_features) {
  const std::size_t before = drive.size();
  TrainingDrive moving;
  ComparedFeatures last;
  for (TrainingImage& image : drive) {
    ComparedFeatures look = selectFeatures(image.observation, look_features);
    if (!moving.empty() && isStationary(last, look)) continue;
    last = std::move(look);
    moving.push_back(std::move(image));
  }
  drive = std::move(moving);
  return before - drive.size();
}

std::vector<ByteDescriptor> allDescriptors(const std::vector<TrainingDrive>& drives) {
  std::vector<ByteDescriptor> all;
  for (const TrainingDrive& drive : drives)
    for (const TrainingImage& image : drive)
      for (const PlaceFeature& feature : image.observation.features) all.push_back(feature.descriptor);
  return all;
}

std::vector<WordSet> allWords(const std::vector<TrainingDrive>& drives, const Vocabulary& vocabulary) {
  std::vector<WordSet> all;
  for (const TrainingDrive& drive : drives) {
    std::vector<WordSet> words(drive.size());
    urban_nav_core::forEach(drive.size(), 1, [&](std::size_t i) { words[i] = vocabulary.words(drive[i].observation); });
    all.insert(all.end(), std::make_move_iterator(words.begin()), std::make_move_iterator(words.end()));
  }
  return all;
}

}  // namespace

TrainedModel trainModel(std::vector<TrainingDrive> drives, const TrainingOptions& options,
                        const std::function<void(const std::string&, double)>& progress) {
  const auto step = [&progress](const std::string& name, double share) {
    if (progress) progress(name, share);
  };
  TrainedModel trained;
  PlaceModel& model = trained.model;
  for (TrainingDrive& drive : drives) {
    trained.report.observations += drive.size();
    trained.report.stationary += removeStationary(drive, options.matcher.look_features);
  }
  std::vector<ByteDescriptor> descriptors = allDescriptors(drives);
  trained.report.descriptors = descriptors.size();
  if (descriptors.size() < options.k_means.words)
    throw UserError(
        "training",
        std::to_string(descriptors.size()) + " descriptors in " +
            std::to_string(trained.report.observations - trained.report.stationary) + " images that differ",
        "at least " + std::to_string(options.k_means.words) + ", one for each word: more images or fewer words");
  model.vocabulary = trainVocabulary(std::move(descriptors), options.k_means, [&step](int done, int total) {
    step("vocabulary", static_cast<double>(done) / total);
  });
  const WordSets all{model.vocabulary.size(), allWords(drives, model.vocabulary)};
  model.tree = learnChowLiuTree(all, [&step](double share) { step("Chow-Liu tree", share); });
  roundToFile(model.tree);
  const std::size_t samples = std::min(options.sampled_places, all.observations.size());
  for (std::size_t k = 0; k < samples; ++k)
    model.sampled_places.push_back(all.observations[k * all.observations.size() / samples]);
  useSuppliedCalibrations(model);
  return trained;
}

}  // namespace fabmap_node
