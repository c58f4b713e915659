// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_registration/keyframe/keyframe.hpp"
#include "urban_nav_store/keyframe_store.hpp"

namespace urban_nav_registration {

/// Name of the left camera for keyframes in a store.
constexpr const char* kKeyframeCamera = urban_nav_core::frames::kStereoLeft;

/// Converts a keyframe to its row in a store. The session is not part of the row.
urban_nav_store::StoredKeyframe toStoredKeyframe(const Keyframe& keyframe);
/// Converts a row of a store to the keyframe of a session. Throws DataError if the features are damaged or of another
/// version.
Keyframe toKeyframe(const urban_nav_store::StoredKeyframe& stored, const std::string& session);

}  // namespace urban_nav_registration
