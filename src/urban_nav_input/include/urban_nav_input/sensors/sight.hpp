// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_input {

/// Motion of base_link between two stamps, measured by a stereo camera.
struct SeenMotion {
  urban_nav_core::StampNs from = 0, to = 0;
  urban_nav_core::Pose T_from_to;
};

/// Ground plane measured from a stereo pair.
struct SeenGround {
  urban_nav_core::Vector3d up = urban_nav_core::Vector3d::UnitZ();  ///< unit normal in the axes of base_link, upwards
  double drop = 0.0;  ///< m from the camera to the plane, along the normal
};

/// Motion and ground measured from some stereo pairs of a recording, as a reference for other sensors.
struct Sight {
  std::vector<SeenMotion> motions;
  std::vector<SeenGround> grounds;
  urban_nav_core::Vector3d camera = urban_nav_core::Vector3d::Zero();  ///< position of the camera in base_link, m
};

}  // namespace urban_nav_input
