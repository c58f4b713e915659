// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "ablation.hpp"
#include "swf_vo/swf_vo.hpp"

namespace swf_vo {

/// Returns a filter with parts of the method switched off, for comparison. Throws UserError like the constructor of
/// SwfVo.
SwfVo makeAblated(const Ablation& ablation, const Parameters& parameters, const urban_nav_core::StereoCamera& camera,
                  const urban_nav_core::Pose& T_base_camera);
/// Returns such a filter that continues from the state of another. Throws UserError if the other had other parts
/// switched off, and whatever the constructor of SwfVo throws.
SwfVo makeAblated(const Ablation& ablation, const Parameters& parameters, const urban_nav_core::StereoCamera& camera,
                  const urban_nav_core::Pose& T_base_camera, std::string_view state);

}  // namespace swf_vo
