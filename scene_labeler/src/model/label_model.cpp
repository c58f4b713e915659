// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/model/label_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "urban_nav_core/io/file_kind.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace scene_labeler {
namespace {

constexpr const char* kModelName = "model of scene_labeler";
constexpr std::uint32_t kOldestVersion = 2;      // without samples
constexpr std::uint32_t kThresholdsVersion = 4;  // the first with thresholds of sure answers
constexpr std::uint32_t kModelVersion = 4;
constexpr float kLeastShare = 1e-3F;  // of a forest's votes, lower bound before the logarithm
constexpr std::size_t kMostFeatures = 255;

}  // namespace

const char* toString(ClassifierKind kind) {
  switch (kind) {
    case ClassifierKind::Svm: return "svm";
    case ClassifierKind::Forest: return "forest";
    default: return "boosted";
  }
}

void NoveltyRanges::archive(urban_nav_core::Archive& archive) { archive(low_values, high_values, limit); }

void LabelModel::logProbabilities(const float* row, float* logs) const {
  if (kind == ClassifierKind::Svm) {
    svm.evaluate(row, logs);
  } else {
    std::uint8_t codes[kMostFeatures];
    bins.encode(row, codes);
    trees.evaluate(codes, logs);
    if (kind == ClassifierKind::Forest)
      for (std::size_t k = 0; k < classes.size(); ++k) logs[k] = std::log(std::max(logs[k], kLeastShare));
  }
  calibration.apply(logs);
}

std::uint32_t LabelModel::countOutside(const float* row) const {
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < novelty.low_values.size(); ++i)
    count += row[i] < novelty.low_values[i] || row[i] > novelty.high_values[i] ? 1U : 0U;
  return count;
}

void LabelModel::archive(urban_nav_core::Archive& archive) {
  archive(kind, features, classes, bins);
  archive.require(kind <= ClassifierKind::Boosted && features <= FeatureSet::Cloud, "its classifier is unknown");
  if (archive.isReading()) {
    bool is_sound = classes.size() >= 2 && bins.columns() == featureNames(features).size();
    for (std::size_t i = 0; i < classes.size(); ++i)
      is_sound = is_sound && toIndex(classes[i]) < kClassCount && (i == 0 || classes[i - 1] < classes[i]);
    archive.require(is_sound, "its classes or features do not exist");
  }
  if (kind == ClassifierKind::Svm) svm.archive(archive, bins.columns(), classes.size());
  else trees.archive(archive, bins.columns());
  archive(calibration, patch_calibration, correlation, novelty, sources, device);
  if (!archive.isReading()) return;
  archive.require((kind == ClassifierKind::Svm || trees.base.size() == classes.size()) &&
                      calibration.bias.size() == classes.size() && patch_calibration.bias.size() == classes.size() &&
                      correlation >= 0.0 && correlation <= 1.0 && novelty.low_values.size() == bins.columns() &&
                      novelty.high_values.size() == bins.columns(),
                  "the sizes of its parts differ");
}

const LabelModel& modelFor(const LabelModel& model, const std::string& device) {
  return model.of_other_devices && device != model.device ? *model.of_other_devices : model;
}

LabelModel withPrecision(LabelModel model, double precision) {
  model.precision = precision;
  if (!model.of_other_devices) return model;
  LabelModel other = *model.of_other_devices;
  other.precision = precision;
  model.of_other_devices = std::make_shared<const LabelModel>(std::move(other));
  return model;
}

std::string printModel(LabelModel model) {
  urban_nav_core::Archive archive;
  model.archive(archive);
  model.samples.archive(archive, model.bins.columns(), model.classes.size());
  model.sure.archive(archive);
  return urban_nav_core::seal(kModelName, kModelVersion, archive.take());
}

LabelModel parseModel(std::string_view bytes, const std::string& name) {
  LabelModel model;
  try {
    const auto unsealed = urban_nav_core::unseal(kModelName, kOldestVersion, kModelVersion, bytes);
    urban_nav_core::Archive archive(unsealed.content, kModelName);
    model.archive(archive);
    if (unsealed.version > kOldestVersion) model.samples.archive(archive, model.bins.columns(), model.classes.size());
    if (unsealed.version >= kThresholdsVersion) model.sure.archive(archive);
    archive.finish();
    model.place_novelty = PlaceNovelty(model.features, model.bins, model.samples);
  } catch (const urban_nav_core::DataError& error) {
    const std::string foreign = urban_nav_core::describeForeignContent(bytes);
    throw urban_nav_core::UserError(name, foreign.empty() ? error.what() : foreign,
                                    "a model of `urban_nav labels train`");
  }
  return model;
}

LabelModel readModel(const std::string& path) {
  return path == "default" ? defaultModel() : parseModel(urban_nav_core::readBytes(path), path);
}

std::string modelDigest(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  std::string digits;
  for (int shift = 60; shift >= 0; shift -= 4) digits += "0123456789abcdef"[hash >> shift & 15u];
  return digits;
}

}  // namespace scene_labeler
