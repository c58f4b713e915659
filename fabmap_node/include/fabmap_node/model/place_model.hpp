// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fabmap_node/model/likelihood.hpp"
#include "fabmap_node/recognition/calibration.hpp"
#include "fabmap_node/vocabulary/vocabulary.hpp"

namespace fabmap_node {

/// Result of training: words, their dependence, sampled places for the likelihood of a new one, and calibrations of
/// probabilities for single images and for panoramas, of single observations and of sequences. Plain data.
struct PlaceModel {
  Vocabulary vocabulary;
  ChowLiuTree tree;  ///< probabilities in single precision, as in the file
  Detector detector{0.39, 0.05};
  std::vector<WordSet> sampled_places;
  PlaceCalibration single, panorama;                                   ///< of single observations
  std::optional<PlaceCalibration> single_sequence, panorama_sequence;  ///< nullopt: sequences are not used

  const PlaceCalibration& calibration(int cameras) const { return cameras > 1 ? panorama : single; }
  const std::optional<PlaceCalibration>& sequenceCalibration(int cameras) const {
    return cameras > 1 ? panorama_sequence : single_sequence;
  }
};

/// Returns the bytes of a model: versioned, with a checksum, identical on every machine.
std::string printModel(const PlaceModel& model);
/// Parses the output of printModel(). Models of earlier versions, whose calibrations are for other evidence, take
/// useSuppliedCalibrations(). Throws DataError with `name` if the bytes are truncated, damaged, of a later version, of
/// a model with OpenCV's features, or inconsistent.
PlaceModel parseModel(std::string_view bytes, const std::string& name);
/// Returns the bytes of a model without version and checksum, for tests with damaged content.
std::string printModelContent(const PlaceModel& model);
/// Parses the output of printModelContent(). Throws DataError with `name` if the content is damaged.
PlaceModel parseModelContent(std::string_view content, const std::string& name);
/// Reads a model file. Throws UserError if it is missing, DataError like parseModel().
PlaceModel readModel(const std::string& path);
/// Returns the bytes of the built-in model, which are static.
std::string_view defaultModelBytes();
PlaceModel defaultModel();
/// Sets the calibrations to those supplied with the program, fitted by src/urban_nav/bench/default_places_model.sh. The
/// evidence does not depend on vocabulary and map, so that they hold for every model.
void useSuppliedCalibrations(PlaceModel& model);
/// Returns the bytes of the model of this hash, if it is the built-in one or was so in an earlier version: stores refer
/// to it by its hash only (store/model_rows.hpp), so that a model that was once built in stays in the program.
std::optional<std::string_view> suppliedModel(const std::string& hash);
/// Returns a hash of the content of a model, 16 hexadecimal digits.
std::string modelHash(std::string_view bytes);

/// Rounds the probabilities of a tree to single precision, as printModel() stores them.
void roundToFile(ChowLiuTree& tree);

}  // namespace fabmap_node
