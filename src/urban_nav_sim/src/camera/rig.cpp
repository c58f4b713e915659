// SPDX-License-Identifier: BSD-3-Clause
#include "camera/rig.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace urban_nav_sim {
namespace {

using urban_nav_core::CameraInfo;
using urban_nav_core::Pose;

// Of the New College data set (Smith et al. 2009).
constexpr double kFocal = 389.956085, kCentreU = 254.903519, kCentreV = 201.899490, kBaseline = 0.120005;

CameraInfo toCameraInfo(const Lens& lens) {
  CameraInfo info;
  info.width = lens.width;
  info.height = lens.height;
  info.distortion_model = "plumb_bob";
  info.D.assign(lens.distortion.begin(), lens.distortion.end());
  info.K << lens.fx, 0.0, lens.cx, 0.0, lens.fy, lens.cy, 0.0, 0.0, 1.0;
  info.P.leftCols<3>() = info.K;
  return info;
}

Camera stereoCamera(const Lens& raw, const Eigen::Matrix3d& R_rectified_raw, double x, StereoImages images) {
  const Lens rectified{raw.width, raw.height, kFocal, kFocal, kCentreU, kCentreV, {}};
  const Eigen::Vector3d place(x, 0.0, 0.0);
  Camera camera;
  if (images == StereoImages::Rectified) {
    camera.lens = rectified;
    camera.T_head_camera = Pose(Eigen::Quaterniond::Identity(), place);
    camera.info = toCameraInfo(rectified);
  } else {
    camera.lens = raw;
    camera.T_head_camera = Pose(R_rectified_raw, place);
    camera.info = toCameraInfo(raw);
    camera.info.R = R_rectified_raw;
    camera.info.P.leftCols<3>() = toCameraInfo(rectified).K;
  }
  camera.info.P(0, 3) = -kFocal * x;
  return camera;
}

Eigen::Matrix3d turned(double x_deg, double y_deg, double z_deg) {
  const double rad = M_PI / 180.0;
  const Eigen::AngleAxisd x(x_deg * rad, Eigen::Vector3d::UnitX()), y(y_deg * rad, Eigen::Vector3d::UnitY());
  const Eigen::AngleAxisd z(z_deg * rad, Eigen::Vector3d::UnitZ());
  return (z * y * x).toRotationMatrix();
}

}  // namespace

std::array<Camera, 2> bumblebee(StereoImages images) {
  const Lens left{512, 384, 402.3, 401.6, 257.8, 195.2, {-0.318, 0.128, 0.0006, -0.0004, 0.0}};
  const Lens right{512, 384, 400.9, 400.4, 252.1, 203.7, {-0.312, 0.121, -0.0005, 0.0007, 0.0}};
  return {stereoCamera(left, turned(0.71, -0.34, 0.22), 0.0, images),
          stereoCamera(right, turned(-0.46, 0.27, -0.31), kBaseline, images)};
}

std::array<Camera, 5> ladybug() {
  constexpr double kRadius = 0.040;  // m: reference manual of the Ladybug2
  Eigen::Matrix3d R_forward_optical;
  R_forward_optical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  std::array<Camera, 5> cameras;
  for (int i = 0; i < 5; ++i) {
    const double focal = 240.0 * (1.0 + 0.004 * ((i * 3) % 5 - 2));  // the lenses of a head differ
    Camera& camera = cameras[static_cast<std::size_t>(i)];
    camera.lens = {384, 512, focal, focal, 191.5 + 1.7 * (i - 2), 255.5 - 1.1 * ((i * 2) % 5 - 2), {-0.12, 0.012}};
    const Eigen::Quaterniond yaw(Eigen::AngleAxisd(-2.0 * M_PI / 5.0 * i, Eigen::Vector3d::UnitZ()));
    camera.T_head_camera = Pose(Eigen::Matrix3d(yaw.toRotationMatrix() * R_forward_optical),
                                Eigen::Vector3d(yaw * Eigen::Vector3d(kRadius, 0.0, 0.0)));
    camera.info = toCameraInfo(camera.lens);
  }
  return cameras;
}

}  // namespace urban_nav_sim
