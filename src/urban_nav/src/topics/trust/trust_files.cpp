// SPDX-License-Identifier: BSD-3-Clause
#include "topics/trust/trust_files.hpp"

#include <algorithm>

#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav {

using urban_nav_trust::ConsistencyTest;

namespace {

/// Names of the stated probabilities, in the order of urban_nav_trust::kRadii.
constexpr const char* kProbabilityNames[] = {"p_0.1m", "p_0.5m", "p_2m"};

Json toJson(const ConsistencyTest& test, bool has_failed) {
  return Json::object({{"name", test.name},
                       {"verdict", has_failed ? "failed" : "passed"},
                       {"from_ns", test.interval.from},
                       {"to_ns", test.interval.to},
                       {"statistic", test.statistic},
                       {"degrees_of_freedom", test.degrees_of_freedom},
                       {"p_value", test.p_value},
                       {"sentence", test.sentence},
                       {"remedy", test.remedy},
                       {"corrected", has_failed && test.is_corrected}});
}

}  // namespace

std::string trustCsv(const TrustRun& run) {
  std::string text = "stamp_ns,state";
  for (const char* name : kProbabilityNames) text += std::string(",") + name;
  text += ",tests\n";
  for (const urban_nav_trust::FrameTrust& frame : run.frames) {
    text += std::to_string(frame.stamp) + "," + toString(frame.state);
    for (const double probability : frame.probabilities) {
      text += ',';
      urban_nav_core::appendNumber(text, probability);
    }
    text += "," + frame.tests + "\n";
  }
  return text;
}

Json toJson(const TrustRun& run, const urban_nav_trust::Parameters& parameters) {
  Json json = Json::object();
  json["state"] = toString(run.map.state);
  for (std::size_t k = 0; k < urban_nav_trust::kRadii.size(); ++k)
    json[kProbabilityNames[k]] = run.map.probabilities[k];
  json["reason"] = run.map.reason;
  Json& tests = json["tests"] = Json::array();
  for (const ConsistencyTest& test : run.results.tests) tests.append(toJson(test, hasFailed(test, parameters)));
  Json& absent = json["absent"] = Json::array();
  for (const urban_nav_trust::AbsentMeasurement& missing : run.results.absent)
    absent.append(Json::object({{"name", missing.name}, {"reason", missing.reason}}));
  Json& segments = json["segments"] = Json::array();
  for (const urban_nav_trust::ConstantSegment& segment : run.results.segments)
    segments.append(Json::object({{"constant", segment.constant},
                                  {"from_ns", segment.interval.from},
                                  {"value", segment.value},
                                  {"sigma", segment.sigma}}));
  Json& warnings = json["warnings"] = Json::array();
  for (const ConsistencyTest& test : run.results.tests)
    if (hasFailed(test, parameters)) warnings.append(test.name + ": " + test.sentence + " " + test.remedy);
  return json;
}

std::vector<std::string> failedTests(const TrustRun& run, const urban_nav_trust::Parameters& parameters) {
  std::vector<std::string> names;
  for (const ConsistencyTest& test : run.results.tests)
    if (hasFailed(test, parameters) && std::find(names.begin(), names.end(), test.name) == names.end())
      names.push_back(test.name);
  return names;
}

}  // namespace urban_nav
