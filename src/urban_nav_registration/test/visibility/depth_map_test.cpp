// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/visibility/depth_map.hpp"

#include <gtest/gtest.h>

namespace urban_nav_registration {
namespace {

using Eigen::Vector3d;

constexpr double kEdge = 0.05;  // m

/// A camera 1 m above the ground with a horizontal axis.
struct Lookout {
  urban_nav_core::Pinhole camera{300.0, 300.0, 200.0, 150.0, 400, 300};
  DepthMap map{camera};

  ImagePoint project(const Vector3d& p_cam) const {
    const auto pixel = camera.project(p_cam);
    return {pixel->x(), pixel->y(), p_cam.norm()};
  }
  void add(const Vector3d& p_cam) {
    if (const auto pixel = camera.project(p_cam); pixel && camera.contains(*pixel)) map.add(project(p_cam), kEdge);
  }
  void addGround() {
    for (double z = 2.0; z < 25.0; z += kEdge)
      for (double x = -3.0; x <= 3.0; x += kEdge) add({x, 1.0, z});
  }
  bool shows(const Vector3d& p_cam, const Vector3d& normal) const {
    return map.isVisible(project(p_cam), {p_cam, normal});
  }
};

TEST(DepthMap, GroundAtAGrazingAngleDoesNotOccludeItself) {
  Lookout lookout;
  lookout.addGround();
  for (double z = 4.0; z < 24.0; z += 1.0) EXPECT_TRUE(lookout.shows({0.3, 1.0, z}, {0.0, -1.0, 0.0})) << z;
  EXPECT_FALSE(lookout.shows({0.3, 1.0, 20.0}, Vector3d::Zero())) << "without a normal the ground before it hides it";
}

TEST(DepthMap, AWallOccludesFartherPointsAndNotItself) {
  Lookout lookout;
  for (double y = -1.0; y <= 1.0; y += kEdge)
    for (double x = -1.0; x <= 1.0; x += kEdge) lookout.add({x, y, 5.0});
  EXPECT_TRUE(lookout.shows({0.2, 0.1, 5.0}, {0.0, 0.0, -1.0}));
  EXPECT_FALSE(lookout.shows({0.2, 0.1, 8.0}, {0.0, 0.0, -1.0}));
  EXPECT_FALSE(lookout.shows({0.2, 0.1, 8.0}, Vector3d::Zero()));
  EXPECT_TRUE(lookout.shows({4.0, 0.1, 8.0}, {0.0, 0.0, -1.0})) << "beside the wall";
}

}  // namespace
}  // namespace urban_nav_registration
