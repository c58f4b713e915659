// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/labelled_map.hpp"

#include <memory>
#include <utility>

#include "laser_mapper/map_files.hpp"
#include "topics/labels/label_columns.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using scene_labeler::PointLabel;
using scene_labeler::SceneClass;

namespace {

constexpr const char* kLabelsState = "scene_labeler/map";
constexpr const char* kLabelsSeal = "labels of a map";
constexpr std::uint32_t kLabelsVersion = 1;
constexpr std::size_t kLabelBytes = 3;  // class, probability, unsure

struct StoredLabels {
  std::int64_t digest = 0;  ///< of the points
  std::vector<PointLabel> labels;
};

/// Returns nullopt if the store has none, or those of another version.
std::optional<StoredLabels> readLabels(urban_nav_store::Store& store, const urban_nav_store::SessionId& first) {
  const auto state = store.states().get(first, kLabelsState);
  if (!state) return std::nullopt;
  StoredLabels stored;
  std::string bytes;
  try {
    urban_nav_core::Archive archive(urban_nav_core::unseal(kLabelsSeal, kLabelsVersion, *state), kLabelsSeal);
    archive(stored.digest, bytes);
    archive.finish();
  } catch (const urban_nav_core::DataError&) {
    return std::nullopt;
  }
  if (bytes.size() % kLabelBytes != 0) return std::nullopt;
  stored.labels.resize(bytes.size() / kLabelBytes);
  for (std::size_t i = 0; i < stored.labels.size(); ++i) {
    const auto byte = [&](std::size_t k) { return static_cast<std::uint8_t>(bytes[kLabelBytes * i + k]); };
    const bool is_class = byte(0) < scene_labeler::kClassCount;
    stored.labels[i] = {is_class ? static_cast<SceneClass>(byte(0)) : SceneClass::None, byte(1), byte(2) != 0};
  }
  return stored;
}

}  // namespace

urban_nav_core::PlyLayout labelledMapLayout() {
  urban_nav_core::PlyLayout layout = laser_mapper::mapLayout();
  const urban_nav_core::PlyLayout labels = labelLayout();
  layout.properties.insert(layout.properties.end(), labels.properties.begin(), labels.properties.end());
  layout.comments.insert(layout.comments.end(), labels.comments.begin(), labels.comments.end());
  return layout;
}

void appendPointLabel(std::string& bytes, const PointLabel& label) {
  urban_nav_core::appendLittleEndian(bytes, static_cast<std::uint8_t>(label.label));
  urban_nav_core::appendLittleEndian(bytes, static_cast<float>(label.probability) / 255.0F);
  urban_nav_core::appendLittleEndian(bytes, static_cast<std::uint8_t>(label.is_unsure ? 1 : 0));
}

void storeMapLabels(urban_nav_store::Store& store, const urban_nav_store::SessionId& first,
                    const MapPointsDigest& digest, const std::vector<PointLabel>& labels) {
  urban_nav_core::Archive archive;
  std::int64_t hash = digest.value();
  std::string bytes;
  bytes.reserve(kLabelBytes * labels.size());
  for (const PointLabel& label : labels) {
    bytes += static_cast<char>(label.label);
    bytes += static_cast<char>(label.probability);
    bytes += static_cast<char>(label.is_unsure ? 1 : 0);
  }
  archive(hash, bytes);
  store.states().put(first, kLabelsState, urban_nav_core::seal(kLabelsSeal, kLabelsVersion, archive.take()));
  store.commit();
}

std::optional<PointAttributes> labelAttributes(urban_nav_store::Store& store, const urban_nav_store::SessionId& first) {
  const std::optional<StoredLabels> stored = readLabels(store, first);
  if (!stored) return std::nullopt;
  const auto labels = std::make_shared<const std::vector<PointLabel>>(stored->labels);
  const auto labelAt = [labels](std::size_t point) { return point < labels->size() ? (*labels)[point] : PointLabel(); };
  PointAttributes attributes;
  attributes.digest = stored->digest;
  attributes.points = labels->size();
  attributes.ply = labelLayout();
  attributes.las = {"label", urban_nav_core::LasAttribute::Type::UChar, "class of scene_labeler"};
  attributes.append_ply = [labelAt](std::size_t point, std::string& bytes) { appendPointLabel(bytes, labelAt(point)); };
  attributes.append_las = [labelAt](std::size_t point, std::string& bytes) {
    bytes += static_cast<char>(labelAt(point).label);
  };
  attributes.las_classification = [labelAt](std::size_t point) { return lasClassification(labelAt(point).label); };
  return attributes;
}

}  // namespace urban_nav
