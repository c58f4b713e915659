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
/// Parses the output of printModel(). Models of earlier versions, whose panoramas are calibrated for another comparison
/// of descriptors, use the calibrations of panoramas of the built-in model. Throws DataError with `name` if the bytes
/// are truncated, damaged, of a later version, of a model with OpenCV's features, or inconsistent.
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
/// Returns a hash of the content of a model, 16 hexadecimal digits.
std::string modelHash(std::string_view bytes);

/// Rounds the probabilities of a tree to single precision, as printModel() stores them.
void roundToFile(ChowLiuTree& tree);

}  // namespace fabmap_node
