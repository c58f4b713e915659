// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_store/session.hpp"

namespace urban_nav_store {

/// Frame for place recognition and display: its image, and its features in the encoding of the stage that computed
/// them.
struct StoredKeyframe {
  urban_nav_core::StampNs stamp = 0;
  std::string image;     ///< encoded (JPEG, PNG); also the thumbnail
  std::string features;  ///< in the encoding of the stage
};
bool operator==(const StoredKeyframe& a, const StoredKeyframe& b);
/// Interface to the keyframes of a session store.
class KeyframeStore {
 public:
  virtual ~KeyframeStore() = default;

  /// Adds a keyframe, replacing one of the same camera and stamp.
  virtual void put(const SessionId& session, const std::string& camera, const StoredKeyframe& keyframe) = 0;

  virtual std::optional<StoredKeyframe> get(const SessionId& session, const std::string& camera,
                                            urban_nav_core::StampNs stamp) const = 0;
  /// Returns stamps in order of time. Empty if the store is older than schema 2.
  virtual std::vector<urban_nav_core::StampNs> stamps(const SessionId& session, const std::string& camera) const = 0;
  /// Returns frame names, sorted.
  virtual std::vector<std::string> cameras(const SessionId& session) const = 0;
};

}  // namespace urban_nav_store
