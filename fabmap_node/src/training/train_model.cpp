// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/training/train_model.hpp"

#include <algorithm>
#include <cmath>

#include "fabmap_node/recognition/compact_look.hpp"
#include "training/calibration_samples.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {

using urban_nav_core::UserError;

namespace {

constexpr std::size_t kLeastDrives = 3;  // for calibration: the map, another drive, and the rest for training
constexpr std::size_t kStretches = 3;    // parts of a drive if there are fewer

using Step = std::function<void(const std::string&, double)>;

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

std::vector<TrainingDrive> divided(std::vector<TrainingDrive> drives) {
  if (drives.size() >= kLeastDrives) return drives;
  std::vector<TrainingDrive> parts;
  for (TrainingDrive& drive : drives)
    for (std::size_t k = 0; k < kStretches; ++k) {
      const auto at = [&](std::size_t n) {
        return drive.begin() + static_cast<std::ptrdiff_t>(n * drive.size() / kStretches);
      };
      parts.emplace_back(at(k), at(k + 1));
    }
  return parts;
}

std::vector<ByteDescriptor> allDescriptors(const std::vector<TrainingDrive>& drives) {
  std::vector<ByteDescriptor> all;
  for (const TrainingDrive& drive : drives)
    for (const TrainingImage& image : drive)
      for (const PlaceFeature& feature : image.observation.features) all.push_back(feature.descriptor);
  return all;
}

DescribedDrive described(const TrainingDrive& drive, std::size_t number, const Vocabulary& vocabulary,
                         std::size_t look_features) {
  DescribedDrive result(drive.size());
  urban_nav_core::forEach(drive.size(), 1, [&](std::size_t i) {
    const PlaceObservation& observation = drive[i].observation;
    result[i] = {number, drive[i].stamp, vocabulary.words(observation),
                 packLook(selectFeatures(observation, look_features))};
  });
  return result;
}

std::vector<DescribedDrive> describedDrives(const std::vector<TrainingDrive>& drives, bool panoramas,
                                            const Vocabulary& vocabulary, std::size_t look_features) {
  std::vector<DescribedDrive> kind;
  for (const TrainingDrive& drive : drives)
    if (!drive.empty() && (drive.front().observation.cameras > 1) == panoramas)
      kind.push_back(described(drive, kind.size(), vocabulary, look_features));
  return kind;
}

/// Returns the images of the panoramas' first camera, as single images.
std::vector<TrainingDrive> firstCameras(std::vector<TrainingDrive> drives) {
  for (TrainingDrive& drive : drives)
    for (TrainingImage& image : drive) {
      std::vector<PlaceFeature>& features = image.observation.features;
      features.erase(
          std::remove_if(features.begin(), features.end(), [](const PlaceFeature& f) { return f.camera != 0; }),
          features.end());
      image.observation.cameras = 1;
    }
  return drives;
}

void calibrate(const std::vector<TrainingDrive>& drives, const TrainingOptions& options, const Step& step,
               TrainedModel& trained) {
  PlaceModel& model = trained.model;
  const std::size_t look_features = options.matcher.look_features;
  const auto fit = [&](const std::vector<DescribedDrive>& kind, const char* name, PlaceCalibration& alone,
                       std::optional<PlaceCalibration>& sequence) {
    if (kind.size() < kLeastDrives) return false;
    const KindCalibration fitted = fitRuns(calibrationRuns(kind, model.vocabulary.size(), model.detector,
                                                           options.matcher, [&](double share) { step(name, share); }));
    trained.report.right += fitted.right;
    trained.report.wrong += fitted.wrong;
    alone = fitted.alone;
    sequence = fitted.sequence;
    return true;
  };
  const bool has_panoramas = fit(describedDrives(drives, true, model.vocabulary, look_features),
                                 "calibration of panoramas", model.panorama, model.panorama_sequence);
  std::vector<DescribedDrive> singles = describedDrives(drives, false, model.vocabulary, look_features);
  if (singles.empty()) singles = describedDrives(firstCameras(drives), false, model.vocabulary, look_features);
  fit(singles, "calibration of single images", model.single, model.single_sequence);
  if (!has_panoramas) useSuppliedPanoramaCalibrations(model);
}

}  // namespace

TrainedModel trainModel(std::vector<TrainingDrive> drives, const TrainingOptions& options,
                        const std::function<void(const std::string&, double)>& progress) {
  const Step step = [&progress](const std::string& name, double share) {
    if (progress) progress(name, share);
  };
  TrainedModel trained;
  PlaceModel& model = trained.model;
  for (TrainingDrive& drive : drives) {
    trained.report.observations += drive.size();
    trained.report.stationary += removeStationary(drive, options.matcher.look_features);
  }
  drives = divided(std::move(drives));
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
  WordSets all{model.vocabulary.size(), {}};
  for (const TrainingDrive& drive : drives)
    for (const DescribedPlace& place : described(drive, 0, model.vocabulary, 0))
      all.observations.push_back(place.words);
  model.tree = learnChowLiuTree(all, [&step](double share) { step("Chow-Liu tree", share); });
  roundToFile(model.tree);
  const std::size_t samples = std::min(options.sampled_places, all.observations.size());
  for (std::size_t k = 0; k < samples; ++k)
    model.sampled_places.push_back(all.observations[k * all.observations.size() / samples]);
  calibrate(drives, options, step, trained);
  return trained;
}

}  // namespace fabmap_node
