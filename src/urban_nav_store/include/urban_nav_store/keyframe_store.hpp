// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_store/session.hpp"

namespace urban_nav_store {

/// What is kept of a frame so that the place can be known again, and shown: its picture, and its features in the bytes of the stage that
/// made them.
struct StoredKeyframe {
  urban_nav_core::StampNs stamp = 0;
  std::string image;     ///< as a file of pictures has it (JPEG, PNG): also the thumbnail
  std::string features;  ///< packed; the stage's business
};
bool operator==(const StoredKeyframe& a, const StoredKeyframe& b);

class KeyframeStore {
 public:
  virtual ~KeyframeStore() = default;

  /// One with the stamp of another of this camera replaces it.
  virtual void put(const SessionId& session, const std::string& camera, const StoredKeyframe& keyframe) = 0;

  virtual std::optional<StoredKeyframe> get(const SessionId& session, const std::string& camera,
                                            urban_nav_core::StampNs stamp) const = 0;
  /// In order of time. None where the store is of a version that had no keyframes.
  virtual std::vector<urban_nav_core::StampNs> stamps(const SessionId& session, const std::string& camera) const = 0;
  /// Frame names, sorted.
  virtual std::vector<std::string> cameras(const SessionId& session) const = 0;
};

}  // namespace urban_nav_store
