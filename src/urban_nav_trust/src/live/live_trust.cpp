// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_trust.hpp"

#include <algorithm>

#include "urban_nav_core/sequence/time_jump.hpp"
#include "urban_nav_trust/closure_comparison.hpp"
#include "urban_nav_trust/depth_comparison.hpp"
#include "urban_nav_trust/fix_comparison.hpp"
#include "urban_nav_trust/free_space_comparison.hpp"
#include "urban_nav_trust/laser_mounting.hpp"
#include "urban_nav_trust/session_comparisons.hpp"
#include "urban_nav_trust/unavailable_tests.hpp"

namespace urban_nav_trust {

using urban_nav_core::Health;

namespace {

constexpr urban_nav_core::StampNs kPeriod = 1'000'000'000;  // between estimates without a change

/// Tests that require a whole session.
constexpr const char* kOffline[] = {kDepthScaleTest, kExchangeTest, kStereoClosureTest, kLaserClosureTest,
                                    kGravityTest,    kLidarTest,    kLidarScaleTest,    kMountingTest,
                                    kFixTest,        kPassTest,     kFreeSpaceTest};

bool isNews(const LiveEstimate& before, const LiveEstimate& now) {
  return before.frame.state != now.frame.state || before.frame.tests != now.frame.tests ||
         before.results.tests.size() != now.results.tests.size();
}

}  // namespace

const char* toString(Reason reason) {
  switch (reason) {
    case Reason::None: return "none";
    case Reason::CalibrationChanged: return "calibration_changed";
    case Reason::OdometryLost: return "odometry_lost";
  }
  return "none";
}

LiveTrust::LiveTrust(const Parameters& parameters, Listener listener)
    : parameters_(parameters), listener_(std::move(listener)), monitor_(parameters) {}

void LiveTrust::reset() {
  monitor_ = TrustMonitor(parameters_);
  newest_ = published_ = 0;
  health_ = Health::Ok;
  position_.reset();
  travelled_ = 0.0;
  changed_at_.reset();
  last_.reset();
}

void LiveTrust::add(const LiveFrame& frame) {
  if (urban_nav_core::jumpsBack(frame.stamp, newest_)) reset();
  newest_ = std::max(newest_, frame.stamp);
  if (!frame.accepted) return;
  ++frames_;
  health_ = frame.health;
  if (monitor_.add(frame.compared) && (!changed_at_ || !hasLastingFailure())) changed_at_ = travelled_;
}

void LiveTrust::add(const LiveStep& step) { monitor_.add(step.step); }

void LiveTrust::add(const LivePose& pose) {
  if (urban_nav_core::jumpsBack(pose.stamp, newest_)) reset();
  newest_ = std::max(newest_, pose.stamp);
  ++poses_;
  if (position_) travelled_ += (pose.T_odom_base.pose.t() - *position_).norm();
  position_ = pose.T_odom_base.pose.t();
  LiveEstimate estimate = assess(pose);
  if (last_ && !isNews(*last_, estimate) && pose.stamp < published_ + kPeriod) return;
  last_ = std::move(estimate);
  published_ = pose.stamp;
  listener_(*last_);
}

LiveEstimate LiveTrust::assess(const LivePose& pose) const {
  LiveEstimate estimate;
  estimate.results = monitor_.results();
  for (const char* name : kOffline) estimate.results.absent.push_back({name, "not compared on a running robot"});
  for (const char* name : kUnavailableTests) estimate.results.absent.push_back({name, "there is no such test yet"});
  FrameEvidence evidence;
  evidence.stamp = pose.stamp;
  evidence.covariance = pose.T_odom_base.covariance.topLeftCorner<3, 3>();
  evidence.travelled = travelled_;
  evidence.is_lost = health_ == Health::Lost;
  std::vector<Failure> failures;
  for (const ConsistencyTest& test : estimate.results.tests)
    if (isPresent(test))
      failures.push_back({test.name, test.is_corrected ? 0.0 : travelled_ - changed_at_.value_or(0.0)});
  estimate.frame = assessFrame(evidence, failures, confirm(estimate.results), parameters_);
  estimate.reason = assessMap({estimate.frame}, estimate.results, parameters_).reason;
  return estimate;
}

bool LiveTrust::isPresent(const ConsistencyTest& test) const {
  return hasFailed(test, parameters_) && (!test.is_corrected || newest_ < test.interval.to + kLandmarkRenewal);
}

bool LiveTrust::hasLastingFailure() const {
  return last_ && std::any_of(last_->results.tests.begin(), last_->results.tests.end(),
                              [this](const auto& test) { return hasFailed(test, parameters_) && !test.is_corrected; });
}

urban_nav_core::Status LiveTrust::status() const {
  if (health_ == Health::Lost)
    return {Health::Lost, static_cast<int>(Reason::OdometryLost), "odometry is lost: the position is a prediction"};
  if (!changed_at_) return {};
  for (const ConsistencyTest& test : monitor_.results().tests)
    if (isPresent(test)) return {Health::Degraded, static_cast<int>(Reason::CalibrationChanged), test.sentence};
  return {};
}

urban_nav_live::StageReport LiveTrust::report() const {
  urban_nav_live::StageReport report;
  report.status = status();
  report.reason_name = toString(static_cast<Reason>(report.status.reason));
  if (poses_ == 0) {
    report.summary = "no odometry yet";
    report.is_warning = true;
  }
  report.add("state", last_ ? toString(last_->frame.state) : "none");
  for (std::size_t k = 0; last_ && k < kRadii.size(); ++k)
    report.add(k == 0   ? "P(within 0.1 m)"
               : k == 1 ? "P(within 0.5 m)"
                        : "P(within 2 m)",
               last_->frame.probabilities[k]);
  report.add("stereo frames", frames_);
  report.add("poses", poses_);
  return report;
}

}  // namespace urban_nav_trust
