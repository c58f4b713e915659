// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "scene_labeler/classes.hpp"
#include "scene_labeler/features/features.hpp"
#include "scene_labeler/model/calibration.hpp"
#include "scene_labeler/model/feature_bins.hpp"
#include "scene_labeler/model/model_samples.hpp"
#include "scene_labeler/model/place_novelty.hpp"
#include "scene_labeler/model/sure_thresholds.hpp"
#include "scene_labeler/model/svm_bank.hpp"
#include "scene_labeler/model/tree_ensemble.hpp"

namespace scene_labeler {
/// Kind of classifier of a label model.
enum class ClassifierKind : std::uint8_t { Svm, Forest, Boosted };
const char* toString(ClassifierKind kind);

/// Ranges of features in the training data, for the detection of returns outside them.
struct NoveltyRanges {
  std::vector<float> low_values, high_values;  ///< values outside this range are outside the training data
  std::uint32_t limit = 3;                     ///< a return with more features outside is unlike the training data

  void archive(urban_nav_core::Archive& archive);
};

/// Trained classifier with all data required to apply it.
struct LabelModel {
  ClassifierKind kind = ClassifierKind::Boosted;
  FeatureSet features = FeatureSet::All;
  std::vector<SceneClass> classes;  ///< known classes, ascending
  FeatureBins bins;
  TreeEnsemble trees;  ///< forest and boosted
  SvmBank svm;         ///< svm
  Calibration calibration;
  Calibration patch_calibration;  ///< of the fused scores of patches
  double correlation = 1.0;       ///< of the errors of returns within a patch, 0...1
  NoveltyRanges novelty;
  std::string device;                     ///< device of the reflectance in training; that of other devices is ignored
  std::vector<std::string> sources;       ///< names of the training scenes or sessions
  ModelSamples samples;                   ///< for continued training; empty in models of version 2
  PlaceNovelty place_novelty;             ///< computed from the samples; not in the file
  SureThresholds sure;                    ///< empty in models of version 3
  double precision = kStandardPrecision;  ///< share of the sure answers that is to be right; not in the file
  /// Model for scenes of other devices, of which this one knows neither light nor density; null: this one. Not in the
  /// file.
  std::shared_ptr<const LabelModel> of_other_devices;

  /// Writes log probabilities of a row of features, one per class.
  void logProbabilities(const float* row, float* logs) const;
  /// Returns the number of features of a row outside the training data.
  std::uint32_t countOutside(const float* row) const;
  /// Reads or writes everything except the samples and the thresholds.
  void archive(urban_nav_core::Archive& archive);
};

/// Returns the model for scenes of a device (Scene::device): `model`, or its model of other devices.
const LabelModel& modelFor(const LabelModel& model, const std::string& device);

/// Returns a model whose sure answers, also those of its model of other devices, are to be right in the share
/// `precision`.
LabelModel withPrecision(LabelModel model, double precision);

/// Returns the bytes of a model, with its version and a checksum.
std::string printModel(LabelModel model);
/// Reads a model of this or a previous version. Throws UserError with `name` if the bytes are damaged, not a model,
/// or of another version.
LabelModel parseModel(std::string_view bytes, const std::string& name);

/// Return the built-in model, trained on simulated drives of the robot, and its bytes. Its model of other devices is
/// that of the clouds of simulated 3D LiDARs and push-broom lasers, by shape.
LabelModel defaultModel();
std::string_view defaultModelBytes();
std::string_view defaultCloudModelBytes();
/// Reads the model given by the parameter `model`: a file, or `default`. Throws UserError like parseModel().
LabelModel readModel(const std::string& path);

/// Returns the digest of the bytes of a model: 16 hexadecimal digits (FNV-1a).
std::string modelDigest(std::string_view bytes);

}  // namespace scene_labeler
