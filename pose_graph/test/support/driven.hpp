// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "pose_graph/pose_graph.hpp"

namespace pose_graph::testing {

constexpr StampNs kPeriod = 50'000'000;  // ns
constexpr int kLap = 100;                // steps of a circle, 0.1 m each

/// A circle whose rotation odometry underestimates.
inline urban_nav_core::RelativePose stepAt(int i) {
  urban_nav_core::RelativePose step;
  step.from = i * kPeriod;
  step.to = (i + 1) * kPeriod;
  step.T_from_to = Pose(urban_nav_core::expSo3(Eigen::Vector3d(1e-4, -1e-4, 2.0 * M_PI / kLap - 3e-4)),
                        Eigen::Vector3d(0.1, 1e-3, -1e-3));
  step.covariance = (urban_nav_core::Vector6d() << 1e-5, 1e-5, 1e-5, 1e-5, 1e-5, 1e-5).finished().asDiagonal();
  step.drift_covariance = 0.5 * step.covariance;
  step.source = "swf_vo";
  return step;
}

inline void drive(PoseGraph& graph, const SessionId& session, int first, int end) {
  for (int i = first; i < end; ++i) graph.addOdometry(session, stepAt(i));
}

/// A closure to the pose of one lap ago.
inline Closure closureAt(const SessionId& session_a, int a, const SessionId& session_b, int b) {
  Closure closure;
  closure.a = {session_a, a * kPeriod};
  closure.b = {session_b, b * kPeriod};
  closure.kind = EdgeKind::Stereo;
  closure.source = "loop_metric";
  closure.measured.information = (urban_nav_core::Vector6d() << 1e4, 1e4, 1e4, 1e5, 1e5, 1e5).finished().asDiagonal();
  closure.odometry_gate = true;
  return closure;
}

inline void expectSameMap(const PoseGraph& a, const PoseGraph& b) {
  ASSERT_EQ(a.tracks().size(), b.tracks().size());
  for (std::size_t t = 0; t < a.tracks().size(); ++t) {
    const Track &x = a.tracks()[t], &y = b.tracks()[t];
    EXPECT_EQ(x.session, y.session);
    ASSERT_EQ(x.stamps, y.stamps);
    EXPECT_EQ(x.part, y.part);
    for (std::size_t i = 0; i < x.map.size(); ++i) {
      EXPECT_EQ(x.map[i].t(), y.map[i].t());
      EXPECT_EQ(x.map[i].q().coeffs(), y.map[i].q().coeffs());
    }
  }
}

/// A path in a separate folder, which is removed after the test.
class StoreFolder {
 public:
  StoreFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "pose_graph_XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~StoreFolder() { std::filesystem::remove_all(folder_); }
  StoreFolder(const StoreFolder&) = delete;
  StoreFolder& operator=(const StoreFolder&) = delete;
  std::string file(const std::string& name = "s.db") const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

}  // namespace pose_graph::testing
