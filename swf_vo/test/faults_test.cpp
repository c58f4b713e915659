// SPDX-License-Identifier: BSD-3-Clause
// Camera faults on frames of a rendered room and of a real street: they are reported with a reason, the filter
// recovers, and the covariance accounts for them.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "play.hpp"
#include "recordings.hpp"
#include "urban_nav_core/trajectory/nees.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::chiSquareQuantile;
using urban_nav_core::distanceBetween;
using urban_nav_core::Health;
using urban_nav_core::Pose;
using urban_nav_core::PoseWithCovariance;
using urban_nav_core::Vector6d;
using urban_nav_core::testing::dataFolder;
using urban_nav_core::testing::readSequenceFolder;

struct Trouble {
  const char* fault;
  std::vector<Reason> names;  ///< acceptable reasons
};
void PrintTo(const Trouble& trouble, std::ostream* out) { *out << trouble.fault; }

/// Result of a recording with a fault.
struct FaultOutcome {
  int named = -1;  ///< frames from the start of the fault until it was reported with an acceptable reason
  Frame last;      ///< last accepted frame
  Pose truth;      ///< true pose of `last`
  double error() const { return distanceBetween(truth, last.T_odom_base.pose); }
};

FaultOutcome play(const Recording& recording, const Trouble& trouble) {
  FaultOutcome outcome;
  playWithFault(recording, trouble.fault, [&](const Played& played) {
    const Frame& now = played.frame;
    expectProper(now);
    const auto& names = trouble.names;
    if (outcome.named < 0 &&
        std::find(names.begin(), names.end(), static_cast<Reason>(now.status.reason)) != names.end())
      outcome.named = played.since;
    if (!now.accepted) return;
    outcome.last = now;
    outcome.truth = recording.truth[played.index];
  });
  return outcome;
}

// A fault after the last frame has no effect.
FaultOutcome undisturbed(const Recording& recording) { return play(recording, {"black:1000:1", {}}); }

double computeLength(const Recording& recording) {
  double sum = 0.0;
  for (std::size_t i = 1; i < recording.truth.size(); ++i)
    sum += distanceBetween(recording.truth[i - 1], recording.truth[i]);
  return sum;
}

void expectNamedAndOvercome(const FaultOutcome& outcome) {
  EXPECT_GE(outcome.named, 0) << "never named";
  EXPECT_LE(outcome.named, 2) << "named late";
  EXPECT_NE(outcome.last.status.health, Health::Lost) << "did not recover: " << outcome.last.status;
}

double undisturbedError(const std::string& motion) {
  static std::map<std::string, double> known;
  if (known.count(motion) == 0) known[motion] = undisturbed(inTheRoom(motion, 1.0, 80)).error();
  return known[motion];
}

// Measurements from before a gap must not be compared with poses after it.
TEST(Darkness, DoesNotChangeTheNoiseScale) {
  double before = 0.0;
  playWithFault(inTheRoom("wander", 1.0, 80), "black:1.5:0.1", [&](const Played& played) {
    const double noise = played.frame.statistics.noise_scale;
    if (played.since <= 0) before = noise;
    if (played.since > 0 && played.since < 8) {
      EXPECT_LT(noise, 1.1 * before) << played.since << " frames after";
    }
  });
  EXPECT_GT(before, 0.0);
}

// A forward clock jump of ten seconds does not move the camera; the motion is measured by the images.
TEST(ClockJump, MovesNothing) {
  for (const char* motion : {"loop", "wander"}) {
    const Recording& room = inTheRoom(motion, 1.0, 80);
    int seen = 0;
    playWithFault(room, "jump:1.5:1:10", [&](const Played& played) {
      if (played.since < 0 || !played.frame.accepted) return;
      ++seen;
      EXPECT_LT(distanceBetween(room.truth[played.index], played.frame.T_odom_base.pose), 0.02)
          << motion << ", " << played.since << " frames after";
      EXPECT_NE(played.frame.status.health, Health::Lost) << motion << ": " << played.frame.status;
    });
    EXPECT_GE(seen, 15);
  }
}

// Wheels with errors of 1.5 times their standard deviation bridge a second without images; the images are used
// afterwards. No measurement counts twice.
TEST(GapOnWheels, IsCrossed) {
  for (const char* motion : {"loop", "wander", "turns"}) {
    SCOPED_TRACE(motion);
    const Recording& room = inTheRoom(motion, 1.0, 80);
    constexpr double kSigma = 0.02;  // m, rad
    const auto wheels = [&](std::size_t from, std::size_t to) {
      urban_nav_core::MotionInput input;
      input.from = room.frames[from].stamp, input.to = room.frames[to].stamp;
      const Vector6d off = 1.5 * kSigma * (Vector6d() << 1.0, -1.0, 1.0, 1.0, -1.0, 1.0).finished();
      input.T_from_to = boxPlus(room.truth[from].inverse() * room.truth[to], off * (to - from > 1 ? 1.0 : 0.0));
      input.information = urban_nav_core::Matrix6d::Identity() / (kSigma * kSigma);
      return std::vector<urban_nav_core::MotionInput>{input};
    };
    Frame last;
    playWithFault(
        room, "drop:1.5:1",
        [&](const Played& played) {
          last = played.frame;
          if (played.since < 0) return;
          EXPECT_NE(last.status.health, Health::Lost) << played.since << ": " << last.status;
          EXPECT_LT(distanceBetween(room.truth[played.index], last.T_odom_base.pose), 0.01) << played.since;
        },
        Parameters(), wheels);
    EXPECT_LT(urban_nav_core::nees(room.truth.back(), last.T_odom_base).value(), chiSquareQuantile(0.99, 6.0));
  }
}

class FaultsInTheRoom : public ::testing::TestWithParam<Trouble> {};

// Root mean square of three runs, since a single end point has a large variance.
TEST_P(FaultsInTheRoom, AreNamedWithinTwoFramesAndOvercome) {
  constexpr int kCount = 3;
  double squares = 0.0, usual = 0.0, nees = 0.0;
  for (const char* motion : {"loop", "wander", "turns"}) {
    SCOPED_TRACE(motion);
    const Recording& room = inTheRoom(motion, 1.0, 80);
    const FaultOutcome outcome = play(room, GetParam());
    expectNamedAndOvercome(outcome);
    squares += std::pow(outcome.error(), 2);
    usual += std::pow(undisturbedError(motion), 2);
    nees += urban_nav_core::nees(outcome.truth, outcome.last.T_odom_base).value();
  }
  EXPECT_LT(nees, chiSquareQuantile(0.99, 6.0 * kCount));
  EXPECT_LT(std::sqrt(squares), 2.0 * std::sqrt(usual));
}

INSTANTIATE_TEST_SUITE_P(
    Each, FaultsInTheRoom,
    ::testing::Values(Trouble{"black:1.5:1", {Reason::Dark}}, Trouble{"freeze:1.5:1", {Reason::Frozen}},
                      Trouble{"swap:1.5:1", {Reason::Swapped}}, Trouble{"drop:1.5:1", {Reason::Gap}},
                      Trouble{"drop:1:10:0.3", {Reason::Gap}}, Trouble{"noleft:1.5:1", {Reason::ImageMissing}},
                      Trouble{"noright:1.5:1", {Reason::ImageMissing}}, Trouble{"equal:1.5:0.5", {Reason::BadStamp}},
                      Trouble{"backward:1.5:0.5", {Reason::BadStamp}},
                      Trouble{"overexpose:1.5:1", {Reason::ExposureJump, Reason::Dark}},
                      Trouble{"blur:1.5:1", {Reason::Blurred}}, Trouble{"blur:1.5:1:2", {Reason::Blurred}},
                      Trouble{"corrupt:1.5:1", {Reason::Corrupted}}, Trouble{"corrupt:1.5:1:0.1", {Reason::Corrupted}},
                      Trouble{"corrupt:1.5:1:0.6", {Reason::Corrupted}}));

// kitti_raw_0926_0005: a car in a bend, with a van ahead. Frames 20 to 90 (28 m) for the faults, 46 to 146 for fast
// turns.
struct Street {
  Recording faults, turning;
  double usual = 0.0;
};

Recording piece(const Recording& whole, std::size_t first, std::size_t count, std::size_t step = 1) {
  Recording result;
  result.camera = whole.camera;
  for (std::size_t i = 0; i < count; i += step) {
    result.frames.push_back(whole.frames[first + i]);
    result.frames.back().stamp = whole.frames[first + i / step].stamp;
    result.truth.push_back(whole.truth[first].inverse() * whole.truth[first + i]);
  }
  return result;
}

const Street* street() {
  static const Street* const read = []() -> const Street* {
    const std::string folder = dataFolder("stereo/kitti_raw_0926_0005");
    if (folder.empty()) return nullptr;
    const Recording whole = readSequenceFolder(folder, 20, 123);
    static Street street;
    street.faults = piece(whole, 0, 70);
    street.turning = piece(whole, 26, 97);
    street.usual = undisturbed(street.faults).error();
    return &street;
  }();
  return read;
}

// The ground truth is from a laser: laser and camera may differ by a common scale of half a per cent (the folder's
// README), which is the assumed error of the distance. The accuracy of its headings is not stated, and the undisturbed
// run differs from them by 0.2 deg where the filter, which assumes an exact calibration, has a standard deviation of
// 0.02: headings are not tested.
bool isWithinWhatIsStated(const FaultOutcome& outcome, double length) {
  PoseWithCovariance end = outcome.last.T_odom_base;
  end.covariance.topLeftCorner<3, 3>() += std::pow(0.005 * length, 2) * Eigen::Matrix3d::Identity();
  return urban_nav_core::neesTranslation(outcome.truth, end).value() < chiSquareQuantile(0.99, 3.0);
}

class FaultsInTheStreet : public ::testing::TestWithParam<Trouble> {};

TEST_P(FaultsInTheStreet, AreNamedWithinTwoFramesAndOvercome) {
  if (street() == nullptr) GTEST_SKIP() << "URBAN_NAV_DATA names no folder with stereo/kitti_raw_0926_0005";
  const FaultOutcome outcome = play(street()->faults, GetParam());
  expectNamedAndOvercome(outcome);
  EXPECT_LT(outcome.error(), 2.0 * street()->usual);
  EXPECT_TRUE(isWithinWhatIsStated(outcome, computeLength(street()->faults))) << "off by " << outcome.error() << " m";
}

INSTANTIATE_TEST_SUITE_P(
    Each, FaultsInTheStreet,
    ::testing::Values(Trouble{"black:1.5:1", {Reason::Dark}}, Trouble{"freeze:1.5:1", {Reason::Frozen}},
                      Trouble{"swap:1.5:1", {Reason::Swapped}}, Trouble{"drop:1.5:1", {Reason::Gap}},
                      Trouble{"drop:1:10:0.3", {Reason::Gap}},
                      Trouble{"overexpose:1.5:1", {Reason::ExposureJump, Reason::Dark}},
                      Trouble{"blur:1.5:1", {Reason::Blurred}}, Trouble{"blur:1.5:1:2", {Reason::Blurred}},
                      Trouble{"corrupt:1.5:1", {Reason::Corrupted}}, Trouble{"corrupt:1.5:1:0.1", {Reason::Corrupted}},
                      Trouble{"corrupt:1.5:1:0.6", {Reason::Corrupted}},
                      Trouble{"backward:1.5:0.5", {Reason::BadStamp}}));

// Fast motion without an image fault; it must be tracked without a status. Every fourth of the real frames at the
// original rate gives a turn of 59 deg/s at 20 m/s. Root mean square over runs from each of the first four frames,
// since a single end point has a large variance.
TEST(Turning, SixtyDegreesASecondAreFollowedInTheStreet) {
  if (street() == nullptr) GTEST_SKIP() << "URBAN_NAV_DATA names no folder with stereo/kitti_raw_0926_0005";
  const Recording& whole = street()->turning;
  double squares = 0.0, usual = 0.0;
  for (std::size_t first = 0; first < 4; ++first) {
    const Recording slow = piece(whole, first, whole.frames.size() - first);
    const Recording fast = piece(slow, 0, slow.frames.size(), 4);
    double most = 0.0;
    for (std::size_t i = 1; i < fast.truth.size(); ++i)
      most = std::max(most, angleBetween(fast.truth[i - 1], fast.truth[i]) /
                                urban_nav_core::secondsBetween(fast.frames[i - 1].stamp, fast.frames[i].stamp));
    EXPECT_GT(most, 57.0 * M_PI / 180.0);
    const FaultOutcome outcome = undisturbed(fast);
    EXPECT_EQ(outcome.last.status.health, Health::Ok) << first << ": " << outcome.last.status;
    EXPECT_TRUE(isWithinWhatIsStated(outcome, computeLength(fast))) << first << ": off by " << outcome.error() << " m";
    squares += std::pow(outcome.error(), 2);
    usual += std::pow(undisturbed(slow).error(), 2);
  }
  EXPECT_LT(std::sqrt(squares), 2.0 * std::sqrt(usual));
}

TEST(Turning, SixtyDegreesASecondAreFollowedInTheRoom) {
  const Recording& room = inTheRoom("spin", 1.0, 70);
  const FaultOutcome outcome = undisturbed(room);
  EXPECT_EQ(outcome.last.status.health, Health::Ok) << outcome.last.status;
  EXPECT_GT(angleBetween(room.truth[68], room.truth[69]), 0.05);
  EXPECT_LT(urban_nav_core::nees(outcome.truth, outcome.last.T_odom_base).value(), chiSquareQuantile(0.99, 6.0));
  EXPECT_LT(outcome.error(), 0.01);
}

// Two frames in the wrong order: the later one is used, the earlier one is rejected.
TEST(FramesInTheWrongOrder, AreRefused) {
  Recording room = inTheRoom("loop", 1.0, 80);
  room.frames.resize(40);
  room.truth.resize(40);
  std::swap(room.frames[20], room.frames[21]);
  std::swap(room.truth[20], room.truth[21]);
  SwfVo filter(Parameters(), room.camera, Pose());
  for (std::size_t i = 0; i < room.frames.size(); ++i) {
    const Frame& now = filter.process(room.frames[i].pair());
    EXPECT_EQ(now.accepted, i != 21) << i;
    EXPECT_EQ(now.status.reason == static_cast<int>(Reason::BadStamp), i == 21) << i;
    EXPECT_LT(distanceBetween(now.T_odom_base.pose, room.truth[i == 21 ? 20 : i]), 0.01) << i;
  }
}

}  // namespace
}  // namespace swf_vo
