// SPDX-License-Identifier: BSD-3-Clause
#include "topics/graph/relax_report.hpp"

#include <cmath>

#include "base/plot.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav {

namespace {

std::string toText(const char* when, const GraphCosts& costs) {
  return std::string(when) + "geodesic " + urban_nav_core::formatNumber(costs.geodesic, 9) + ", chordal " +
         urban_nav_core::formatNumber(costs.chordal, 9) + ", g2o " + urban_nav_core::formatNumber(costs.g2o, 9) + "\n";
}

Json toJson(const GraphCosts& costs) {
  Json json = Json::object();
  json["geodesic"] = costs.geodesic;
  json["chordal"] = costs.chordal;
  json["g2o"] = costs.g2o;
  return json;
}

Json toJson(const pose_graph::DeviationScales& scales) {
  const auto one = [](const std::optional<double>& scale) { return scale ? Json(*scale) : Json("unknown"); };
  return Json::object(
      {{"odometry",
        Json::object({{"translation", one(scales.odometry_translation)}, {"rotation", one(scales.odometry_rotation)}})},
       {"closures",
        Json::object({{"translation", one(scales.closure_translation)}, {"rotation", one(scales.closure_rotation)}})}});
}

}  // namespace

std::string toText(const RelaxReport& report) {
  std::string text = std::to_string(report.poses) + " poses, " + std::to_string(report.edges) + " edges, " +
                     std::to_string(report.rejected) + " rejected; " + std::to_string(report.iterations) +
                     " iterations, " + report.ending + ", " + urban_nav_core::formatNumber(report.ms, 3) + " ms\n";
  if (report.landmarks > 0)
    text +=
        std::to_string(report.landmarks) + " landmarks, measured " + std::to_string(report.landmark_edges) + " times\n";
  if (report.priors > 0) text += std::to_string(report.priors) + " priors\n";
  if (report.variance)
    text += "errors: " + urban_nav_core::formatNumber(std::sqrt(*report.variance), 2) +
            " times the standard deviations of the information\n";
  text += toText("before: ", report.before) + toText("after:  ", report.after);
  if (!report.certificate) return text;
  const pose_graph::Certificate& certificate = *report.certificate;
  text += certificate.certified ? "certified: the global optimum" : "not certified: there may be a better optimum";
  if (certificate.gap)
    text += "; the cost " + urban_nav_core::formatNumber(certificate.cost, 9) + " exceeds the optimum by at most " +
            urban_nav_core::formatNumber(*certificate.gap, 2);
  return text + "\n";
}

Json toJson(const RelaxReport& report) {
  Json json = Json::object();
  json["poses"] = report.poses;
  json["edges"] = report.edges;
  json["edges_rejected"] = report.rejected;
  if (report.landmarks > 0) {
    json["landmarks"] = report.landmarks;
    json["landmark_edges"] = report.landmark_edges;
  }
  if (report.priors > 0) json["priors"] = report.priors;
  json["components"] = report.components;
  json["iterations"] = report.iterations;
  if (report.variance) json["variance_factor"] = *report.variance;
  json["ending"] = report.ending;
  if (report.gradient) json["gradient"] = *report.gradient;
  json["ms_batch"] = report.ms;
  json["cost_before"] = toJson(report.before);
  json["cost_after"] = toJson(report.after);
  if (report.certificate) {
    json["certified"] = report.certificate->certified;
    if (report.certificate->gap) json["certified_gap"] = *report.certificate->gap;
  }
  if (report.scales) json["scales"] = toJson(*report.scales);
  json["warnings"] = Json::array();
  for (const std::string& warning : report.warnings) json["warnings"].append(warning);
  return json;
}

}  // namespace urban_nav
