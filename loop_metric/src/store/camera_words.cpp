// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/camera_words.hpp"

#include "urban_nav_core/io/numbers.hpp"

namespace loop_metric {

std::string cameraWords(const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_base_left) {
  std::string words = std::to_string(camera.left.width) + "x" + std::to_string(camera.left.height);
  for (const double value : {camera.left.fx, camera.left.fy, camera.left.cx, camera.left.cy, camera.baseline,
                             T_base_left.t().x(), T_base_left.t().y(), T_base_left.t().z(), T_base_left.q().x(),
                             T_base_left.q().y(), T_base_left.q().z(), T_base_left.q().w()})
    words += " " + urban_nav_core::printNumber(value);
  return words;
}

}  // namespace loop_metric
