// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/compact_look.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {
namespace {

// For a unit vector of 64 sums of two elements, which are limited to 0.2 before the last normalisation; few are larger.
constexpr float kLevelsPerUnit = 40.0F;
constexpr int kHighestLevel = 15;
constexpr float kHighestCoordinate = 65535.0F;
constexpr std::size_t kLookHeader = 3;  // cameras, number of features
constexpr std::size_t kPackedDescriptor = kLookElements / 2;
constexpr std::size_t kLookEntry = kPackedDescriptor + 5;

std::uint16_t packShare(float share) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(share, 0.0F, 1.0F) * kHighestCoordinate));
}

void append16(std::string& bytes, std::uint16_t value) {
  bytes.push_back(static_cast<char>(value & 255u));
  bytes.push_back(static_cast<char>(value >> 8));
}

std::uint16_t read16(std::string_view bytes, std::size_t at) {
  return static_cast<std::uint16_t>(static_cast<unsigned char>(bytes[at]) | static_cast<unsigned char>(bytes[at + 1])
                                                                                << 8);
}

int level(float element) {
  return std::clamp(static_cast<int>(std::lround(element * kLevelsPerUnit)), 0, kHighestLevel);
}

}  // namespace

std::string packLook(const LookFeatures& look) {
  const std::size_t count = std::min<std::size_t>(look.size(), 65535);
  std::string bytes;
  bytes.reserve(kLookHeader + count * kLookEntry);
  bytes.push_back(static_cast<char>(look.cameras));
  append16(bytes, static_cast<std::uint16_t>(count));
  for (std::size_t k = 0; k < count; ++k) {
    const auto descriptor = look.descriptors.col(static_cast<Eigen::Index>(k));
    for (Eigen::Index i = 0; i < descriptor.size(); i += 2)
      bytes.push_back(static_cast<char>(level(descriptor(i)) | level(descriptor(i + 1)) << 4));
    const Eigen::Vector2f& direction = look.directions[k];
    const float camera = std::clamp(std::floor(direction.x()), 0.0F, 255.0F);
    bytes.push_back(static_cast<char>(static_cast<std::uint8_t>(camera)));
    append16(bytes, packShare(direction.x() - camera));
    append16(bytes, packShare(direction.y()));
  }
  return bytes;
}

std::uint8_t checkLook(std::string_view bytes, const std::string& name) {
  const std::size_t count = bytes.size() < kLookHeader ? 0 : read16(bytes, 1);
  if (bytes.size() != kLookHeader + count * kLookEntry || bytes.front() == 0)
    throw urban_nav_core::DataError(name, "the descriptors are truncated or damaged", "");
  return static_cast<std::uint8_t>(bytes.front());
}

LookFeatures unpackLook(std::string_view bytes, const std::string& name) {
  LookFeatures look;
  look.cameras = checkLook(bytes, name);
  const std::size_t count = read16(bytes, 1);
  look.descriptors.resize(Eigen::NoChange, static_cast<Eigen::Index>(count));
  look.directions.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t at = kLookHeader + k * kLookEntry;
    auto descriptor = look.descriptors.col(static_cast<Eigen::Index>(k));
    for (std::size_t i = 0; i < kPackedDescriptor; ++i) {
      const auto pair = static_cast<unsigned char>(bytes[at + i]);
      descriptor(static_cast<Eigen::Index>(2 * i)) = static_cast<float>(pair & 15u);
      descriptor(static_cast<Eigen::Index>(2 * i + 1)) = static_cast<float>(pair >> 4);
    }
    descriptor /= std::max(1.0F, descriptor.norm());
    const std::size_t place = at + kPackedDescriptor;
    look.directions.emplace_back(static_cast<float>(static_cast<unsigned char>(bytes[place])) +
                                     static_cast<float>(read16(bytes, place + 1)) / kHighestCoordinate,
                                 static_cast<float>(read16(bytes, place + 3)) / kHighestCoordinate);
  }
  return look;
}

}  // namespace fabmap_node
