// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/calibration_report.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace urban_nav {
namespace {

using laser_mapper::CalibrationTerm;
using laser_mapper::DeviceCalibration;

/// A session whose left laser is 30 ms late, and that does not determine the delay of the right one.
LasersRun runWithCalibration(bool improves) {
  DeviceCalibration left, right;
  left.frame = "laser_left";
  right.frame = "laser_right";
  left.terms[0] = {0.03, 0.0004, true, improves ? 0.03 : 0.0};
  SessionCalibration session;
  session.session = "quad";
  session.found.lasers = {left, right};
  session.found.unconstrained = {"delay of laser_right"};
  session.panorama.emplace();
  session.panorama->head.frame = "panorama";
  session.panorama->head.terms[0] = {0.02, 0.001, true, improves ? 0.02 : 0.0};
  session.panorama->unconstrained = {"shift of panorama along its x axis (forward)"};
  session.panorama->places = 500;
  session.panorama->is_significant = true;
  session.panorama->improves = improves;
  session.found.places = 1000;
  session.found.held_out = 200;
  session.found.is_significant = true;
  session.found.improves = improves;
  LasersRun run;
  run.calibrations.push_back(session);
  return run;
}

bool holds(const std::vector<std::string>& sentences, const std::string& text) {
  return std::any_of(sentences.begin(), sentences.end(),
                     [&](const std::string& sentence) { return sentence.find(text) != std::string::npos; });
}

TEST(CalibrationReport, ReportsEstimatesAndUnobservableTerms) {
  const LasersRun run = runWithCalibration(true);
  const std::vector<std::string> sentences = calibrationSentences(run);
  EXPECT_TRUE(holds(sentences, "calibration of quad: adopted"));
  EXPECT_TRUE(holds(sentences, "laser_left: delay of its stamps 30 +- 0.4 ms"));
  EXPECT_TRUE(holds(sentences,
                    "not observable in this session: delay of laser_right; shift of panorama along its x axis "
                    "(forward)"));
  const std::vector<PageTable> tables = calibrationTables(run);
  ASSERT_EQ(tables.size(), 1U);
  EXPECT_EQ(tables[0].rows.size(), 21U);
  EXPECT_TRUE(holds(sentences, "panorama: delay of its stamps 20 +- 1 ms; adopted: the views of a point differ by"));
  EXPECT_EQ(tables[0].rows[7],
            (std::vector<std::string>{"laser_right, delay of its stamps", "not observable", "as stated"}));
  const std::string delays = delaysJson(run).print();
  EXPECT_NE(delays.find("\"laser_left\": 30.0,"), std::string::npos) << delays;
  EXPECT_NE(delays.find("\"laser_right\": null"), std::string::npos) << delays;
}

TEST(CalibrationReport, DelaysAreThoseOfAllSessionsByTheirInformation) {
  LasersRun run = runWithCalibration(true);
  run.calibrations.push_back(run.calibrations.front());
  SessionCalibration& second = run.calibrations.back();
  second.found.lasers[0].terms[0] = {0.034, 0.0004, true, 0.034};   // as sure as the first one
  second.found.lasers[1].terms[0] = {-0.012, 0.002, true, -0.012};  // the first one does not tell
  second.panorama->head.terms[0] = {0.026, 0.0005, true, 0.026};    // four times the information
  const std::string delays = delaysJson(run).print();
  EXPECT_NE(delays.find("\"laser_left\": 32"), std::string::npos) << delays;
  EXPECT_NE(delays.find("\"laser_right\": -12"), std::string::npos) << delays;
  EXPECT_NE(delays.find("\"panorama\": 24.8"), std::string::npos) << delays;
}

TEST(CalibrationReport, ReportsWhyTheStatedCalibrationIsKept) {
  EXPECT_TRUE(
      holds(calibrationSentences(runWithCalibration(false)), "calibration of quad: the stated calibration is kept"));
}

TEST(CalibrationReport, WithoutTheOptionThereIsNothing) {
  EXPECT_TRUE(calibrationSentences({}).empty());
  EXPECT_TRUE(calibrationTables({}).empty());
  EXPECT_EQ(delaysJson({}).print(), Json::object().print());
}

}  // namespace
}  // namespace urban_nav
