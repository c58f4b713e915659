// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/camera/camera_info.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

// Tolerance for rows, focal lengths and centres of a rectified pair; calibration programs print about five digits.
constexpr double kSamePixel = 0.01;  // px
constexpr int kLargestSide = 32767;  // px

std::string print(const std::string& name, double value) {
  std::ostringstream text;
  text << name << " = " << value;
  return text.str();
}

template <typename Matrix>
Pinhole pinhole(const CameraInfo& info, const Matrix& M, const std::string& name, const std::string& where) {
  if (info.width <= 0 || info.height <= 0 || info.width > kLargestSide || info.height > kLargestSide) {
    throw UserError(where, "image size " + std::to_string(info.width) + "x" + std::to_string(info.height),
                    "1...32767 px");
  }
  if (!M.allFinite() || !(M(0, 0) > 0.0) || !(M(1, 1) > 0.0)) {
    throw UserError(where, print(name + "[0]", M(0, 0)) + ", " + print("focal length in v", M(1, 1)),
                    "focal lengths above zero (px)");
  }
  return {M(0, 0), M(1, 1), M(0, 2), M(1, 2), info.width, info.height};
}

void requireSame(const char* name, double left, double right, const std::string& where) {
  if (std::abs(left - right) <= kSamePixel) return;
  throw UserError(where, print(std::string(name) + " of the left camera", left) + ", " + print("of the right", right),
                  "a rectified pair, equal to " + std::to_string(kSamePixel) + " px");
}

CameraInfo makeInfo(const StereoCamera& camera, double baseline) {
  const Pinhole& pinhole = camera.left;
  CameraInfo info;
  info.width = pinhole.width;
  info.height = pinhole.height;
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K << pinhole.fx, 0.0, pinhole.cx, 0.0, pinhole.fy, pinhole.cy, 0.0, 0.0, 1.0;
  info.P.leftCols<3>() = info.K;
  info.P(0, 3) = -pinhole.fx * baseline;
  return info;
}

}  // namespace

CameraInfo withRawCamera(CameraInfo info) {
  if (!info.K.isZero(0.0) || info.P.leftCols<3>().isZero(0.0)) return info;
  info.K = info.P.leftCols<3>();
  info.R.setIdentity();
  info.D.clear();
  info.distortion_model.clear();
  return info;
}

RawCamera rawCamera(const CameraInfo& info, const std::string& where) {
  return {pinhole(info, info.K, "K", where), Distortion::named(info.distortion_model, info.D, where)};
}

Pinhole rectifiedPinhole(const CameraInfo& info, const std::string& where) { return pinhole(info, info.P, "P", where); }

bool needsRectification(const CameraInfo& info) {
  const bool distorted = std::any_of(info.D.begin(), info.D.end(), [](double k) { return k != 0.0; });
  const bool turned = !info.R.isIdentity(1e-9) && !info.R.isZero(0.0);  // all zeros: "not set"
  return distorted || turned || !info.K.isApprox(info.P.leftCols<3>(), 1e-9);
}

StereoCamera stereoCamera(const CameraInfo& left, const CameraInfo& right, const std::string& where) {
  const Pinhole a = rectifiedPinhole(left, where + " (left)"), b = rectifiedPinhole(right, where + " (right)");
  if (a.width != b.width || a.height != b.height) {
    throw UserError(where,
                    "left image " + std::to_string(a.width) + "x" + std::to_string(a.height) + ", right image " +
                        std::to_string(b.width) + "x" + std::to_string(b.height),
                    "equal sizes");
  }
  requireSame("fx", a.fx, b.fx, where);
  requireSame("fy", a.fy, b.fy, where);
  requireSame("cx", a.cx, b.cx, where);
  requireSame("cy", a.cy, b.cy, where);
  const double baseline = (left.P(0, 3) / a.fx) - (right.P(0, 3) / b.fx);
  if (!(baseline > 0.0)) {
    throw UserError(where, print("baseline", baseline) + " m from P[3] of left and right",
                    "above zero: P[3] of the right camera is -fx * baseline (are left and right swapped?)");
  }
  return {a, baseline};
}

CameraInfo leftInfo(const StereoCamera& camera) { return makeInfo(camera, 0.0); }
CameraInfo rightInfo(const StereoCamera& camera) { return makeInfo(camera, camera.baseline); }

}  // namespace urban_nav_core
