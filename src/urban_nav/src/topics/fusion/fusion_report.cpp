// SPDX-License-Identifier: BSD-3-Clause
#include "topics/fusion/fusion_report.hpp"

#include <cmath>

#include "map/odometry_summary.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav {

using urban_nav_core::formatNumber;
using urban_nav_core::SharedConstant;

namespace {

constexpr double kNotableSpread = 2.0;  // mean squared distance over its expectation
constexpr double kDegPerRad = 180.0 / M_PI;

/// Returns name, value, sigma and unit of a constant for the user.
std::vector<std::string> constantRow(const SharedConstant& constant) {
  const auto row = [&](const std::string& name, double unit, double offset, const std::string& unit_name) {
    return std::vector<std::string>{name, formatNumber(offset + unit * constant.value, 5),
                                    formatNumber(unit * constant.sigma, 2), unit_name};
  };
  if (constant.name == "scale") return row("ratio of true to stereo length", 1.0, 1.0, "");
  if (constant.name == "disparity") return row("disparity offset", 1.0, 0.0, "px");
  if (constant.name == "laser_scale") return row("ratio of true to laser length", 1.0, 1.0, "");
  if (constant.name.rfind("mounting_", 0) == 0)
    return row(std::string("rotation of the LiDAR about ") + constant.name.back() +
                   (constant.is_applied ? "" : " (not significant: kept)"),
               kDegPerRad, 0.0, "deg");
  return row(constant.name, 1.0, 0.0, "");
}

}  // namespace

std::string fusionSentence(const SessionOdometry& fused) {
  StepCounts counts;
  addSteps(fused, counts);
  std::string text = "odometry: " + std::to_string(counts.both) + " steps by stereo and laser, " +
                     std::to_string(counts.stereo) + " by stereo only, " + std::to_string(counts.laser) +
                     " by laser only, " + std::to_string(counts.none) + " predicted";
  if (const SharedConstant* scale = findConstant(*fused.fusion, "scale"))
    text += "; ratio of true to stereo length " + formatNumber(1.0 + scale->value, 5) + " +- " +
            formatNumber(scale->sigma, 2);
  return text;
}

Section fusionSection(const SessionOdometry& fused) {
  StepCounts counts;
  addSteps(fused, counts);
  Section section{"fusion",
                  "Stereo and laser together",
                  "The path is estimated from both odometries, each weighted by its covariance. Their common constants "
                  "are estimated from their differences.",
                  {},
                  {},
                  {}};
  PageTable constants{"Common constants",
                      {"constant", "value", "one standard deviation", "unit"},
                      {},
                      "The mounting of the LiDAR is relative to its transform in the recording."};
  for (const SharedConstant& constant : fused.fusion->shared) constants.rows.push_back(constantRow(constant));
  section.tables.push_back(constants);
  section.tables.push_back({"Steps",
                            {"measured by", "steps"},
                            {{"stereo and laser", std::to_string(counts.both)},
                             {"stereo only", std::to_string(counts.stereo)},
                             {"laser only", std::to_string(counts.laser)},
                             {"neither (predicted)", std::to_string(counts.none)}},
                            ""});
  return section;
}

std::vector<Verdict> fusionVerdicts(const SessionOdometry& fused) {
  const double spread = fused.fusion->spread;
  const std::string differences = "Their differences are " + formatNumber(std::sqrt(spread), 3) +
                                  " times their expected size on average" +
                                  (spread > 1.0 ? "; all standard deviations are scaled by this factor." : ".");
  if (!fused.fusion->conflicts.empty())
    return {{Grade::Bad, "Stereo and laser contradict each other in places.",
             std::to_string(fused.fusion->conflicts.size()) + " stretches of 1 s. " + differences}};
  if (spread > kNotableSpread)
    return {{Grade::Fair, "Stereo and laser differ by more than expected from their covariances.", differences}};
  return {{Grade::Good, "Stereo and laser agree on the path.", differences}};
}

}  // namespace urban_nav
