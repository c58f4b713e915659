// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/session/stored_keyframe.hpp"

#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/deflate.hpp"

namespace urban_nav_registration {

using urban_nav_store::StoredKeyframe;

namespace {

constexpr const char* kKind = "keyframe of loop_metric";
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kMostBytes = std::size_t{1} << 28;

/// Returns the features as sealed; those of stores of schema 11 and older are not compressed.
std::string unpackFeatures(const std::string& features) {
  if (urban_nav_core::isSealed(features)) return features;
  std::optional<std::string> sealed = urban_nav_store::inflated(features, kMostBytes);
  if (!sealed)
    throw urban_nav_core::DataError(std::string("state of ") + kKind, "is damaged: it cannot be unpacked", "");
  return std::move(*sealed);
}

}  // namespace

StoredKeyframe toStoredKeyframe(const Keyframe& keyframe) {
  StoredKeyframe stored;
  stored.stamp = keyframe.at.stamp;
  stored.image.assign(keyframe.image.begin(), keyframe.image.end());
  Keyframe rest = keyframe;  // session and image have separate columns
  rest.at.session.clear();
  rest.image.clear();
  urban_nav_core::Archive bytes;
  archive(bytes, rest);
  stored.features = urban_nav_store::deflated(urban_nav_core::seal(kKind, kVersion, bytes.take()));
  return stored;
}

Keyframe toKeyframe(const StoredKeyframe& stored, const std::string& session) {
  const std::string features = unpackFeatures(stored.features);
  urban_nav_core::Archive bytes(urban_nav_core::unseal(kKind, kVersion, features), kKind);
  Keyframe keyframe;
  archive(bytes, keyframe);
  bytes.finish();
  keyframe.at = {session, stored.stamp};
  keyframe.image.assign(stored.image.begin(), stored.image.end());
  return keyframe;
}

}  // namespace urban_nav_registration
