// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/calibration_report.hpp"

#include <cmath>
#include <map>
#include <string>

#include "base/plot.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav {

using laser_mapper::CalibrationEstimate;
using laser_mapper::CalibrationResult;
using laser_mapper::DeviceCalibration;
using laser_mapper::ViewCalibration;

namespace {

/// Name and scale of a term for output, in the order of CalibrationTerm.
struct TermText {
  const char* name;
  const char* key;
  const char* unit;
  double scale;
};
constexpr double kCalibrationDegrees = 180.0 / M_PI;
constexpr TermText kTerms[] = {{"delay of its stamps", "delay_ms", "ms", 1e3},
                               {"shift along x", "shift_x_mm", "mm", 1e3},
                               {"shift along y", "shift_y_mm", "mm", 1e3},
                               {"shift along z", "shift_z_mm", "mm", 1e3},
                               {"turn about x", "turn_x_deg", "deg", kCalibrationDegrees},
                               {"turn about y", "turn_y_deg", "deg", kCalibrationDegrees},
                               {"turn about z", "turn_z_deg", "deg", kCalibrationDegrees}};

std::string toText(const TermText& term, double value) {
  return urban_nav_core::formatNumber(term.scale * value, 3) + " " + term.unit;
}

std::string withSigma(const TermText& term, const CalibrationEstimate& estimate) {
  return urban_nav_core::formatNumber(term.scale * estimate.value, 3) + " +- " +
         urban_nav_core::formatNumber(term.scale * estimate.sigma, 2) + " " + term.unit;
}

/// Returns the verdict on a calibration. `nothing`: reason if there are no places. `spread`: supporting figures.
std::string verdictOf(std::size_t places, bool is_significant, bool improves, const std::string& nothing,
                      const std::string& spread) {
  if (places == 0) return "not estimated: " + nothing;
  if (!is_significant) return "the stated calibration is kept: no significant difference";
  return (improves ? "adopted: " : "the stated calibration is kept: ") + spread;
}

std::string verdictOf(const CalibrationResult& found) {
  return verdictOf(found.places, found.is_significant, found.improves, "no plane was measured twice",
                   "the distance of the passes is " + urban_nav_core::formatNumber(1e3 * found.stated_spread, 2) +
                       " mm as stated and " + urban_nav_core::formatNumber(1e3 * found.calibrated_spread, 2) +
                       " mm with the estimate, in " + std::to_string(found.held_out) + " held-out places");
}

std::string verdictOf(const ViewCalibration& found) {
  return verdictOf(found.places, found.is_significant, found.improves, "no point of the map is seen by several views",
                   "the views of a point differ by " + urban_nav_core::formatNumber(100.0 * found.stated_spread, 3) +
                       " % as stated and " + urban_nav_core::formatNumber(100.0 * found.calibrated_spread, 3) +
                       " % with the estimate, in " + std::to_string(found.held_out) + " held-out places");
}

std::string listOf(const std::vector<std::string>& sentences) {
  std::string all;
  for (const std::string& sentence : sentences) all += (all.empty() ? "" : "; ") + sentence;
  return all;
}

/// Returns the adopted terms of a device; empty without.
std::string adoptedTerms(const DeviceCalibration& device) {
  std::string adopted;
  for (std::size_t i = 0; i < device.terms.size(); ++i)
    if (device.terms[i].adopted != 0.0)
      adopted +=
          (adopted.empty() ? "" : ", ") + std::string(kTerms[i].name) + " " + withSigma(kTerms[i], device.terms[i]);
  return adopted;
}

void addDevice(const DeviceCalibration& device, PageTable& table) {
  for (std::size_t i = 0; i < device.terms.size(); ++i) {
    const CalibrationEstimate& term = device.terms[i];
    table.rows.push_back({device.frame + ", " + kTerms[i].name,
                          term.constrained ? withSigma(kTerms[i], term) : "not observable",
                          term.adopted == 0.0 ? "as stated" : toText(kTerms[i], term.adopted)});
  }
}

/// Returns the unobservable directions of the lasers and the panoramas of a session.
std::vector<std::string> unconstrainedOf(const SessionCalibration& session) {
  std::vector<std::string> all = session.found.unconstrained;
  if (session.panorama)
    all.insert(all.end(), session.panorama->unconstrained.begin(), session.panorama->unconstrained.end());
  return all;
}

/// Mean delay of a device over the sessions that constrain it, weighted by information.
class DelayMean {
 public:
  void add(const CalibrationEstimate& delay) {
    if (!delay.constrained || !(delay.sigma > 0.0)) return;
    const double weight = 1.0 / (delay.sigma * delay.sigma);
    weights_ += weight;
    sum_ += weight * delay.value;
  }
  /// Returns the mean, ms; null: no session constrains it.
  Json toJson() const { return weights_ > 0.0 ? Json(1e3 * sum_ / weights_) : Json(); }

 private:
  double weights_ = 0.0, sum_ = 0.0;
};

Json termJson(const TermText& text, const CalibrationEstimate& term) {
  Json row = Json::object();
  row["found"] = text.scale * term.value;
  row["sigma"] = text.scale * term.sigma;
  row["observable"] = term.constrained;
  row["adopted"] = text.scale * term.adopted;
  return row;
}

Json deviceJson(const DeviceCalibration& device) {
  Json terms = Json::object();
  for (std::size_t i = 0; i < device.terms.size(); ++i) terms[kTerms[i].key] = termJson(kTerms[i], device.terms[i]);
  return terms;
}

}  // namespace

std::vector<std::string> calibrationSentences(const LasersRun& run) {
  std::vector<std::string> sentences;
  for (const SessionCalibration& session : run.calibrations) {
    const CalibrationResult& found = session.found;
    sentences.push_back("calibration of " + session.session + ": " + verdictOf(found));
    for (const DeviceCalibration& laser : found.lasers) {
      const std::string adopted = adoptedTerms(laser);
      if (!adopted.empty()) sentences.push_back("  " + laser.frame + ": " + adopted);
    }
    if (session.panorama) {
      const std::string adopted = adoptedTerms(session.panorama->head);
      sentences.push_back("  panorama: " + (adopted.empty() ? "" : adopted + "; ") + verdictOf(*session.panorama));
    }
    const std::vector<std::string> unconstrained = unconstrainedOf(session);
    if (!unconstrained.empty()) sentences.push_back("  not observable in this session: " + listOf(unconstrained));
  }
  return sentences;
}

std::vector<PageTable> calibrationTables(const LasersRun& run) {
  std::vector<PageTable> tables;
  for (const SessionCalibration& session : run.calibrations) {
    const CalibrationResult& found = session.found;
    PageTable table;
    table.title = "Calibration of lasers and panoramas, " + session.session;
    table.head = {"", "found", "in the map"};
    for (const DeviceCalibration& laser : found.lasers) addDevice(laser, table);
    if (session.panorama) addDevice(session.panorama->head, table);
    const std::vector<std::string> unconstrained = unconstrainedOf(session);
    table.caption =
        "Difference from the extrinsics and stamps of the recording: of each laser in the axes of its frame, by the "
        "sharpness of " +
        std::to_string(found.places) + " places that were measured more than once (" + verdictOf(found) + ")" +
        (session.panorama ? "; of the panoramic head in the axes of the robot, by the colours of " +
                                std::to_string(session.panorama->places) + " places in several views (" +
                                verdictOf(*session.panorama) + ")"
                          : "") +
        "." + (unconstrained.empty() ? "" : " Not observable in this session: " + listOf(unconstrained) + ".");
    tables.push_back(table);
  }
  return tables;
}

Json calibrationJson(const LasersRun& run) {
  Json sessions = Json::array();
  for (const SessionCalibration& session : run.calibrations) {
    const CalibrationResult& found = session.found;
    Json json = Json::object();
    json["session"] = session.session;
    json["adopted"] = found.isAdopted();
    json["verdict"] = verdictOf(found);
    json["places"] = found.places;
    json["held_out"] = found.held_out;
    json["spread_stated_m"] = found.stated_spread;
    json["spread_calibrated_m"] = found.calibrated_spread;
    json["improvement_m"] = found.improvement;
    json["improvement_sigma_m"] = found.improvement_sigma;
    Json& lasers = json["devices"] = Json::object();
    for (const DeviceCalibration& laser : found.lasers) lasers[laser.frame] = deviceJson(laser);
    if (session.panorama) {
      lasers[session.panorama->head.frame] = deviceJson(session.panorama->head);
      json["panorama_adopted"] = session.panorama->isAdopted();
      json["panorama_verdict"] = verdictOf(*session.panorama);
    }
    Json& unobservable = json["not_observable"] = Json::array();
    for (const std::string& sentence : unconstrainedOf(session)) unobservable.append(sentence);
    sessions.append(json);
  }
  return sessions;
}

Json delaysJson(const LasersRun& run) {
  std::map<std::string, DelayMean> delays;
  for (const SessionCalibration& session : run.calibrations) {
    for (const DeviceCalibration& laser : session.found.lasers)
      delays[laser.frame].add(laser.at(laser_mapper::CalibrationTerm::Delay));
    if (session.panorama)
      delays[session.panorama->head.frame].add(session.panorama->head.at(laser_mapper::CalibrationTerm::Delay));
  }
  Json json = Json::object();
  for (const auto& [device, delay] : delays) json[device] = delay.toJson();
  return json;
}

}  // namespace urban_nav
