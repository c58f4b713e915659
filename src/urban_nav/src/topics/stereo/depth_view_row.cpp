// SPDX-License-Identifier: BSD-3-Clause
#include "topics/stereo/depth_view_row.hpp"

#include <utility>

#include "dense_stereo/depth_samples.hpp"

namespace urban_nav {

using urban_nav_store::DepthView;

DepthView depthViewRow(const dense_stereo::DisparityImage& image, const urban_nav_core::ImageView& left,
                       const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_base_camera) {
  urban_nav_core::DepthSamples samples = dense_stereo::sampleDepths(image, left, camera);
  DepthView row;
  row.step = samples.step;
  row.fx = samples.fx;
  row.fy = samples.fy;
  row.cx = samples.cx;
  row.cy = samples.cy;
  row.baseline = samples.baseline;
  row.T_base_camera = T_base_camera;
  row.packed = DepthView::pack(
      {samples.width, samples.height, std::move(samples.disparity), std::move(samples.sigma), std::move(samples.grey)});
  return row;
}

}  // namespace urban_nav
