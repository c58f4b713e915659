// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/compact_look.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {
namespace {

constexpr char kMarker = 0;   // number of cameras in the first form, which is never 0
constexpr char kVersion = 2;  // follows the marker
constexpr float kHighestAzimuth = 65535.0F, kHighestHeight = 255.0F;
constexpr std::size_t kMostFeatures = 65535;
constexpr std::size_t kHeader = 5;  // marker, version, cameras, number of features
constexpr std::size_t kPlane = 8;   // bytes
constexpr std::size_t kEntry = 2 * kPlane + 3;
static_assert(kHeader + kLookFeatures * kEntry <= 20000);

// First form: cameras, number of features; each with 64 elements of 4 bits, camera, and 16 bits per coordinate.
constexpr std::size_t kFirstHeader = 3;
constexpr std::size_t kFirstDescriptor = kLookElements / 2;
constexpr std::size_t kFirstEntry = kFirstDescriptor + 5;
constexpr float kHighestCoordinate = 65535.0F;

unsigned byteAt(std::string_view bytes, std::size_t at) { return static_cast<unsigned char>(bytes[at]); }

unsigned read16(std::string_view bytes, std::size_t at) { return byteAt(bytes, at) | byteAt(bytes, at + 1) << 8; }

std::uint64_t readPlane(std::string_view bytes, std::size_t at) {
  std::uint64_t plane = 0;
  for (std::size_t i = 0; i < kPlane; ++i) plane |= std::uint64_t{byteAt(bytes, at + i)} << (8 * i);
  return plane;
}

void append(std::string& bytes, std::uint64_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 255u));
}

std::uint64_t packShare(float share, float highest) {
  return static_cast<std::uint64_t>(std::lround(std::clamp(share, 0.0F, 1.0F) * highest));
}

/// Where the parts of packed features are.
struct LookLayout {
  bool is_first_form = false;
  std::uint8_t cameras = 1;
  std::size_t count = 0;
};

LookLayout checkLayout(std::string_view bytes, const std::string& name) {
  LookLayout layout;
  layout.is_first_form = !bytes.empty() && bytes.front() != kMarker;
  const std::size_t header = layout.is_first_form ? kFirstHeader : kHeader;
  const std::size_t entry = layout.is_first_form ? kFirstEntry : kEntry;
  bool is_whole = bytes.size() >= header;
  if (is_whole) {
    layout.cameras = static_cast<std::uint8_t>(byteAt(bytes, layout.is_first_form ? 0 : 2));
    layout.count = read16(bytes, header - 2);
    is_whole = layout.cameras > 0 && bytes.size() == header + layout.count * entry &&
               (layout.is_first_form || bytes[1] == kVersion);
  }
  if (!is_whole) throw urban_nav_core::DataError(name, "descriptors of a place that are truncated or damaged", "");
  return layout;
}

LookFeature unpackFirst(std::string_view entry) {
  LookElements elements{};
  for (std::size_t i = 0; i < kFirstDescriptor; ++i) {
    const unsigned pair = byteAt(entry, i);
    elements[2 * i] = static_cast<std::uint16_t>(pair & 15u);
    elements[2 * i + 1] = static_cast<std::uint16_t>(pair >> 4);
  }
  const auto camera = static_cast<float>(byteAt(entry, kFirstDescriptor));
  return lookFeature(elements, camera + static_cast<float>(read16(entry, kFirstDescriptor + 1)) / kHighestCoordinate,
                     static_cast<float>(read16(entry, kFirstDescriptor + 3)) / kHighestCoordinate);
}

LookFeature unpackSecond(std::string_view entry, float cameras) {
  LookFeature feature;
  feature.middle = readPlane(entry, 0);
  feature.top = readPlane(entry, kPlane);
  feature.azimuth = cameras * static_cast<float>(read16(entry, 2 * kPlane)) / kHighestAzimuth;
  feature.height = static_cast<float>(byteAt(entry, 2 * kPlane + 2)) / kHighestHeight;
  return feature;
}

}  // namespace

std::string packLook(const LookFeatures& look) {
  const std::size_t count = std::min(look.size(), kMostFeatures);
  const auto cameras = static_cast<float>(look.cameras);
  std::string bytes = {kMarker, kVersion};
  bytes.reserve(kHeader + count * kEntry);
  append(bytes, look.cameras, 1);
  append(bytes, count, 2);
  for (std::size_t k = 0; k < count; ++k) {
    const LookFeature& feature = look.features[k];
    append(bytes, feature.middle, kPlane);
    append(bytes, feature.top, kPlane);
    append(bytes, packShare(feature.azimuth / cameras, kHighestAzimuth), 2);
    append(bytes, packShare(feature.height, kHighestHeight), 1);
  }
  return bytes;
}

std::uint8_t checkLook(std::string_view bytes, const std::string& name) { return checkLayout(bytes, name).cameras; }

LookFeatures unpackLook(std::string_view bytes, const std::string& name) {
  const LookLayout layout = checkLayout(bytes, name);
  LookFeatures look;
  look.cameras = layout.cameras;
  look.features.reserve(layout.count);
  const std::size_t entry = layout.is_first_form ? kFirstEntry : kEntry;
  for (std::size_t at = layout.is_first_form ? kFirstHeader : kHeader; at < bytes.size(); at += entry)
    look.features.push_back(layout.is_first_form
                                ? unpackFirst(bytes.substr(at, entry))
                                : unpackSecond(bytes.substr(at, entry), static_cast<float>(look.cameras)));
  const auto isLower = [](const LookFeature& a, const LookFeature& b) { return a.height < b.height; };
  if (!std::is_sorted(look.features.begin(), look.features.end(), isLower)) sortByHeight(look.features);
  return look;
}

}  // namespace fabmap_node
