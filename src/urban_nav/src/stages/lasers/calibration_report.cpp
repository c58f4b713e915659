// SPDX-License-Identifier: BSD-3-Clause
#include "stages/lasers/calibration_report.hpp"

#include <cmath>
#include <map>
#include <string>

#include "report/plot.hpp"

namespace urban_nav {

using laser_mapper::CalibrationEstimate;
using laser_mapper::CalibrationResult;
using laser_mapper::LaserCalibration;

namespace {

/// How a term is called and scaled for people, in the order of CalibrationTerm.
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

std::string toText(const TermText& term, double value) { return forPerson(term.scale * value, 3) + " " + term.unit; }

std::string withSigma(const TermText& term, const CalibrationEstimate& estimate) {
  return forPerson(term.scale * estimate.value, 3) + " +- " + forPerson(term.scale * estimate.sigma, 2) + " " +
         term.unit;
}

std::string verdictOf(const CalibrationResult& found) {
  const std::string spread = "the passes lie " + forPerson(1e3 * found.stated_spread, 2) + " mm apart as stated and " +
                             forPerson(1e3 * found.calibrated_spread, 2) + " mm with the estimate, in " +
                             std::to_string(found.held_out) + " places left out of it";
  if (found.places == 0) return "nothing is found: no plane was measured twice";
  if (!found.is_significant) return "the stated calibration is kept: nothing differs from it beyond chance";
  if (!found.improves) return "the stated calibration is kept: " + spread;
  return "adopted: " + spread;
}

std::string listOf(const std::vector<std::string>& sentences) {
  std::string all;
  for (const std::string& sentence : sentences) all += (all.empty() ? "" : "; ") + sentence;
  return all;
}

std::string panoramaSentence(const laser_mapper::ViewDelay& found) {
  if (!found.delay.constrained) return "the session does not say whether its stamps are late";
  return "delay of its stamps " + withSigma(kTerms[0], found.delay) +
         (found.delay.adopted != 0.0 ? ", adopted" : ", the stamps are kept");
}

/// Mean over the sessions that constrain the delay of a device, by their information.
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

}  // namespace

std::vector<std::string> calibrationSentences(const LasersRun& run) {
  std::vector<std::string> sentences;
  for (const SessionCalibration& session : run.calibrations) {
    const CalibrationResult& found = session.found;
    sentences.push_back("calibration of " + session.session + ": " + verdictOf(found));
    for (const LaserCalibration& laser : found.lasers) {
      std::string adopted;
      for (std::size_t i = 0; i < laser.terms.size(); ++i)
        if (laser.terms[i].adopted != 0.0)
          adopted +=
              (adopted.empty() ? "" : ", ") + std::string(kTerms[i].name) + " " + withSigma(kTerms[i], laser.terms[i]);
      if (!adopted.empty()) sentences.push_back("  " + laser.frame + ": " + adopted);
    }
    if (session.panorama) sentences.push_back("  panorama: " + panoramaSentence(*session.panorama));
    if (!found.unconstrained.empty()) sentences.push_back("  the session does not say: " + listOf(found.unconstrained));
  }
  return sentences;
}

std::vector<PageTable> calibrationTables(const LasersRun& run) {
  std::vector<PageTable> tables;
  for (const SessionCalibration& session : run.calibrations) {
    const CalibrationResult& found = session.found;
    PageTable table;
    table.title = "Calibration of the lasers, " + session.session;
    table.head = {"", "found", "in the map"};
    for (const LaserCalibration& laser : found.lasers)
      for (std::size_t i = 0; i < laser.terms.size(); ++i) {
        const CalibrationEstimate& term = laser.terms[i];
        table.rows.push_back({laser.frame + ", " + kTerms[i].name,
                              term.constrained ? withSigma(kTerms[i], term) : "not observable",
                              term.adopted == 0.0 ? "as stated" : toText(kTerms[i], term.adopted)});
      }
    if (session.panorama)
      table.rows.push_back(
          {"panorama, delay of its stamps",
           session.panorama->delay.constrained ? withSigma(kTerms[0], session.panorama->delay) : "not observable",
           session.panorama->delay.adopted == 0.0 ? "as stated" : toText(kTerms[0], session.panorama->delay.adopted)});
    table.caption =
        "Difference from the extrinsics and stamps of the recording, in the axes of each laser's frame, by "
        "the sharpness of " +
        std::to_string(found.places) + " places that were measured more than once. Verdict: " + verdictOf(found) + "." +
        (found.unconstrained.empty() ? "" : " The session does not say: " + listOf(found.unconstrained) + ".");
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
    for (const LaserCalibration& laser : found.lasers) {
      Json& terms = lasers[laser.frame] = Json::object();
      for (std::size_t i = 0; i < laser.terms.size(); ++i) terms[kTerms[i].key] = termJson(kTerms[i], laser.terms[i]);
    }
    if (session.panorama) lasers["panorama"][kTerms[0].key] = termJson(kTerms[0], session.panorama->delay);
    Json& unobservable = json["not_observable"] = Json::array();
    for (const std::string& sentence : found.unconstrained) unobservable.append(sentence);
    sessions.append(json);
  }
  return sessions;
}

Json delaysJson(const LasersRun& run) {
  std::map<std::string, DelayMean> delays;
  for (const SessionCalibration& session : run.calibrations) {
    for (const LaserCalibration& laser : session.found.lasers)
      delays[laser.frame].add(laser.at(laser_mapper::CalibrationTerm::Delay));
    if (session.panorama) delays["panorama"].add(session.panorama->delay);
  }
  Json json = Json::object();
  for (const auto& [device, delay] : delays) json[device] = delay.toJson();
  return json;
}

}  // namespace urban_nav
