// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/depth_frame.hpp"

#include "urban_nav_core/types/error.hpp"

namespace laser_mapper {

namespace {

/// Returns the frame of a row of the store without samples and baseline.
template <typename Row>
DepthFrame withoutSamples(const Row& row) {
  if (!(row.fx > 0.0) || !(row.fy > 0.0) || row.step < 1)
    throw urban_nav_core::DataError(Row::table().name, "the camera of a depth image has no focal length", "");
  DepthFrame frame;
  frame.stamp = row.stamp;
  frame.T_base_camera = row.T_base_camera;
  frame.step = static_cast<float>(row.step);
  frame.fx = static_cast<float>(row.fx);
  frame.fy = static_cast<float>(row.fy);
  frame.cx = static_cast<float>(row.cx);
  frame.cy = static_cast<float>(row.cy);
  return frame;
}

}  // namespace

DepthFrame depthFrame(const urban_nav_store::DepthView& view) {
  DepthFrame frame = withoutSamples(view);
  if (!(view.baseline > 0.0))
    throw urban_nav_core::DataError("depth_view", "the camera of a depth image has no baseline", "");
  frame.focal_baseline = static_cast<float>(view.fx * view.baseline);
  frame.samples = view.samples();
  return frame;
}

DepthFrame depthFrame(const urban_nav_store::DepthImage& image, std::uint8_t sensor, double sigma) {
  DepthFrame frame = withoutSamples(image);
  frame.sensor = sensor;
  frame.focal_baseline = static_cast<float>(urban_nav_store::DepthImage::kFocalBaseline);
  frame.floor = static_cast<float>(urban_nav_store::DepthImage::kFocalBaseline * sigma);
  urban_nav_store::DepthView view;
  view.packed = image.packed;
  frame.samples = view.samples();
  return frame;
}

}  // namespace laser_mapper
