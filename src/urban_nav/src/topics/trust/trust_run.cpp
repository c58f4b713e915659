// SPDX-License-Identifier: BSD-3-Clause
#include "topics/trust/trust_run.hpp"

#include <algorithm>

#include "swf_vo/parameters.hpp"
#include "topics/trust/closure_differences.hpp"
#include "topics/trust/compared_fixes.hpp"
#include "topics/trust/depth_matches.hpp"
#include "topics/trust/place_visits.hpp"
#include "topics/trust/session_estimates.hpp"
#include "topics/trust/tests_not_run.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_test.hpp"
#include "urban_nav_trust/depth_comparison.hpp"
#include "urban_nav_trust/laser_mounting.hpp"
#include "urban_nav_trust/trust_monitor.hpp"

namespace urban_nav {

using urban_nav_trust::ConsistencyTest;
using urban_nav_trust::FrameEvidence;
using urban_nav_trust::FrameTrust;
using urban_nav_trust::TestResults;

namespace {

constexpr double kUnknownVariance = 1e6;         // m^2, of a pose without covariance
constexpr const char* kCorrected = "corrected";  // verdict of a failed test whose cause was corrected

/// Stores the tests of a session, replacing those of an earlier run.
void storeTests(const TestResults& results, const urban_nav_trust::Parameters& parameters,
                const urban_nav_store::SessionId& session, urban_nav_store::Store& store) {
  urban_nav_store::TableStore<urban_nav_store::StoredTest> rows(store);
  for (const urban_nav_trust::AbsentMeasurement& absent : results.absent) {
    urban_nav_store::StoredTest key;
    key.session = session;
    key.name = absent.name;
    rows.remove(key);
  }
  for (const ConsistencyTest& test : results.tests)
    rows.put({session, test.name,
              !hasFailed(test, parameters) ? "passed"
              : test.is_corrected          ? kCorrected
                                           : "failed",
              test.interval.from, test.interval.to, test.statistic, test.degrees_of_freedom, test.p_value,
              test.sentence, test.remedy});
}

/// Returns the stored tests of a session.
TestResults readTests(const urban_nav_store::SessionId& session, urban_nav_store::Store& store) {
  TestResults results;
  urban_nav_store::TableStore<urban_nav_store::StoredTest>(store).forEach(
      session, [&](const urban_nav_store::StoredTest& row) {
        results.tests.push_back({row.name,
                                 {row.from, row.to},
                                 row.statistic,
                                 row.degrees_of_freedom,
                                 row.p_value,
                                 row.sentence,
                                 row.remedy,
                                 row.verdict == kCorrected});
      });
  return results;
}

/// Returns whether a laser took part in measuring the poses: as odometry, or in an accepted closure.
bool havePosesByLasers(const MapContext& context) {
  for (const SessionOdometry* run : context.runs())
    if (run->T_base_lidar) return true;
  for (std::size_t i = 0; i < context.assessments.size(); ++i)
    if (context.closures[i].method == urban_nav_core::ClosureMethod::Icp &&
        context.assessments[i].verdict == urban_nav_core::ClosureVerdict::Accepted)
      return true;
  return false;
}

/// Marks the tests of planar lasers that have only measured the map.
void markTestsOfMap(bool poses_by_lasers, TestResults& results) {
  for (ConsistencyTest& test : results.tests)
    if (test.name == urban_nav_trust::kMountingTest || test.name == urban_nav_trust::kExchangeTest)
      test.affects_position = poses_by_lasers;
}

void removeLaser(int laser, std::vector<urban_nav_trust::KeyframeMatches>& keyframes) {
  for (urban_nav_trust::KeyframeMatches& keyframe : keyframes) {
    auto& matches = keyframe.matches;
    matches.erase(std::remove_if(matches.begin(), matches.end(), [&](const auto& each) { return each.laser == laser; }),
                  matches.end());
  }
}

/// Runs the online tests on a session: steps are added when they are final, as on a running robot.
TestResults monitorSession(const SessionOdometry& run, const urban_nav_trust::Parameters& parameters) {
  urban_nav_trust::TrustMonitor monitor(parameters);
  std::size_t next = 1;
  for (const OdometryFrame& frame : run.frames) {
    for (; next < run.settled.size() && run.settled[next].stamp <= frame.stamp; ++next)
      monitor.add(run.settled[next].from_previous);
    if (frame.accepted) monitor.add(frame.compared);
  }
  return monitor.results();
}

TestResults testSession(MapContext& context, std::size_t number, const urban_nav_trust::Parameters& parameters) {
  if (context.isPrevious(number)) return readTests(context.ids()[number], *context.store);
  const SessionOdometry& run = *context.runs()[number];
  TestResults results = monitorSession(run, parameters);
  const double rig_scale = 0.01 * context.options.parameters.get(swf_vo::table()).rig_scale;
  const urban_nav_store::SessionId id = context.ids()[number];
  std::vector<urban_nav_trust::KeyframeMatches> matches = matchDepths(*context.store, id, run);
  for (const int turned : testLaserMountings(matches, comparedLasers(*context.store, id), parameters.false_alarm,
                                             results.tests, results.absent))
    removeLaser(turned, matches);
  testDepths(matches, rig_scale, results.tests, results.absent);
  testClosures(closureDifferences(context.names[number], run, context.closures, context.assessments), results);
  testPlanes(
      planeDifferences(*context.store, id, run),
      context.store->scans().lasers(id).empty() ? "no lasers" : "no plane was measured by two passes of the lasers",
      results);
  compareGravity(*context.store, id, run, results);
  testLidar(lidarComparison(run), rig_scale, results);
  compareFixes(context, number, results);
  compareFreeSpace(context, number, results);
  if (context.trajectories.size() > 1)
    for (ConsistencyTest& test : results.tests) test.sentence = run.input + ": " + test.sentence;
  storeTests(results, parameters, id, *context.store);
  return results;
}

void append(TestResults results, TestResults& all) {
  for (ConsistencyTest& test : results.tests) all.tests.push_back(std::move(test));
  for (urban_nav_trust::ConstantSegment& segment : results.segments) all.segments.push_back(std::move(segment));
  for (urban_nav_trust::AbsentMeasurement& absent : results.absent) {
    const auto is_same = [&](const auto& known) { return known.name == absent.name && known.reason == absent.reason; };
    if (std::none_of(all.absent.begin(), all.absent.end(), is_same)) all.absent.push_back(std::move(absent));
  }
}

std::vector<FrameEvidence> listFrames(const SessionOdometry& run, const SessionTrajectory& session,
                                      std::size_t first_map) {
  std::vector<FrameEvidence> frames;
  std::size_t next = 0;
  for (std::size_t i = 0; i < session.T_map_base.size(); ++i) {
    FrameEvidence frame;
    frame.stamp = session.T_map_base[i].stamp;
    frame.covariance = kUnknownVariance * Eigen::Matrix3d::Identity();
    if (i < session.covariances.size()) frame.covariance = session.covariances[i].topLeftCorner<3, 3>();
    if (i > 0)
      frame.travelled =
          frames.back().travelled + (session.T_map_base[i].pose.t() - session.T_map_base[i - 1].pose.t()).norm();
    while (next < run.settled.size() && run.settled[next].stamp < frame.stamp) ++next;
    frame.is_lost = next < run.settled.size() && run.settled[next].status.health == urban_nav_core::Health::Lost;
    frame.is_joined = session.map == first_map;
    frames.push_back(std::move(frame));
  }
  return frames;
}

bool hasClosures(const MapContext& context) {
  return std::any_of(context.assessments.begin(), context.assessments.end(), [](const ClosureAssessment& closure) {
    return closure.verdict == urban_nav_core::ClosureVerdict::Accepted;
  });
}

}  // namespace

TrustRun assessTrust(MapContext& context, const urban_nav_trust::Parameters& parameters) {
  TrustRun result;
  const std::vector<const SessionOdometry*> runs = context.runs();
  const std::vector<SessionTrajectory>& sessions = context.trajectories;
  const bool poses_by_lasers = havePosesByLasers(context);
  std::vector<TestResults> by_session;
  for (std::size_t s = 0; s < sessions.size(); ++s) {
    by_session.push_back(testSession(context, s, parameters));
    markTestsOfMap(poses_by_lasers, by_session.back());
    append(by_session.back(), result.results);
  }
  for (urban_nav_trust::AbsentMeasurement& absent : testsNotRun(context))
    result.results.absent.push_back(std::move(absent));
  const bool spreads = hasClosures(context);
  for (std::size_t first = 0; first < sessions.size(); ++first)
    for (std::size_t s = first; s < sessions.size(); ++s) {
      if (sessions[s].map != first || !sessions[first].written) continue;
      const std::vector<FrameEvidence> frames = listFrames(*runs[s], sessions[s], sessions.front().map);
      for (FrameTrust& frame : assessFrames(frames, by_session[s], spreads, parameters))
        result.frames.push_back(std::move(frame));
    }
  result.map = assessMap(result.frames, result.results, parameters);
  return result;
}

}  // namespace urban_nav
