// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/sensors/place_finding.hpp"

#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav_input {

using urban_nav_core::formatNumber;
using urban_nav_core::printNumber;

namespace {

constexpr double kLongestRobot = 20.0;  // m
constexpr double kMillimetres = 300.0;  // above it, the position in centimetres would be beyond 3 m
constexpr double kCentimetres = 40.0;   // below it, the position in millimetres would be within 4 cm

std::string printTransform(const std::string& frame, const urban_nav_core::Pose& T_base_sensor, double scale) {
  const urban_nav_core::Vector3d t = scale * T_base_sensor.t();
  const urban_nav_core::Quaterniond& q = T_base_sensor.q();
  std::string text = "base_link," + frame + ":";
  for (const double number : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z()}) text += printNumber(number) + ",";
  return text + printNumber(q.w());
}

}  // namespace

std::vector<std::string> placeOptions(const std::string& frame, const urban_nav_core::Pose& T_base_sensor) {
  return {"--transform", printTransform(frame, T_base_sensor, 1.0)};
}

std::vector<Finding> placeFindings(const std::string& frame, const urban_nav_core::Pose& T_base_sensor) {
  const double away = T_base_sensor.t().norm();
  if (away <= kLongestRobot) return {};
  Finding finding{FindingKind::Tf,
                  "\"" + frame + "\" is " + formatNumber(away, 4) + " m from base_link by tf: in millimetres it is " +
                      formatNumber(0.001 * away, 3) + " m, in centimetres " + formatNumber(0.01 * away, 3) + " m",
                  "use metres in the robot description"};
  if (away > kCentimetres && away < kMillimetres) {
    finding.remedy = "--transform base_link," + frame + ":X,Y,Z,QX,QY,QZ,QW sets it in metres; for later recordings " +
                     finding.remedy;
    return {finding};
  }
  finding.options = {"--transform", printTransform(frame, T_base_sensor, away >= kMillimetres ? 0.001 : 0.01)};
  finding.remedy = finding.options[0] + " " + finding.options[1] + "; for later recordings " + finding.remedy;
  return {finding};
}

}  // namespace urban_nav_input
