// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/model/place_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "fabmap_node/model/word_bytes.hpp"
#include "model/number_bytes.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/io/file_kind.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {

using urban_nav_core::Archive;
using urban_nav_core::DataError;

namespace {

// 1: without sequences. 1 and 2: panoramas calibrated for another comparison. 3: with OpenCV's features, which are no
// longer supported.
constexpr std::uint32_t kOldestVersion = 1, kOpencvVersion = 3, kModelVersion = 5;
constexpr char kModelName[] = "places model";
constexpr std::size_t kMostWords = 1'000'000;

void archiveCentres(Archive& archive, Vocabulary& vocabulary) {
  std::vector<std::uint8_t> bytes;
  if (!archive.isReading())
    for (const ByteDescriptor& centre : vocabulary.centres()) bytes.insert(bytes.end(), centre.begin(), centre.end());
  archive(bytes);
  if (!archive.isReading()) return;
  const std::size_t words = bytes.size() / kDescriptorBytes;
  archive.require(bytes.size() == words * kDescriptorBytes && words > 1 && words <= kMostWords,
                  "its number of words differs");
  std::vector<ByteDescriptor> centres(words);
  for (std::size_t i = 0; i < words; ++i)
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(i * kDescriptorBytes), kDescriptorBytes,
                centres[i].begin());
  vocabulary = Vocabulary(std::move(centres));
}

void archiveProbabilities(Archive& archive, std::vector<double>& values, std::size_t words) {
  std::vector<float> stored(values.begin(), values.end());
  archive(stored);
  if (!archive.isReading()) return;
  archive.require(stored.size() == words, "its numbers of probabilities and words differ");
  values.assign(stored.begin(), stored.end());
}

void archiveTree(Archive& archive, ChowLiuTree& tree, std::size_t words) {
  std::vector<std::uint8_t> parents;
  for (const Word parent : tree.parent) putNumber(parents, parent);
  archive(parents);
  if (archive.isReading()) {
    NumberReader reader(parents);
    tree.parent.clear();
    while (!reader.atEnd() && reader.isValid() && tree.parent.size() <= words) tree.parent.push_back(reader.next());
    archive.require(reader.isValid() && tree.parent.size() == words, "its numbers of parents and words differ");
  }
  archiveProbabilities(archive, tree.p, words);
  archiveProbabilities(archive, tree.p_parent_present, words);
  archiveProbabilities(archive, tree.p_parent_absent, words);
}

void archiveWords(Archive& archive, WordSet& set, std::size_t words) {
  std::vector<std::uint8_t> steps = packWords(set);
  archive(steps);
  if (!archive.isReading()) return;
  std::optional<WordSet> read = unpackWords(steps, words);
  archive.require(read.has_value(), "the words of a sampled place are not ascending");
  set = std::move(*read);
}

void archiveCalibration(Archive& archive, PlaceCalibration& calibration, std::uint32_t version) {
  archive(calibration.bias);
  for (std::size_t i = 0; i + (version < 2 ? 1 : 0) < calibration.weights.size(); ++i) archive(calibration.weights[i]);
  archive(calibration.floor, calibration.ceiling);
  archive.require(calibration.floor > 0.0 && calibration.floor < calibration.ceiling && calibration.ceiling < 1.0,
                  "limits of a calibration are not probabilities");
}

void archiveSequence(Archive& archive, std::optional<PlaceCalibration>& calibration) {
  bool is_there = calibration.has_value();
  archive(is_there);
  if (archive.isReading() && is_there) calibration.emplace();
  if (is_there) archiveCalibration(archive, *calibration, kModelVersion);
}

void archiveModel(Archive& archive, PlaceModel& model, std::uint32_t version) {
  archiveCentres(archive, model.vocabulary);
  const std::size_t words = model.vocabulary.size();
  archiveTree(archive, model.tree, words);
  Detector& detector = model.detector;
  archive(detector.present_given_exists, detector.present_given_absent);
  archive.require(detector.present_given_absent >= 0.0 &&
                      detector.present_given_absent < detector.present_given_exists &&
                      detector.present_given_exists < 1.0,
                  "probabilities of its detector are invalid");
  std::size_t samples = model.sampled_places.size();
  archive.count(samples, 8);
  if (archive.isReading()) model.sampled_places.assign(samples, {});
  for (WordSet& set : model.sampled_places) archiveWords(archive, set, words);
  archiveCalibration(archive, model.single, version);
  archiveCalibration(archive, model.panorama, version);
  if (version < 2) return;
  archiveSequence(archive, model.single_sequence);
  archiveSequence(archive, model.panorama_sequence);
}

std::string printVersion(const PlaceModel& model, std::uint32_t version) {
  Archive archive;
  PlaceModel copy = model;
  archiveModel(archive, copy, version);
  return archive.take();
}

PlaceModel parseVersion(std::string_view content, std::uint32_t version, const std::string& name) {
  PlaceModel model;
  try {
    Archive archive(content, kModelName);
    archiveModel(archive, model, version);
    archive.finish();
    checkTree(model.tree, "tree");
  } catch (const urban_nav_core::Error& error) {
    throw DataError(name, error.what(), "a model written by places train");
  }
  return model;
}

}  // namespace

void roundToFile(ChowLiuTree& tree) {
  for (std::vector<double>* values : {&tree.p, &tree.p_parent_present, &tree.p_parent_absent})
    for (double& value : *values) value = static_cast<double>(static_cast<float>(value));
}

std::string printModelContent(const PlaceModel& model) { return printVersion(model, kModelVersion); }

std::string printModel(const PlaceModel& model) {
  return urban_nav_core::seal(kModelName, kModelVersion, printModelContent(model));
}

PlaceModel parseModelContent(std::string_view content, const std::string& name) {
  return parseVersion(content, kModelVersion, name);
}

PlaceModel parseModel(std::string_view bytes, const std::string& name) {
  urban_nav_core::UnsealedState state;
  try {
    state = urban_nav_core::unseal(kModelName, kOldestVersion, kModelVersion, bytes);
  } catch (const urban_nav_core::Error& error) {
    const std::string foreign = urban_nav_core::describeForeignContent(bytes);
    throw DataError(name, foreign.empty() ? error.what() : foreign,
                    foreign.empty() ? "a whole model written by places train"
                                    : "`default`, or a model written by places train, which contains a vocabulary");
  }
  if (state.version == kOpencvVersion)
    throw DataError(name, "a model of OpenCV's features (sift or orb)",
                    "a model of upright features, as places train writes it: train it again");
  PlaceModel model = parseVersion(state.content, state.version, name);
  if (state.version < kModelVersion) useSuppliedCalibrations(model);
  return model;
}

PlaceModel readModel(const std::string& path) { return parseModel(urban_nav_core::readBytes(path), path); }

std::string modelHash(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  std::string digits;
  for (int shift = 60; shift >= 0; shift -= 4) digits += "0123456789abcdef"[hash >> shift & 15u];
  return digits;
}

}  // namespace fabmap_node
