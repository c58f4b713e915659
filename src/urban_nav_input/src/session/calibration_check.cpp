// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/session/calibration_check.hpp"

#include <cmath>

#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav_input {

namespace {

constexpr double kShortestBaseline = 0.01, kLongestBaseline = 3.0;  // m, of cameras on one vehicle
constexpr double kNarrowestView = 10.0, kWidestView = 150.0;        // deg, of a rectified image

std::string printedValue(double value) { return urban_nav_core::formatNumber(value, 4); }

void checkBaseline(double baseline, std::vector<CalibrationFault>& findings) {
  if (baseline >= kShortestBaseline && baseline <= kLongestBaseline) return;
  // From millimetres or centimetres if that makes it plausible.
  std::string unit;
  if (baseline > kLongestBaseline)
    unit = 0.001 * baseline >= kShortestBaseline && 0.001 * baseline <= kLongestBaseline
               ? "; in millimetres it would be " + printedValue(0.001 * baseline) + " m (a factor of 1000)"
               : "";
  findings.push_back({"the baseline is " + printedValue(baseline) + " m" + unit,
                      "P[3] of the right camera_info is -fx times the baseline in metres; maps have the scale of this "
                      "number"});
}

void checkView(const urban_nav_core::Pinhole& camera, std::vector<CalibrationFault>& findings) {
  const double degrees = 360.0 / M_PI * std::atan(0.5 * camera.width / camera.fx);
  if (degrees < kNarrowestView || degrees > kWidestView)
    findings.push_back({"a focal length of " + printedValue(camera.fx) + " px for " + std::to_string(camera.width) +
                            " columns is a field of view of " + printedValue(degrees) + " deg",
                        "state the focal length in pixels of the images as they were recorded"});
}

void checkPrincipalPoint(const urban_nav_core::Pinhole& camera, std::vector<CalibrationFault>& findings) {
  const double across = camera.cx / camera.width, down = camera.cy / camera.height;
  const auto away = [](double share) { return std::abs(share - 0.5) > 0.3; };
  if (!away(across) && !away(down)) return;
  const double factor = 0.5 * (across + down) / 0.5;
  std::string scale;
  if (std::abs(across - down) < 0.1 && (factor > 1.5 || factor < 0.67))
    scale = "; the calibration seems to be of images " + printedValue(factor) + " times as large";
  findings.push_back({"the principal point (" + printedValue(camera.cx) + ", " + printedValue(camera.cy) +
                          ") px is far from the middle of " + std::to_string(camera.width) + "x" +
                          std::to_string(camera.height) + " px" + scale,
                      "scale the calibration to the size of the images (camera_info: K, P, width and height)"});
}

}  // namespace

std::vector<CalibrationFault> checkCalibration(const urban_nav_core::StereoCamera& camera) {
  std::vector<CalibrationFault> findings;
  checkBaseline(camera.baseline, findings);
  checkView(camera.left, findings);
  checkPrincipalPoint(camera.left, findings);
  if (std::abs(camera.left.fx / camera.left.fy - 1.0) > 0.2)
    findings.push_back({"fx is " + printedValue(camera.left.fx) + " px and fy " + printedValue(camera.left.fy) + " px",
                        "check K and P: pixels of today's cameras are square"});
  return findings;
}

}  // namespace urban_nav_input
