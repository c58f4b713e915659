// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/depth_frame.hpp"

#include "urban_nav_core/types/error.hpp"

namespace laser_mapper {

DepthFrame depthFrame(const urban_nav_store::DepthView& view) {
  if (!(view.fx > 0.0) || !(view.fy > 0.0) || !(view.baseline > 0.0) || view.step < 1)
    throw urban_nav_core::DataError("depth_view", "the camera of a depth image has no focal length or baseline", "");
  DepthFrame frame;
  frame.stamp = view.stamp;
  frame.T_base_camera = view.T_base_camera;
  frame.step = static_cast<float>(view.step);
  frame.fx = static_cast<float>(view.fx);
  frame.fy = static_cast<float>(view.fy);
  frame.cx = static_cast<float>(view.cx);
  frame.cy = static_cast<float>(view.cy);
  frame.focal_baseline = static_cast<float>(view.fx * view.baseline);
  frame.samples = view.samples();
  return frame;
}

}  // namespace laser_mapper
