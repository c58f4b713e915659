// SPDX-License-Identifier: BSD-3-Clause
// Trains a model of places with SIFT or ORB features of OpenCV on folders of images, and writes the likeliest earlier
// image of each image of another folder, with its probability, like `places train` and `places query` with the default
// features. Stamps are those of times.txt (s), otherwise images are 1 s apart.
//
//   fabmap_node-bench-opencv_features sift|orb WORDS QUERY_FOLDER TRAINING_FOLDER... > MATCHES.csv
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "fabmap_node/recognition/place_describer.hpp"
#include "fabmap_node/recognition/place_recogniser.hpp"
#include "fabmap_node/training/train_model.hpp"
#include "reference/features/opencv_features.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"

namespace {

using namespace fabmap_node;

std::vector<std::string> imagesIn(const std::string& folder) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() != ".txt") paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// Returns the observations of a folder, in the order of names.
TrainingDrive observeFolder(const std::string& folder, OpenCvFeature feature) {
  const std::vector<std::string> paths = imagesIn(folder);
  TrainingDrive drive(paths.size());
  std::ifstream times(folder + "/times.txt");
  for (std::size_t i = 0; i < paths.size(); ++i) {
    double seconds = static_cast<double>(i);
    if (times.is_open() && !(times >> seconds))
      throw urban_nav_core::UserError(folder + "/times.txt", std::to_string(i) + " times", "one for each image");
    drive[i].stamp = static_cast<urban_nav_core::StampNs>(std::llround(1e9 * seconds));
  }
  urban_nav_core::forEach(paths.size(), 1, [&](std::size_t i) {
    const cv::Mat image = cv::imread(paths[i], cv::IMREAD_GRAYSCALE);
    if (image.empty()) throw urban_nav_core::UserError(paths[i], "not readable", "an image");
    const urban_nav_core::ImageView view{image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)};
    drive[i].observation = openCvObservation(feature, view, FeatureOptions().single);
  });
  return drive;
}

void writeMatches(const PlaceModel& model, const TrainingDrive& query) {
  const RecogniserOptions options;
  const PlaceDescriber describer(model, {}, options.matcher.look_features);
  PlaceRecogniser recogniser(model, options);
  recogniser.beginSession();
  std::vector<std::size_t> image_of_place;
  std::puts("query,match,score");
  for (std::size_t i = 0; i < query.size(); ++i) {
    const PlaceRecognition found = recogniser.process(query[i].stamp, describer.describe(query[i].observation));
    if (found.match) std::printf("%zu,%zu,%.17g\n", i, image_of_place[found.match->place], found.probability);
    if (found.status == ObservationStatus::Used) image_of_place.push_back(i);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const auto kind = argc < 5 ? kOpenCvFeatureNames.end()
                             : std::find(kOpenCvFeatureNames.begin(), kOpenCvFeatureNames.end(), std::string(argv[1]));
  const long words = argc < 5 ? 0 : std::atol(argv[2]);
  if (kind == kOpenCvFeatureNames.end() || words < 10) {
    std::fputs("fabmap_node-bench-opencv_features sift|orb WORDS QUERY_FOLDER TRAINING_FOLDER...\n", stderr);
    return 2;
  }
  try {
    const auto feature = static_cast<OpenCvFeature>(kind - kOpenCvFeatureNames.begin());
    std::vector<TrainingDrive> drives;
    for (int i = 4; i < argc; ++i) drives.push_back(observeFolder(argv[i], feature));
    TrainingOptions options;
    options.k_means.words = static_cast<std::size_t>(words);
    const TrainedModel trained = trainModel(std::move(drives), options);
    writeMatches(trained.model, observeFolder(argv[3], feature));
  } catch (const urban_nav_core::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
