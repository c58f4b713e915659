// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_store/tables/stored_place.hpp"

namespace urban_nav_store {

/// Data of place recognition for the left image of a keyframe, in sessions whose places are panoramas; used by
/// localization to find keyframes. Without a thumbnail, since the keyframe has the image.
struct StoredKeyframePlace : StoredPlace {
  static Table table() {
    Table table = StoredPlace::table();
    table.name = "keyframe_place";
    table.since = 5;
    return table;
  }
};

}  // namespace urban_nav_store
