// SPDX-License-Identifier: BSD-3-Clause
#include "ablation/ablated.hpp"

namespace swf_vo {

using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;

/// Has access to the constructors of SwfVo that take an ablation.
class AblatedSwfVo {
 public:
  template <typename... Arguments>
  static SwfVo make(const Arguments&... arguments) {
    return SwfVo(arguments...);
  }
};

SwfVo makeAblated(const Ablation& ablation, const Parameters& parameters, const StereoCamera& camera,
                  const Pose& T_base_camera) {
  return AblatedSwfVo::make(ablation, parameters, camera, T_base_camera);
}

SwfVo makeAblated(const Ablation& ablation, const Parameters& parameters, const StereoCamera& camera,
                  const Pose& T_base_camera, std::string_view state) {
  return AblatedSwfVo::make(ablation, parameters, camera, T_base_camera, state);
}

}  // namespace swf_vo
