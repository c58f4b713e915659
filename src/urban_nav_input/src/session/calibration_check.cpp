// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/session/calibration_check.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_ros/baseline_check.hpp"

namespace urban_nav_input {

namespace {

using urban_nav_ros::kLongestBaseline;
using urban_nav_ros::kShortestBaseline;

constexpr double kUsualBaseline = 0.2;  // m
constexpr double kClear = 0.15;         // difference of logarithms below which two causes are about as likely
constexpr double kNarrowestView = 10.0, kWidestView = 150.0;  // deg, of a rectified image

std::string printedValue(double value) { return urban_nav_core::formatNumber(value, 4); }

/// A cause of an implausible baseline, and the scale that corrects it.
struct BaselineCause {
  const char* name;
  double scale;
  double distance;  ///< difference of the logarithms of the corrected and a usual baseline
};

/// Returns the causes that make the baseline plausible, the likeliest first.
std::vector<BaselineCause> likelyCauses(double baseline, double fx) {
  std::vector<BaselineCause> causes;
  for (const BaselineCause& each : {BaselineCause{"in centimetres", 0.01, 0.0},
                                    {"in millimetres", 0.001, 0.0},
                                    {"in inches", 0.0254, 0.0},
                                    {"in kilometres", 1000.0, 0.0},
                                    {"without the factor fx", fx, 0.0}}) {
    const double scaled = each.scale * baseline;
    if ((each.scale > 1.0) != (baseline < kShortestBaseline) || scaled < kShortestBaseline || scaled > kLongestBaseline)
      continue;
    causes.push_back({each.name, each.scale, std::abs(std::log(scaled / kUsualBaseline))});
  }
  std::stable_sort(causes.begin(), causes.end(),
                   [](const BaselineCause& a, const BaselineCause& b) { return a.distance < b.distance; });
  return causes;
}

void checkBaseline(const urban_nav_core::StereoCamera& camera, double present_scale, std::vector<Finding>& findings) {
  const double baseline = camera.baseline;
  if (urban_nav_ros::describeBaseline(baseline).empty()) return;
  const std::vector<BaselineCause> causes = likelyCauses(baseline, camera.left.fx);
  Finding finding{FindingKind::Calibration, "the baseline is " + printedValue(baseline) + " m",
                  "P[3] of the right camera_info is -fx times the baseline in metres; maps have the scale of this "
                  "number"};
  for (const BaselineCause& cause : causes)
    finding.text += (&cause == &causes.front() ? "; " : ", ") + std::string("if it is stated ") + cause.name +
                    ", it is " + printedValue(cause.scale * baseline) + " m";
  const bool is_clear = !causes.empty() && (causes.size() == 1 || causes[1].distance - causes[0].distance > kClear);
  if (is_clear) {
    finding.options = {"--set", "input.baseline_scale=" + urban_nav_core::printNumber(causes[0].scale * present_scale)};
    finding.remedy = finding.options[0] + " " + finding.options[1] + " accepts it as stated " + causes[0].name +
                     "; for later recordings: " + finding.remedy;
  } else if (!causes.empty()) {
    finding.remedy =
        "--set input.baseline_scale=SCALE with the scale of its unit; for later recordings: " + finding.remedy;
  }
  findings.push_back(std::move(finding));
}

void checkView(const urban_nav_core::Pinhole& camera, std::vector<Finding>& findings) {
  const double degrees = 360.0 / M_PI * std::atan(0.5 * camera.width / camera.fx);
  if (degrees < kNarrowestView || degrees > kWidestView)
    findings.push_back({FindingKind::Calibration,
                        "a focal length of " + printedValue(camera.fx) + " px for " + std::to_string(camera.width) +
                            " columns gives a field of view of " + printedValue(degrees) + " deg",
                        "use the focal length in pixels of the recorded images"});
}

void checkPrincipalPoint(const urban_nav_core::Pinhole& camera, std::vector<Finding>& findings) {
  const double across = camera.cx / camera.width, down = camera.cy / camera.height;
  const auto away = [](double share) { return std::abs(share - 0.5) > 0.3; };
  if (!away(across) && !away(down)) return;
  const double factor = 0.5 * (across + down) / 0.5;
  std::string scale;
  if (std::abs(across - down) < 0.1 && (factor > 1.5 || factor < 0.67))
    scale = "; the calibration seems to be for images " + printedValue(factor) + " times as large";
  findings.push_back({FindingKind::Calibration,
                      "the principal point (" + printedValue(camera.cx) + ", " + printedValue(camera.cy) +
                          ") px is far from the centre of " + std::to_string(camera.width) + "x" +
                          std::to_string(camera.height) + " px" + scale,
                      "scale the calibration to the size of the images (camera_info: K, P, width and height)"});
}

}  // namespace

std::vector<Finding> checkCalibration(const urban_nav_core::StereoCamera& camera, double baseline_scale) {
  std::vector<Finding> findings;
  checkBaseline(camera, baseline_scale, findings);
  checkView(camera.left, findings);
  checkPrincipalPoint(camera.left, findings);
  if (std::abs(camera.left.fx / camera.left.fy - 1.0) > 0.2)
    findings.push_back({FindingKind::Calibration,
                        "fx is " + printedValue(camera.left.fx) + " px and fy " + printedValue(camera.left.fy) + " px",
                        "check K and P: pixels are expected to be square"});
  return findings;
}

}  // namespace urban_nav_input
