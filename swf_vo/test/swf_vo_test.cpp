// SPDX-License-Identifier: BSD-3-Clause
#include "swf_vo/swf_vo.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "urban_nav_core/testing/allocations.hpp"
#include "urban_nav_core/testing/faults.hpp"
#include "urban_nav_core/testing/rendered_sequence.hpp"
#include "urban_nav_core/testing/textured_room.hpp"
#include "urban_nav_core/types/error.hpp"

namespace swf_vo {
namespace {

using namespace urban_nav_core::testing;
using urban_nav_core::Health;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;

RenderCamera smallCamera() {
  RenderCamera camera;
  camera.fx = camera.fy = 300.0;
  camera.cx = 191.5;
  camera.cy = 143.5;
  camera.width = 384;
  camera.height = 288;
  return camera;
}

StereoCamera stereoCamera() {
  const RenderCamera c = smallCamera();
  return {{c.fx, c.fy, c.cx, c.cy, c.width, c.height}, c.baseline};
}

/// Frames and truth of a motion in the room, drawn once for all tests.
struct Recording {
  std::vector<StereoFrame> frames;
  std::vector<Pose> truth;  // left camera in that of frame 0
};

const Recording& recording(const std::string& motion, double noise, int count) {
  static std::map<std::string, Recording> drawn;
  Recording& result = drawn[motion + std::to_string(noise)];
  if (static_cast<int>(result.frames.size()) >= count) return result;
  SequenceOptions options;
  options.camera = smallCamera();
  options.noise = noise;
  RenderedSequence sequence(texturedRoom(), namedMotion(motion, "room", 1), options);
  for (int i = static_cast<int>(result.frames.size()); i < count; ++i) {
    result.frames.push_back(sequence.frame(i));
    result.truth.push_back(sequence.T_world_camera(0).inverse() * sequence.T_world_camera(i));
  }
  return result;
}

void expectProper(const Frame& frame) {
  EXPECT_TRUE(frame.T_odom_base.pose.isFinite()) << frame.frame;
  ASSERT_TRUE(frame.T_odom_base.covariance.allFinite()) << frame.frame;
  EXPECT_EQ(Eigen::LLT<Matrix6d>(frame.T_odom_base.covariance).info(), Eigen::Success) << frame.frame;
}

TEST(SwfVo, followsTheRobotAndSettlesEveryFrame) {
  const Recording& room = recording("loop", 1.0, 70);
  SwfVo filter(Parameters(), stereoCamera(), Pose());
  std::vector<Settled> settled;
  double length = 0.0;
  for (std::size_t i = 0; i < room.frames.size(); ++i) {
    const Frame& frame = filter.process(room.frames[i].pair());
    expectProper(frame);
    EXPECT_EQ(frame.status.health, Health::Ok) << i << ": " << frame.status;
    if (i > 0) length += distanceBetween(room.truth[i - 1], room.truth[i]);
    EXPECT_LT(distanceBetween(frame.T_odom_base.pose, room.truth[i]), 0.005 + 0.01 * length) << i;
    settled.insert(settled.end(), frame.settled.begin(), frame.settled.end());
  }
  const std::vector<Settled> rest = filter.flush();
  settled.insert(settled.end(), rest.begin(), rest.end());
  ASSERT_EQ(settled.size(), room.frames.size());
  Pose product;
  for (std::size_t i = 0; i < settled.size(); ++i) {
    EXPECT_EQ(settled[i].stamp, room.frames[i].stamp);
    product = i == 0 ? settled[0].T_odom_base.pose : product * settled[i].from_previous.T_from_to;
    EXPECT_TRUE(isApprox(product, settled[i].T_odom_base.pose, 1e-9)) << i;
    EXPECT_LT(distanceBetween(settled[i].T_odom_base.pose, room.truth[i]), 0.005 + 0.01 * length) << i;
  }
}

TEST(SwfVo, standsStill) {
  const Recording& room = recording("stand", 2.0, 40);
  SwfVo filter(Parameters(), stereoCamera(), Pose());
  for (const StereoFrame& frame : room.frames) {
    const Frame& now = filter.process(frame.pair());
    EXPECT_LT(now.T_odom_base.pose.t().norm(), 2e-3);
    EXPECT_LT(angleBetween(now.T_odom_base.pose, Pose()), 1e-3);
  }
}

TEST(SwfVo, theSameCallsGiveTheSameBits) {
  const Recording& room = recording("loop", 1.0, 30);
  SwfVo a(Parameters(), stereoCamera(), Pose()), b(Parameters(), stereoCamera(), Pose());
  for (int i = 0; i < 30; ++i) {
    const auto& frame = room.frames[static_cast<std::size_t>(i)];
    const Frame& x = a.process(frame.pair());
    const Frame& y = b.process(frame.pair());
    EXPECT_EQ(x.T_odom_base.pose.t(), y.T_odom_base.pose.t()) << i;
    EXPECT_EQ(x.T_odom_base.pose.q().coeffs(), y.T_odom_base.pose.q().coeffs()) << i;
    EXPECT_EQ(x.T_odom_base.covariance, y.T_odom_base.covariance) << i;
  }
}

TEST(SwfVo, movesTheBaseNotTheCamera) {
  const Recording& room = recording("loop", 1.0, 20);
  const Pose T_base_camera(Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5), Eigen::Vector3d(0.1, 0.0, 1.1));
  SwfVo camera(Parameters(), stereoCamera(), Pose()), base(Parameters(), stereoCamera(), T_base_camera);
  for (int i = 0; i < 20; ++i) {
    const auto& frame = room.frames[static_cast<std::size_t>(i)];
    const Pose T_first_camera = camera.process(frame.pair()).T_odom_base.pose;
    const Pose T_odom_base = base.process(frame.pair()).T_odom_base.pose;
    // In other axes sums round otherwise; once that has decided about a feature, the runs are as far apart as their errors.
    EXPECT_TRUE(isApprox(T_odom_base, T_base_camera * T_first_camera * T_base_camera.inverse(), i < 3 ? 1e-5 : 1e-3))
        << i;
  }
}

TEST(SwfVo, refusesACameraThatIsNone) {
  StereoCamera camera = stereoCamera();
  camera.baseline = 0.0;
  EXPECT_THROW(SwfVo(Parameters(), camera, Pose()), urban_nav_core::UserError);
  camera = stereoCamera();
  camera.left.fx = -1.0;
  EXPECT_THROW(SwfVo(Parameters(), camera, Pose()), urban_nav_core::UserError);
}

TEST(SwfVo, livesOnNothingAtAll) {
  SwfVo filter(Parameters(), stereoCamera(), Pose());
  std::size_t settled = 0;
  for (int i = 0; i < 15; ++i) {
    const Frame& frame = filter.process({i * 50000000, {}, {}});
    expectProper(frame);
    settled += frame.settled.size();
    EXPECT_EQ(frame.status.health, Health::Lost);
    EXPECT_EQ(frame.status.reason, static_cast<int>(Reason::ImageMissing));
  }
  EXPECT_EQ(settled + filter.flush().size(), 15U);
}

TEST(SwfVo, allocatesNothingAfterFrame50) {
  if (!countsAllocations()) GTEST_SKIP() << "the sanitizer's allocator cannot be counted";
  const Recording& room = recording("loop", 1.0, 70);
  SwfVo filter(Parameters(), stereoCamera(), Pose());
  std::int64_t made = 0;
  for (std::size_t i = 0; i < room.frames.size(); ++i) {
    const AllocationCount count;
    filter.process(room.frames[i].pair());
    if (i >= 50) made += count.sofar();
  }
  EXPECT_EQ(made, 0);
}

struct Trouble {
  const char* fault;
  std::vector<Reason> names;  ///< what it may be called
};
void PrintTo(const Trouble& trouble, std::ostream* out) { *out << trouble.fault; }

class SwfVoFaults : public testing::TestWithParam<Trouble> {};

TEST_P(SwfVoFaults, areNamedWithinTwoFramesAndOvercome) {
  const Recording& room = recording("loop", 1.0, 70);
  FaultFilter faults({parseFault(GetParam().fault)}, 1);
  const Fault fault = parseFault(GetParam().fault);
  SwfVo filter(Parameters(), stereoCamera(), Pose());
  bool begun = false;
  int since = -1, named = -1;  // frames that have arrived since it began
  Frame last;
  for (const StereoFrame& frame : room.frames) {
    begun = begun || fault.isActive(frame.stamp - room.frames.front().stamp);
    const auto arrived = faults.apply(frame);
    if (!arrived) continue;
    if (begun) ++since;
    const Frame& now = filter.process(arrived->pair());
    expectProper(now);
    const auto& names = GetParam().names;
    if (named < 0 && std::find(names.begin(), names.end(), static_cast<Reason>(now.status.reason)) != names.end())
      named = since;
    if (now.accepted) last = now;
  }
  EXPECT_GE(named, 0) << "never named";
  EXPECT_LE(named, 2) << "named late";
  EXPECT_NE(last.status.health, Health::Lost) << "did not recover: " << last.status;
  const Eigen::Matrix<double, 6, 1> d = boxMinus(room.truth.back(), last.T_odom_base.pose);
  const double error = d.head<3>().norm();
  const double sigma = std::sqrt(last.T_odom_base.covariance.topLeftCorner<3, 3>().trace());
  EXPECT_TRUE(error < 0.02 || error < 3.0 * sigma) << "off by " << error << " m, sigma " << sigma << " m";
}

INSTANTIATE_TEST_SUITE_P(
    Each, SwfVoFaults,
    testing::Values(Trouble{"black:1:1", {Reason::Dark}}, Trouble{"freeze:1:0.5", {Reason::Frozen}},
                    Trouble{"swap:1:0.5", {Reason::Swapped}}, Trouble{"drop:1:0.3", {Reason::Gap}},
                    Trouble{"drop:1:2:0.6", {Reason::Gap}},
                    Trouble{"overexpose:1:0.5", {Reason::ExposureJump, Reason::Dark}},
                    Trouble{"blur:1:0.5", {Reason::Blurred}}, Trouble{"noleft:1:0.3", {Reason::ImageMissing}},
                    Trouble{"noright:1:0.3", {Reason::ImageMissing}}, Trouble{"equal:1:0.3", {Reason::BadStamp}},
                    Trouble{"backward:1:0.3", {Reason::BadStamp}}));

struct Effort {
  int window, iterations;
};
void PrintTo(const Effort& effort, std::ostream* out) {
  *out << effort.window << " poses, " << effort.iterations << " steps";
}

class SwfVoEfforts : public testing::TestWithParam<Effort> {};

// For a while the window holds nothing but poses that only the process model ties together.
TEST_P(SwfVoEfforts, overcomeAPauseInTheMeasurements) {
  const Recording& room = recording("loop", 1.0, 70);
  for (const char* fault : {"blur:1:0.5", "blur:0.5:1.5", "black:0.7:1.5"}) {
    FaultFilter faults({parseFault(fault)}, 1);
    Parameters parameters;
    parameters.window = GetParam().window;
    parameters.iterations = GetParam().iterations;
    SwfVo filter(parameters, stereoCamera(), Pose());
    Frame last;
    for (const StereoFrame& frame : room.frames) {
      const auto arrived = faults.apply(frame);
      if (!arrived) continue;
      last = filter.process(arrived->pair());
      expectProper(last);
    }
    EXPECT_NE(last.status.health, Health::Lost) << fault << ": did not recover: " << last.status;
    const Eigen::Matrix<double, 6, 1> d = boxMinus(room.truth.back(), last.T_odom_base.pose);
    const Matrix6d& P = last.T_odom_base.covariance;
    EXPECT_LT(d.head<3>().norm(), 0.02 + 3.0 * std::sqrt(P.topLeftCorner<3, 3>().trace())) << fault;
    EXPECT_LT(d.tail<3>().norm(), 0.01 + 3.0 * std::sqrt(P.bottomRightCorner<3, 3>().trace())) << fault;
    EXPECT_LT(d.head<3>().norm(), 10.0) << fault << ": ran away";
  }
}

INSTANTIATE_TEST_SUITE_P(Each, SwfVoEfforts,
                         testing::Values(Effort{1, 1}, Effort{1, 3}, Effort{1, 20}, Effort{10, 1}, Effort{10, 3},
                                         Effort{10, 20}, Effort{25, 1}, Effort{25, 3}, Effort{25, 20}));

}  // namespace
}  // namespace swf_vo
