// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/compact_look.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {
namespace {

constexpr std::size_t kMostFeatures = 65535;
constexpr float kHighest16 = 65535.0F, kHighest8 = 255.0F;

// Encoding of single images, and of panoramas by earlier versions: number of cameras, number of features, and of each
// feature the elements in steps of a unit vector, camera and direction. Elements are sums of two, which are limited to
// 0.2 before the last normalisation; few are larger than the highest level.
constexpr std::size_t kSingleHeader = 3;
constexpr std::size_t kPackedDescriptor = kLookElements / 2;
constexpr float kLevelsPerUnit = 40.0F;
constexpr int kHighestLevel = 15;
static_assert(kPackedDescriptor + 5 == kSingleFeatureBytes);

// Encoding of panoramas: marker, version, number of cameras, number of features, and of each feature the two planes of
// bits, azimuth and elevation.
constexpr char kMarker = 0;  // where single images have their number of cameras, which is never 0
constexpr char kVersion = 2;
constexpr std::size_t kPanoramaHeader = 5;
constexpr std::size_t kPlane = sizeof(std::uint64_t);
static_assert(2 * kPlane + 3 == kPanoramaFeatureBytes);

unsigned byteAt(std::string_view bytes, std::size_t at) { return static_cast<unsigned char>(bytes[at]); }

std::uint64_t readInteger(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) value |= std::uint64_t{byteAt(bytes, at + i)} << (8 * i);
  return value;
}

float readShare(std::string_view bytes, std::size_t at) {
  return static_cast<float>(readInteger(bytes, at, 2)) / kHighest16;
}

void append(std::string& bytes, std::uint64_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 255u));
}

void appendShare(std::string& bytes, float share, float highest, std::size_t size) {
  append(bytes, static_cast<std::uint64_t>(std::lround(std::clamp(share, 0.0F, 1.0F) * highest)), size);
}

unsigned level(float element) {
  return static_cast<unsigned>(std::clamp(static_cast<int>(std::lround(element * kLevelsPerUnit)), 0, kHighestLevel));
}

void appendSingle(std::string& bytes, const ComparedFeatures& features, std::size_t k) {
  const auto descriptor = features.descriptors.col(static_cast<Eigen::Index>(k));
  for (Eigen::Index i = 0; i < descriptor.size(); i += 2)
    append(bytes, level(descriptor(i)) | level(descriptor(i + 1)) << 4, 1);
  const Eigen::Vector2f& direction = features.directions[k];
  const float camera = std::clamp(std::floor(direction.x()), 0.0F, kHighest8);
  append(bytes, static_cast<std::uint8_t>(camera), 1);
  appendShare(bytes, direction.x() - camera, kHighest16, 2);
  appendShare(bytes, direction.y(), kHighest16, 2);
}

std::array<unsigned, kLookElements> readElements(std::string_view entry) {
  std::array<unsigned, kLookElements> elements{};
  for (std::size_t i = 0; i < kPackedDescriptor; ++i) {
    elements[2 * i] = byteAt(entry, i) & 15u;
    elements[2 * i + 1] = byteAt(entry, i) >> 4;
  }
  return elements;
}

Eigen::Vector2f readDirection(std::string_view entry) {
  return {static_cast<float>(byteAt(entry, kPackedDescriptor)) + readShare(entry, kPackedDescriptor + 1),
          readShare(entry, kPackedDescriptor + 3)};
}

PanoramaFeature readPanoramaFeature(std::string_view entry, float cameras) {
  PanoramaFeature feature;
  feature.middle = readInteger(entry, 0, kPlane);
  feature.top = readInteger(entry, kPlane, kPlane);
  feature.direction = {cameras * readShare(entry, 2 * kPlane),
                       static_cast<float>(byteAt(entry, 2 * kPlane + 2)) / kHighest8};
  return feature;
}

/// Layout of an encoding.
struct Layout {
  bool is_panorama = false;
  std::uint8_t cameras = 1;
  std::size_t header = 0, entry = 0, count = 0;
};

Layout readLayout(std::string_view bytes, const std::string& name) {
  Layout layout;
  layout.is_panorama = !bytes.empty() && bytes.front() == kMarker;
  layout.header = layout.is_panorama ? kPanoramaHeader : kSingleHeader;
  layout.entry = layout.is_panorama ? kPanoramaFeatureBytes : kSingleFeatureBytes;
  bool is_valid = bytes.size() >= layout.header && (!layout.is_panorama || bytes[1] == kVersion);
  if (is_valid) {
    layout.cameras = static_cast<std::uint8_t>(byteAt(bytes, layout.header - 3));
    layout.count = readInteger(bytes, layout.header - 2, 2);
    is_valid =
        layout.cameras > (layout.is_panorama ? 1 : 0) && bytes.size() == layout.header + layout.count * layout.entry;
  }
  if (!is_valid) throw urban_nav_core::DataError(name, "descriptors of a place that are truncated or damaged", "");
  return layout;
}

}  // namespace

std::string packLook(const ComparedFeatures& features) {
  const std::size_t count = std::min(features.size(), kMostFeatures);
  const bool is_panorama = features.cameras > 1;
  std::string bytes;
  bytes.reserve(kPanoramaHeader + count * kSingleFeatureBytes);
  if (is_panorama) bytes = {kMarker, kVersion};
  append(bytes, features.cameras, 1);
  append(bytes, count, 2);
  for (std::size_t k = 0; k < count; ++k) {
    if (!is_panorama) {
      appendSingle(bytes, features, k);
      continue;
    }
    const PanoramaFeature& feature = features.panorama[k];
    append(bytes, feature.middle, kPlane);
    append(bytes, feature.top, kPlane);
    appendShare(bytes, feature.direction.x() / static_cast<float>(features.cameras), kHighest16, 2);
    appendShare(bytes, feature.direction.y(), kHighest8, 1);
  }
  return bytes;
}

std::uint8_t checkLook(std::string_view bytes, const std::string& name) { return readLayout(bytes, name).cameras; }

ComparedFeatures unpackLook(std::string_view bytes, const std::string& name) {
  const Layout layout = readLayout(bytes, name);
  ComparedFeatures features;
  features.cameras = layout.cameras;
  const bool is_single = features.cameras == 1;
  if (is_single) features.descriptors.resize(Eigen::NoChange, static_cast<Eigen::Index>(layout.count));
  for (std::size_t k = 0; k < layout.count; ++k) {
    const std::string_view entry = bytes.substr(layout.header + k * layout.entry, layout.entry);
    if (layout.is_panorama) {
      features.panorama.push_back(readPanoramaFeature(entry, static_cast<float>(features.cameras)));
      continue;
    }
    const std::array<unsigned, kLookElements> elements = readElements(entry);
    if (!is_single) {
      features.panorama.push_back(rankElements(elements));
      features.panorama.back().direction = readDirection(entry);
      continue;
    }
    auto descriptor = features.descriptors.col(static_cast<Eigen::Index>(k));
    for (std::size_t i = 0; i < elements.size(); ++i)
      descriptor(static_cast<Eigen::Index>(i)) = static_cast<float>(elements[i]);
    descriptor /= std::max(1.0F, descriptor.norm());
    features.directions.push_back(readDirection(entry));
  }
  sortByElevation(features.panorama);
  return features;
}

}  // namespace fabmap_node
