// SPDX-License-Identifier: BSD-3-Clause
#include "live/session_recorder.hpp"

#include <gtest/gtest.h>

#include "urban_nav_store/store.hpp"

namespace loop_metric {
namespace {

using urban_nav_core::RelativePose;
using urban_nav_core::StampNs;
using urban_nav_live::StoreWriterLink;
using urban_nav_store::Access;
using urban_nav_store::Session;
using urban_nav_store::Store;

constexpr StampNs kPeriod = 100'000'000, kStart = 1'000'000'000'000;

class SessionRecorderTest : public ::testing::Test {
 protected:
  SessionRecorderTest() : path_(::testing::TempDir() + "loop_metric_session_recorder.db") {
    urban_nav_store::removeStore(path_);
    restart();
  }
  ~SessionRecorderTest() override {
    stop();
    urban_nav_store::removeStore(path_);
  }
  void stop() {
    if (recorder_) recorder_->end();
    recorder_.reset();
    verifier_.reset();
    store_.reset();
  }
  /// A new process with the same store.
  void restart() {
    stop();
    store_.emplace(path_);
    verifier_ = std::make_unique<ClosureVerifier>(Parameters(), 10.0, *store_, [](const auto&) {});
    recorder_ = std::make_unique<SessionRecorder>(urban_nav_registration::Parameters(),
                                                  SessionRecorder::Options{"lisa", "begbroke"}, *store_, *verifier_);
    recorder_->idle();
  }
  static urban_nav_core::OdometrySessionPtr announce(const std::string& recording, StampNs start) {
    return std::make_shared<const urban_nav_core::OdometrySession>(urban_nav_core::OdometrySession{
        urban_nav_store::makeSessionId({"bart", recording, start, ""}), recording, "bart", recording, start});
  }
  void drive(int from, int to, StampNs first = kStart, const urban_nav_core::OdometrySessionPtr& session = nullptr) {
    for (int i = from; i < to; ++i) {
      RelativePose step;
      step.from = first + i * kPeriod;
      step.to = step.from + kPeriod;
      step.T_from_to = urban_nav_core::Pose(urban_nav_core::Quaterniond::Identity(), {0.1, 0.0, 0.0});
      step.covariance = 1e-4 * urban_nav_core::Matrix6d::Identity();
      step.drift_covariance = 0.25 * step.covariance;
      step.source = "swf_vo";
      recorder_->addStep({step, session});
    }
  }
  std::vector<Session> stored() {
    store_->flush();
    return Store(path_, Access::Read).sessions().all();
  }
  std::size_t nodes(const Session& session) {
    store_->flush();
    std::size_t count = 0;
    Store(path_, Access::Read).graph().forEachNode(session.id, [&](const urban_nav_store::Node&) { ++count; });
    return count;
  }

  const std::string path_;
  std::optional<StoreWriterLink> store_;
  std::unique_ptr<ClosureVerifier> verifier_;
  std::unique_ptr<SessionRecorder> recorder_;
};

TEST_F(SessionRecorderTest, StepsBecomePosesOfASessionThatEndsComplete) {
  drive(0, 5);
  ASSERT_EQ(stored().size(), 1U);
  EXPECT_EQ(stored()[0].robot, "lisa");
  EXPECT_EQ(stored()[0].start, kStart);
  EXPECT_FALSE(stored()[0].complete);
  EXPECT_EQ(nodes(stored()[0]), 6U);
  EXPECT_EQ(recorder_->state().session, stored()[0].id);
  recorder_->end();
  EXPECT_TRUE(stored()[0].complete);
  EXPECT_EQ(recorder_->state().session, "");
}

TEST_F(SessionRecorderTest, AJumpBackInTimeBeginsAnotherSession) {
  drive(0, 5, kStart + 100 * kPeriod);
  drive(0, 5, kStart);
  ASSERT_EQ(stored().size(), 2U);
  EXPECT_NE(stored()[0].id, stored()[1].id);
  for (const Session& session : stored()) EXPECT_EQ(nodes(session), 6U);
}

TEST_F(SessionRecorderTest, SessionsAreThoseOfTheOdometry) {
  const auto first = announce("monday", kStart), second = announce("monday (2)", kStart);
  drive(0, 5, kStart, first);
  drive(0, 3, kStart, second);
  EXPECT_EQ(recorder_->state().session, second->id);
  drive(10, 12, kStart, second);
  ASSERT_EQ(stored().size(), 2U) << "a gap is no new session";
  for (const Session& session : stored()) {
    EXPECT_TRUE(session.id == first->id || session.id == second->id);
    EXPECT_EQ(session.robot, "bart");
    EXPECT_EQ(session.start, kStart);
    EXPECT_EQ(session.complete, session.id == first->id);
    EXPECT_EQ(nodes(session), session.id == first->id ? 6U : 7U);
  }
}

TEST_F(SessionRecorderTest, ASessionOfTheOdometryGoesOnAfterARestart) {
  const auto announced = announce("monday", kStart);
  drive(0, 5, kStart, announced);
  restart();
  drive(8, 10, kStart, announced);  // intermediate poses are lost
  ASSERT_EQ(stored().size(), 1U);
  EXPECT_EQ(nodes(stored()[0]), 9U);
}

TEST_F(SessionRecorderTest, OdometryThatContinuesAStoredSessionExtendsIt) {
  drive(0, 5);
  restart();
  drive(5, 8);
  ASSERT_EQ(stored().size(), 1U);
  EXPECT_EQ(nodes(stored()[0]), 9U);
}

TEST_F(SessionRecorderTest, OdometryElsewhereInTimeIsAnotherSession) {
  drive(0, 5);
  restart();
  drive(0, 3, kStart + 1000 * kPeriod);
  EXPECT_EQ(stored().size(), 2U);
}

TEST_F(SessionRecorderTest, InvalidStepsAreRefusedAndCounted) {
  drive(0, 3);
  RelativePose broken;
  broken.from = kStart + 3 * kPeriod;
  broken.to = kStart + 2 * kPeriod;
  recorder_->addStep(broken);
  EXPECT_EQ(recorder_->state().refused_steps, 1);
  EXPECT_EQ(nodes(stored()[0]), 4U);
}

TEST_F(SessionRecorderTest, ScansFromBeforeTheFirstStepBelongToTheSession) {
  urban_nav_core::Scan scan;
  scan.stamp = kStart;
  recorder_->addScan("laser_left", scan);
  EXPECT_EQ(recorder_->unplacedLasers(), std::vector<std::string>{"laser_left"});
  recorder_->setLaser("laser_left", urban_nav_core::Pose());
  EXPECT_TRUE(recorder_->unplacedLasers().empty());
  drive(0, 2);
  ASSERT_EQ(stored().size(), 1U);
  Store file(path_, Access::Read);
  EXPECT_EQ(file.scans().lasers(stored()[0].id), std::vector<std::string>{"laser_left"});
  EXPECT_EQ(file.sessions().extrinsics(stored()[0].id).size(), 1U);
}

TEST_F(SessionRecorderTest, ScansAfterAJumpBackWaitForTheNextSession) {
  drive(0, 2, kStart + 1000 * kPeriod);
  urban_nav_core::Scan scan;
  for (const StampNs stamp : {kStart + 1000 * kPeriod, kStart}) {
    scan.stamp = stamp;
    recorder_->addScan("laser_left", scan);
  }
  const auto scans = [&](const Session& session) {
    store_->flush();
    int count = 0;
    Store(path_, Access::Read)
        .scans()
        .forEach(session.id, "laser_left", 0, 10 * kStart, [&](const urban_nav_core::Scan&) { ++count; });
    return count;
  };
  const Session first = stored()[0];
  EXPECT_EQ(scans(first), 1);
  drive(0, 2, kStart);
  ASSERT_EQ(stored().size(), 2U);
  EXPECT_EQ(scans(first), 1);
  EXPECT_EQ(scans(stored()[0].id == first.id ? stored()[1] : stored()[0]), 1);
}

}  // namespace
}  // namespace loop_metric
