// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/edited_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/driven.hpp"

namespace pose_graph {
namespace {

using testing::closureAt;
using testing::expectSameMap;
using testing::kLap;
using testing::kPeriod;

constexpr const char* kSession = "a";

NodeRef lapPose(int pose) { return {kSession, pose * kPeriod}; }

Edit verdict(Edit::Action action, std::int64_t number, int lap_pose) {
  const Closure closure = closureAt(kSession, lap_pose, kSession, lap_pose + kLap);
  Edit edit;
  edit.action = action;
  edit.number = number;
  edit.a = closure.a;
  edit.b = closure.b;
  edit.kind = closure.kind;
  edit.source = closure.source;
  return edit;
}

/// Two laps with a closure at every tenth pose, with edits applied.
struct EditedLaps {
  explicit EditedLaps(std::vector<Edit> edits) : edited(graph, std::move(edits)) {
    for (int i = 0; i < 2 * kLap; ++i) edited.addOdometry(kSession, testing::stepAt(i));
    for (int i = 10; i < kLap; i += 10) edited.addClosure(closureAt(kSession, i, kSession, i + kLap));
    edited.addOwnClosures();
    edited.relax([this] { relaxed = graph.relax(); }, [](const SessionId&) { return Pose(); });
  }
  Pose pose(int i) const { return graph.tracks()[0].map[static_cast<std::size_t>(i)]; }

  PoseGraph graph{Parameters()};
  EditedGraph edited;
  Relaxed relaxed;
};

TEST(EditedGraph, WithoutEditsItIsTheGraphOfTheMeasurements) {
  const EditedLaps edited({});
  PoseGraph graph{Parameters()};
  testing::drive(graph, kSession, 0, 2 * kLap);
  for (int i = 10; i < kLap; i += 10) graph.addClosure(closureAt(kSession, i, kSession, i + kLap));
  graph.relax();
  expectSameMap(edited.graph, graph);
  EXPECT_TRUE(edited.edited.warnings().empty());
}

TEST(EditedGraph, RejectedClosuresTakeNoPartInAnyOrder) {
  const EditedLaps once({verdict(Edit::Action::Reject, 1, 20), verdict(Edit::Action::Reject, 2, 50)});
  const EditedLaps other({verdict(Edit::Action::Reject, 1, 50), verdict(Edit::Action::Reject, 2, 20)});
  expectSameMap(once.graph, other.graph);
  EXPECT_EQ(once.relaxed.closures, 7u);
  ASSERT_EQ(once.edited.rejected().size(), 2u);
  EXPECT_EQ(once.edited.rejected()[0].verdict, ClosureVerdict::Rejected);
  EXPECT_EQ(once.edited.rejected()[0].weight, 0.0);
}

TEST(EditedGraph, TheLastVerdictOnAClosureCounts) {
  const EditedLaps unedited({});
  const EditedLaps taken_back({verdict(Edit::Action::Reject, 1, 20), verdict(Edit::Action::Accept, 2, 20)});
  expectSameMap(unedited.graph, taken_back.graph);
}

TEST(EditedGraph, AcceptsAClosureThatContradictsAllOthers) {
  const auto build = [](std::vector<Edit> edits) {
    PoseGraph graph{Parameters()};
    EditedGraph edited(graph, std::move(edits));
    for (int i = 0; i < 2 * kLap; ++i) edited.addOdometry(kSession, testing::stepAt(i));
    for (int i = 10; i < kLap; i += 10) {
      Closure closure = closureAt(kSession, i, kSession, i + kLap);
      if (i == 50) closure.measured.T_a_b = Pose(Eigen::Quaterniond::Identity(), {2.0, 0.0, 0.0});
      edited.addClosure(closure);
    }
    edited.addOwnClosures();
    edited.relax([&] { graph.relax(); }, [](const SessionId&) { return Pose(); });
    return graph.closures().at(5).verdict;
  };
  EXPECT_EQ(build({}), ClosureVerdict::Rejected);
  EXPECT_EQ(build({verdict(Edit::Action::Accept, 1, 50)}), ClosureVerdict::Accepted);
}

TEST(EditedGraph, AddsAndRemovesAssertedClosures) {
  Edit asserted;
  asserted.action = Edit::Action::Add;
  asserted.number = 1;
  asserted.a = lapPose(5);
  asserted.b = lapPose(5 + kLap);
  asserted.source = "edit assert 1";
  asserted.measured.T_a_b = Pose(Eigen::Quaterniond::Identity(), {0.01, 0.0, 0.0});
  asserted.measured.information = 1e6 * urban_nav_core::Matrix6d::Identity();
  const EditedLaps with({asserted});
  EXPECT_EQ(with.relaxed.accepted, 10u);
  const Pose T = with.pose(5).inverse() * with.pose(5 + kLap);
  EXPECT_NEAR((T.t() - Eigen::Vector3d(0.01, 0.0, 0.0)).norm(), 0.0, 0.005);
  Edit removed = asserted;
  removed.action = Edit::Action::Remove;
  removed.number = 2;
  const EditedLaps without({asserted, removed}), unedited({});
  expectSameMap(without.graph, unedited.graph);
}

TEST(EditedGraph, APinMovesAPointOntoItsPlace) {
  const EditedLaps unedited({});
  Edit pin;
  pin.action = Edit::Action::Pin;
  pin.number = 1;
  pin.a = pin.b = lapPose(50);
  pin.source = "edit pin 1";
  pin.sigma = 1e-3;
  pin.p_base = {1.0, 0.5, 0.3};
  pin.p_map = unedited.pose(50) * pin.p_base + Eigen::Vector3d(0.3, 0.2, 0.1);
  const EditedLaps pinned({pin});
  EXPECT_LT((pinned.pose(50) * pin.p_base - pin.p_map).norm(), 0.005);
  EXPECT_LT((pinned.pose(0).t() - unedited.pose(0).t()).norm(), 1e-12) << "the origin stays";
}

TEST(EditedGraph, ACutLeavesTwoPiecesToTheirClosures) {
  Edit cut;
  cut.action = Edit::Action::Cut;
  cut.number = 1;
  cut.a = cut.b = lapPose(kLap - 1);
  const EditedLaps divided({cut});
  EXPECT_EQ(divided.graph.stepTo(0, kLap), nullptr);
  EXPECT_EQ(divided.graph.tracks()[0].map.size(), 2u * kLap + 1);
  EXPECT_EQ(divided.relaxed.parts, 1) << "closures hold both pieces";
  EXPECT_LT(distanceBetween(divided.pose(20), divided.pose(20 + kLap)), 0.05);
}

TEST(EditedGraph, NamesEditsWithoutEffect) {
  const EditedLaps laps({verdict(Edit::Action::Reject, 3, 15)});
  ASSERT_EQ(laps.edited.warnings().size(), 1u);
  EXPECT_NE(laps.edited.warnings()[0].find("edit 3"), std::string::npos);
}

TEST(EditedGraph, OriginIsThatOfTheMapOfTheSession) {
  Edit origin;
  origin.action = Edit::Action::Origin;
  origin.number = 1;
  origin.a = origin.b = lapPose(30);
  const EditedLaps laps({origin});
  ASSERT_TRUE(laps.edited.origin(kSession));
  EXPECT_EQ(laps.edited.origin(kSession)->stamp, 30 * kPeriod);
  EXPECT_FALSE(laps.edited.origin("another"));
}

}  // namespace
}  // namespace pose_graph
