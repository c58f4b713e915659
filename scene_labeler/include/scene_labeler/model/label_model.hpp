// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene_labeler/classes.hpp"
#include "scene_labeler/features/features.hpp"
#include "scene_labeler/model/calibration.hpp"
#include "scene_labeler/model/feature_bins.hpp"
#include "scene_labeler/model/model_samples.hpp"
#include "scene_labeler/model/place_novelty.hpp"
#include "scene_labeler/model/svm_bank.hpp"
#include "scene_labeler/model/tree_ensemble.hpp"

namespace scene_labeler {

enum class ClassifierKind : std::uint8_t { Svm, Forest, Boosted };
const char* toString(ClassifierKind kind);

/// Ranges of features in the training data, to find returns unlike any of it.
struct NoveltyRanges {
  std::vector<float> low_values, high_values;  ///< beyond these a value lies outside the training data
  std::uint32_t limit = 3;                     ///< a return with more features outside is unlike the training data

  void archive(urban_nav_core::Archive& archive);
};

/// A trained classifier with everything that applying it takes.
struct LabelModel {
  ClassifierKind kind = ClassifierKind::Boosted;
  FeatureSet features = FeatureSet::All;
  std::vector<SceneClass> classes;  ///< that it knows, ascending
  FeatureBins bins;
  TreeEnsemble trees;  ///< forest and boosted
  SvmBank svm;         ///< svm
  Calibration calibration;
  Calibration patch_calibration;  ///< of the fused scores of patches
  double correlation = 1.0;       ///< of the errors of returns in a patch, 0...1
  NoveltyRanges novelty;
  std::string device;                ///< whose reflectance it was trained with; that of other devices is not used
  std::vector<std::string> sources;  ///< names of the scenes or sessions it was trained on
  ModelSamples samples;              ///< to continue training from; empty in models of version 2
  PlaceNovelty place_novelty;        ///< of the samples; not in the file

  /// Writes log probabilities of a row of features, one for each class.
  void logProbabilities(const float* row, float* logs) const;
  /// Returns how many features of a row lie outside the training data.
  std::uint32_t countOutside(const float* row) const;
  /// Everything but the samples.
  void archive(urban_nav_core::Archive& archive);
};

/// Returns the bytes of a model, with its version and a checksum.
std::string printModel(LabelModel model);
/// Reads a model of this version or the one before it. Throws UserError with `name` if the bytes are damaged, no model,
/// or of another version.
LabelModel parseModel(std::string_view bytes, const std::string& name);

/// Returns the model that is part of the library, from simulated drives, and its bytes.
LabelModel defaultModel();
std::string_view defaultModelBytes();
/// Reads the model that the parameter `model` names: a file, or `default`. Throws UserError as parseModel().
LabelModel readModel(const std::string& path);

/// Returns the digest of the bytes of a model: 16 hexadecimal digits (FNV-1a).
std::string modelDigest(std::string_view bytes);

}  // namespace scene_labeler
