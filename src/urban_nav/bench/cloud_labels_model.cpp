// SPDX-License-Identifier: BSD-3-Clause
// Makes scene_labeler/config/clouds.labels, the model of `default` for clouds without the robot's side lasers: trained
// on simulated drives with 3D LiDARs of several numbers of rings and with push-broom lasers. A world is a site of
// cross-validation, so that calibration and thresholds are those of another kind of place.
//
//   urban_nav-bench-cloud_labels_model FOLDER [-o MODEL] [--without WORLD]
//
// FOLDER: for the returns of the drives; existing ones are reused. --without: trains on the other worlds and prints
// the figures of that one.
#include <array>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "scene_labeler/labelling/labeler.hpp"
#include "scene_labeler/labelling/superpixels.hpp"
#include "scene_labeler/training/train.hpp"
#include "support/cloud_drive.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav::bench {
namespace {

using scene_labeler::SceneClass;

constexpr std::size_t kSamplesPerClass = 8000, kSamplesPerCloud = 400, kHeldOutPerCloud = 4000;
constexpr int kSuperpixel = 12;  // px, not used without images

/// Seeds that no test, other bench or demo uses.
std::vector<CloudDrive> cloudDrives() {
  constexpr std::array<std::array<const char*, 3>, 3> kWorlds = {
      {{"street", "loops", "straight300"}, {"begbroke", "loops", "reversed"}, {"quad", "loops", "gardens"}}};
  // Few seconds of many rings, since their simulation takes as long as that of many seconds of few rings.
  constexpr std::array<std::pair<const char*, double>, 6> kDevices = {
      {{"16", 8.0}, {"32", 5.0}, {"lasers", 30.0}, {"64", 3.0}, {"livox", 5.0}, {"128", 1.5}}};
  std::vector<CloudDrive> drives;
  std::uint32_t seed = 201;
  for (const auto& world : kWorlds)
    for (std::size_t route = 1; route < world.size(); ++route)
      for (std::size_t i = 0; i < (route == 1 ? kDevices.size() : 3); ++i, ++seed)
        drives.push_back(
            {world[0], world[route], seed, 1 + static_cast<int>(seed % 6), kDevices[i].first, kDevices[i].second});
  return drives;
}

void addClouds(const CloudDrive& drive, const std::string& folder, std::vector<scene_labeler::TrainingFold>& folds) {
  for (const LabelledCloud& cloud : makeClouds(drive, simulateReturns(drive, folder)))
    scene_labeler::addScene({drive.world, measureFeatures(cloud.scene, scene_labeler::FeatureSet::Cloud), cloud.labels,
                             scene_labeler::makePatches(cloud.scene, {})},
                            {kSamplesPerCloud, kHeldOutPerCloud}, folds);
}

struct Tally {
  std::array<std::array<std::size_t, scene_labeler::kClassCount>, scene_labeler::kClassCount> confusion{};
  std::size_t points = 0, right = 0, sure = 0, sure_right = 0;

  void add(const LabelledCloud& cloud, const scene_labeler::SceneLabels& answer) {
    for (std::size_t i = 0; i < cloud.labels.size(); ++i) {
      if (cloud.labels[i] == SceneClass::None || answer.labels[i] == SceneClass::None) continue;
      const bool is_right = cloud.labels[i] == withOneWall(answer.labels[i]);
      ++points;
      right += is_right ? 1U : 0U;
      sure += answer.unsure[i] == 0 ? 1U : 0U;
      sure_right += is_right && answer.unsure[i] == 0 ? 1U : 0U;
      ++confusion[toIndex(cloud.labels[i])][toIndex(withOneWall(answer.labels[i]))];
    }
  }
  void print(const std::string& name) const {
    const auto percent = [](std::size_t part, std::size_t all) {
      return 100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(all, 1));
    };
    std::printf("| %s | %zu | %.0f | %.0f | %.1f | ", name.c_str(), points, percent(right, points),
                percent(sure, points), percent(sure_right, sure));
    const char* comma = "";
    for (std::size_t k = 0; k < scene_labeler::kClassCount; ++k) {
      std::size_t truth = 0, stated = 0;
      for (std::size_t i = 0; i < scene_labeler::kClassCount; ++i) {
        truth += confusion[k][i];
        stated += confusion[i][k];
      }
      if (truth == 0) continue;
      std::printf("%s%s %.0f/%.0f", comma, toString(static_cast<SceneClass>(k)), percent(confusion[k][k], truth),
                  percent(confusion[k][k], stated));
      comma = ", ";
    }
    std::printf(" |\n");
    std::fflush(stdout);
  }
};

void tryOn(const scene_labeler::LabelModel& model, const std::string& world, const std::string& folder) {
  std::printf(
      "| drive | points | right, %% | sure, %% | of these right, %% | found/right by class, %% "
      "|\n|---|---|---|---|---|---|\n");
  Tally all;
  for (const CloudDrive& drive : cloudDrives()) {
    if (drive.world != world) continue;
    std::size_t number = 0;
    Tally of_drive;
    for (const LabelledCloud& cloud : makeClouds(drive, simulateReturns(drive, folder))) {
      if (number++ % 2 == 1) continue;
      const auto answer = labelScene(model, cloud.scene, kSuperpixel);
      of_drive.add(cloud, answer);
      all.add(cloud, answer);
    }
    of_drive.print(drive.name());
  }
  all.print(world);
}

int run(int argc, char** argv) {
  std::string folder, out, without;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "-o" && i + 1 < argc) out = argv[++i];
    else if (word == "--without" && i + 1 < argc) without = argv[++i];
    else folder = word;
  }
  if (folder.empty()) {
    std::fprintf(stderr, "usage: %s FOLDER [-o MODEL] [--without WORLD]\n", argv[0]);
    return 2;
  }
  std::filesystem::create_directories(folder);
  std::vector<scene_labeler::TrainingFold> folds;
  for (const CloudDrive& drive : cloudDrives()) {
    if (drive.world == without) continue;
    addClouds(drive, folder, folds);
    std::fprintf(stderr, "%s\n", drive.name().c_str());
  }
  scene_labeler::TrainingOptions options;
  options.features = scene_labeler::FeatureSet::Cloud;
  options.samples_per_class = kSamplesPerClass;
  const auto trained = scene_labeler::trainModel(std::move(folds), options, [](double) {});
  for (const auto& row : trained.model.sure.rows())
    std::fprintf(stderr, "from %.3f: %.1f %% answered, %.2f %% of these wrong\n", static_cast<double>(row.least),
                 100.0 * static_cast<double>(row.answered), 100.0 * static_cast<double>(row.wrong));
  const std::string bytes = printModel(trained.model);
  for (const auto& setting : trained.cross_validation) std::fprintf(stderr, "mean F1 %.3f\n", setting.f1_mean);
  std::fprintf(stderr, "%zu bytes\n", bytes.size());
  if (!out.empty()) urban_nav_core::writeAtomically(out, bytes);
  if (!without.empty()) tryOn(scene_labeler::parseModel(bytes, "model"), without, folder);
  return 0;
}

}  // namespace
}  // namespace urban_nav::bench

int main(int argc, char** argv) {
  try {
    return urban_nav::bench::run(argc, argv);
  } catch (const urban_nav_core::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
