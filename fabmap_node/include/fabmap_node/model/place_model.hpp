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

/// Everything that training provides: words, their dependence, samples of places for the likelihood of a new one, and
/// the calibrations of probabilities for single images and for panoramas: of an observation alone, and with those
/// before it. Plain data.
struct PlaceModel {
  Vocabulary vocabulary;
  ChowLiuTree tree;  ///< probabilities in single precision, as the file has them
  Detector detector{0.39, 0.05};
  std::vector<WordSet> sampled_places;
  PlaceCalibration single, panorama;                                   ///< of an observation alone
  std::optional<PlaceCalibration> single_sequence, panorama_sequence;  ///< nullopt: sequences are not used

  const PlaceCalibration& calibration(int cameras) const { return cameras > 1 ? panorama : single; }
  const std::optional<PlaceCalibration>& sequenceCalibration(int cameras) const {
    return cameras > 1 ? panorama_sequence : single_sequence;
  }
};

/// Returns the bytes of a model: versioned, with a checksum, the same on every machine.
std::string printModel(const PlaceModel& model);
/// Returns the model of printModel(). Models of the versions before, calibrated for another second look, take the
/// calibrations of the suite's model. Throws DataError with `name` if the bytes are truncated, damaged, of a later
/// version, of a model of OpenCV's features, or inconsistent.
PlaceModel parseModel(std::string_view bytes, const std::string& name);
/// Returns the bytes of a model without version and checksum: for tests of damaged content.
std::string printModelContent(const PlaceModel& model);
/// Returns the model of printModelContent(). Throws DataError with `name` if the content is damaged.
PlaceModel parseModelContent(std::string_view content, const std::string& name);
/// Reads a model file. Throws UserError if it is missing, DataError as parseModel().
PlaceModel readModel(const std::string& path);
/// Returns the bytes of the model that the suite comes with; they live as long as the program.
std::string_view defaultModelBytes();
PlaceModel defaultModel();
/// Returns 16 hexadecimal digits that identify the content of a model.
std::string modelHash(std::string_view bytes);

/// Rounds the probabilities of a tree to single precision, as printModel() stores them.
void roundToFile(ChowLiuTree& tree);

}  // namespace fabmap_node
