// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_store/tables/stored_place.hpp"

namespace urban_nav_store {

/// What place recognition needs of the left image of a keyframe, in sessions whose places are panoramas: localization
/// finds keyframes by it. Without a thumbnail, since the keyframe has the image.
struct StoredKeyframePlace : StoredPlace {
  static Table table() {
    Table table = StoredPlace::table();
    table.name = "keyframe_place";
    table.since = 5;
    return table;
  }
};

}  // namespace urban_nav_store
