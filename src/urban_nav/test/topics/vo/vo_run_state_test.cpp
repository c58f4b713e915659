// SPDX-License-Identifier: BSD-3-Clause
#include "topics/vo/vo_run_state.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "map/chain_g2o.hpp"
#include "map/trajectory_files.hpp"
#include "topics/vo/vo_files.hpp"
#include "topics/vo/vo_recorder.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_store/digest.hpp"

namespace urban_nav {
namespace {

VoRun someRun(int frames) {
  const urban_nav_input::testing::TemporaryFolder folder;
  urban_nav_input::testing::KittiStyle style;
  style.frames = frames;
  urban_nav_input::testing::makeKittiFolder(folder.file("in"), style);
  const std::unique_ptr<urban_nav_input::Source> source = urban_nav_input::openSource({folder.file("in")}, {});
  VoRun run;
  VoRecorder recorder(swf_vo::Parameters(), source->info(), run);
  while (const std::optional<urban_nav_input::SourceItem> input = source->next()) recorder.process(*input);
  recorder.finish({{"a fault"}, {{0, {0.1, 0.2, 9.8}}, {50'000'000, {0.1, 0.3, 9.7}}}}, false);
  return run;
}

TEST(VoState, ComesBackBitByBit) {
  const VoRun run = someRun(20);
  const std::string bytes = packVoRun(run);
  std::optional<VoRun> back = unpackVoRun(bytes);
  ASSERT_TRUE(back);
  EXPECT_TRUE(packVoRun(*back) == bytes);
  back->input = run.input;
  back->camera = run.camera;
  back->T_base_camera = run.T_base_camera;
  const auto trajectories = odometryTrajectories({&run}), again = odometryTrajectories({&*back});
  const auto files = trajectoryFiles({&run}, trajectories), files_again = trajectoryFiles({&*back}, again);
  for (std::size_t i = 0; i < files.size(); ++i) EXPECT_EQ(files_again[i].content(), files[i].content()) << i;
  EXPECT_EQ(chainG2o(*back), chainG2o(run));
  EXPECT_TRUE(landmarksPly(*back) == landmarksPly(run));
  EXPECT_EQ(statsCsv({&*back}, {&*back}), statsCsv({&run}, {&run}));
  ASSERT_EQ(back->pictures.size(), run.pictures.size());
  EXPECT_FALSE(run.pictures.empty());
  EXPECT_EQ(back->pictures.front().jpeg, run.pictures.front().jpeg);
  EXPECT_EQ(back->faults, run.faults);
  ASSERT_EQ(back->forces.size(), 2U);
  EXPECT_EQ(back->forces[1].force, run.forces[1].force);
}

/// Appends numbers as the programs of version 2 did: little-endian, whole numbers in eight bytes, texts and lists after
/// their length.
class BytesOfVersion2 {
 public:
  BytesOfVersion2& integers(std::initializer_list<std::int64_t> values) {
    for (const std::int64_t value : values) append(static_cast<std::uint64_t>(value), 8);
    return *this;
  }
  BytesOfVersion2& reals(std::initializer_list<double> values) {
    for (const double value : values) append(toBits<std::uint64_t>(value), 8);
    return *this;
  }
  BytesOfVersion2& real32(float value) { return append(toBits<std::uint32_t>(value), 4); }
  BytesOfVersion2& version() { return append(2, 4); }
  BytesOfVersion2& text(const std::string& value) {
    append(value.size(), 8);
    bytes_ += value;
    return *this;
  }
  /// 36 numbers that count up from `first`, row by row.
  BytesOfVersion2& matrix(double first) {
    for (int i = 0; i < 36; ++i) reals({first + i});
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  template <typename Bits, typename Number>
  static Bits toBits(Number value) {
    Bits bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
  }
  BytesOfVersion2& append(std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) bytes_ += static_cast<char>(value >> (8 * i) & 0xffU);
    return *this;
  }

  std::string bytes_;
};

std::string runOfVersion2() {
  BytesOfVersion2 bytes;
  bytes.version();
  bytes.integers({1, 3, 4, 0}).integers({1, 5}).text("why");            // a row: frame, stamp, accepted; status
  bytes.integers({6, 7, 8}).reals({9.5, 0.25}).integers({10, 11, 12});  // statistics
  bytes.reals({0.5, 0.125, -0.5, 1.5}).reals({1, 2, 3, 0, 0, 0.8, 0.6}).reals({20.5});
  bytes.integers({1, 13, 14}).reals({4, 5, 6, 0.8, 0, 0, 0.6}).matrix(100);  // a settled pose
  bytes.integers({15, 16}).reals({7, 8, 9, 0, -0.8, 0, 0.6}).matrix(200);    // the step to it
  bytes.integers({2, 17}).text("lost").text("swf_vo").matrix(300).integers({3, 18}).text("");
  bytes.integers({1, 19, 20}).text("tracks").text(std::string("\xff\xd8\0", 3)).integers({21, 22});  // a picture
  bytes.integers({2}).text("a").text("bc").integers({23});                                           // faults
  bytes.integers({1, 24}).reals({0.5, -0.5, 9.75});                                                  // a specific force
  bytes.integers({1, 25}).reals({1.5, 2.5, 3.5}).real32(0.75F).integers({200, 26});                  // a landmark
  return bytes.bytes();
}

urban_nav_core::Matrix6d countedFrom(double first) {
  urban_nav_core::Matrix6d matrix;
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column) matrix(row, column) = first + 6 * row + column;
  return matrix;
}

bool isSame(const urban_nav_core::Pose& pose, const Eigen::Vector3d& t, const Eigen::Quaterniond& q) {
  return pose.t() == t && pose.q().coeffs() == q.coeffs();
}

TEST(VoState, Version2IsRead) {
  const std::string bytes = runOfVersion2();
  ASSERT_EQ(urban_nav_store::sha256(bytes), "1169c17f9910b635689f1f0e619638026e63c64ea56fac4435832c9ee6cf3a2b")
      << "as the program of that version wrote them";
  const std::optional<VoRun> run = unpackVoRun(bytes);
  ASSERT_TRUE(run);
  ASSERT_EQ(run->frames.size(), 1U);
  ASSERT_EQ(run->figures.size(), 1U);
  const OdometryFrame& row = run->frames[0];
  const swf_vo::Statistics& statistics = run->figures[0].statistics;
  EXPECT_EQ(row.frame, 3);
  EXPECT_EQ(row.stamp, 4);
  EXPECT_FALSE(row.accepted);
  EXPECT_EQ(row.status, (urban_nav_core::Status{urban_nav_core::Health::Degraded, 5, "why"}));
  EXPECT_EQ(statistics.corners, 6);
  EXPECT_EQ(statistics.track_length_mean, 9.5);
  EXPECT_EQ(statistics.landmarks_in_prior, 12);
  EXPECT_EQ(statistics.row_offset_px, -0.5);
  EXPECT_EQ(statistics.noise_scale, 1.5);
  EXPECT_TRUE(isSame(row.T_odom_base, {1, 2, 3}, {0.6, 0, 0, 0.8}));
  EXPECT_EQ(run->figures[0].process_ms, 20.5);
  ASSERT_EQ(run->settled.size(), 1U);
  const SmoothedFrame& settled = run->settled[0];
  EXPECT_EQ(settled.frame, 13);
  EXPECT_TRUE(isSame(settled.T_odom_base.pose, {4, 5, 6}, {0.6, 0.8, 0, 0}));
  EXPECT_EQ(settled.T_odom_base.covariance, countedFrom(100));
  EXPECT_EQ(settled.from_previous.to, 16);
  EXPECT_TRUE(isSame(settled.from_previous.T_from_to, {7, 8, 9}, {0.6, 0, -0.8, 0}));
  EXPECT_EQ(settled.from_previous.covariance, countedFrom(200));
  EXPECT_EQ(settled.from_previous.drift_covariance, countedFrom(300));
  EXPECT_EQ(settled.from_previous.source, "swf_vo");
  EXPECT_EQ(settled.status.reason, 18);
  ASSERT_EQ(run->pictures.size(), 1U);
  EXPECT_EQ(run->pictures[0].jpeg, (std::vector<unsigned char>{0xff, 0xd8, 0}));
  EXPECT_EQ(run->pictures[0].height, 22);
  EXPECT_EQ(run->faults, (std::vector<std::string>{"a", "bc"}));
  EXPECT_EQ(run->faults_total, 23);
  ASSERT_EQ(run->forces.size(), 1U);
  EXPECT_EQ(run->forces[0].force, Eigen::Vector3d(0.5, -0.5, 9.75));
  ASSERT_EQ(run->landmarks.count(25), 1U);
  const VoLandmark& landmark = run->landmarks.at(25);
  EXPECT_EQ(landmark.landmark.p_odom, Eigen::Vector3d(1.5, 2.5, 3.5));
  EXPECT_EQ(landmark.landmark.sigma, 0.75F);
  EXPECT_EQ(landmark.grey, 200);
  EXPECT_EQ(landmark.seen, 26);
  const std::optional<VoRun> again = unpackVoRun(packVoRun(*run));
  ASSERT_TRUE(again);
  EXPECT_EQ(again->settled[0].T_odom_base.covariance, countedFrom(100));
}

TEST(VoState, EarlierVersionsAreReadWithoutConstantsOfTheRig) {
  VoRun run = *unpackVoRun(runOfVersion2());
  run.rig.delay_s = 1e-3;
  run.motion.wheel_scale = 1.02;
  run.frames[0].compared.disparity_step_px = 0.25;
  run.figures.back().statistics.right_turn_rad.y() = 0.004;
  ASSERT_EQ(run.settled.size(), 1U);
  run.settled[0].from_previous.constants = {{"scale", 0.0, 0.0, 5e-4, urban_nav_core::Vector6d::Unit(2)}};
  const std::string now = packVoRun(run);
  const std::string name = "visual odometry of a session";
  const VoRun same = unpackVoRun(now).value();
  ASSERT_EQ(same.rig.delay_s, 1e-3);
  ASSERT_EQ(same.motion.wheel_scale, 1.02);
  ASSERT_EQ(same.frames[0].compared.disparity_step_px, 0.25);
  ASSERT_EQ(same.rig.right_turn_rad.y(), 0.004);
  ASSERT_EQ(same.settled[0].from_previous.constants.size(), 1U);
  EXPECT_TRUE(isApprox(same.settled[0].from_previous, run.settled[0].from_previous, 0.0));
  // The turn of the right camera in each frame, version 8, comes last. Before it are the comparisons of each frame,
  // version 7, the states of motion sensors, version 6, and
  // those of version 5: number of steps, number of constants, length of a name and its five letters, nine numbers.
  // Those of version 4, five numbers, precede them.
  urban_nav_core::Archive turns, compared, motion;
  std::vector<urban_nav_core::Vector3d> turned(run.frames.size(), urban_nav_core::Vector3d::Zero());
  turns(turned);
  std::vector<urban_nav_core::FrameMeasurements> each;
  for (const OdometryFrame& frame : run.frames) each.push_back(frame.compared);
  compared(each);
  motion(run.motion);
  std::string content(urban_nav_core::unseal(name, 8, now));
  content.resize(content.size() - turns.take().size());
  const VoRun seventh = unpackVoRun(urban_nav_core::seal(name, 7, content)).value();
  EXPECT_EQ(seventh.frames[0].compared.disparity_step_px, 0.25);
  EXPECT_TRUE(seventh.rig.right_turn_rad.isZero(0.0));
  content.resize(content.size() - compared.take().size());
  const VoRun sixth = unpackVoRun(urban_nav_core::seal(name, 6, content)).value();
  EXPECT_EQ(sixth.motion.wheel_scale, 1.02);
  EXPECT_EQ(sixth.frames[0].compared.disparity_step_px, 0.0);
  content.resize(content.size() - motion.take().size());
  const VoRun fifth = unpackVoRun(urban_nav_core::seal(name, 5, content)).value();
  EXPECT_EQ(fifth.motion.wheel_scale, 1.0);
  EXPECT_EQ(fifth.settled[0].from_previous.constants.size(), 1U);
  const std::size_t steps = 8 + 8 + 8 + 5 + 9 * sizeof(double), rig = 5 * sizeof(double);
  const VoRun fourth = unpackVoRun(urban_nav_core::seal(name, 4, content.substr(0, content.size() - steps))).value();
  EXPECT_EQ(fourth.rig.delay_s, 1e-3);
  EXPECT_TRUE(fourth.settled[0].from_previous.constants.empty());
  const VoRun third =
      unpackVoRun(urban_nav_core::seal(name, 3, content.substr(0, content.size() - steps - rig))).value();
  EXPECT_EQ(third.rig.delay_s, 0.0);
  EXPECT_EQ(third.settled[0].T_odom_base.covariance, countedFrom(100));
}

TEST(VoState, DamagedBytesOfVersion2AreRefused) {
  const std::string bytes = runOfVersion2();
  for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_FALSE(unpackVoRun(bytes.substr(0, size))) << size;
  const auto result = urban_nav_core::testing::fuzzText({bytes}, [](const std::string& text) {
    if (!unpackVoRun(text)) throw urban_nav_core::DataError("x", "refused", "");
  });
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.accepted, 0);
  EXPECT_GT(result.refused, 0);
}

TEST(VoState, SurvivesAnything) {
  VoRun run = someRun(3);
  run.landmarks.erase(std::next(run.landmarks.begin(), 3), run.landmarks.end());
  const auto result = urban_nav_core::testing::fuzzText({packVoRun(run)}, [](const std::string& text) {
    if (!unpackVoRun(text)) throw urban_nav_core::DataError("x", "refused", "");
  });
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.accepted, 0);
  EXPECT_GT(result.refused, 0);
}

}  // namespace
}  // namespace urban_nav
