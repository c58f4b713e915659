// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_localiser.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "urban_nav_core/testing/motion.hpp"
#include "urban_nav_core/testing/rendered_sequence.hpp"
#include "urban_nav_core/testing/textured_room.hpp"
#include "urban_nav_registration/keyframe/keyframe_extractor.hpp"
#include "urban_nav_registration/session/calibration_fingerprint.hpp"
#include "urban_nav_registration/session/stored_keyframe.hpp"

namespace urban_nav_localization {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::testing::RenderedSequence;
using urban_nav_registration::kKeyframeCamera;

constexpr StampNs kNextDay = 86'400'000'000'000;
constexpr int kDrivenFrames = 9;
const char* const kFirstDay = "0123456789abcdef0123";

/// Finds the keyframes that were taken at the same time of the day.
class SameTimeOfDay final : public urban_nav_registration::KeyframeRetrieval {
 public:
  void open(urban_nav_store::Store&, std::vector<urban_nav_registration::SearchedKeyframe> keyframes) override {
    keyframes_ = std::move(keyframes);
  }
  std::size_t read() const override { return read_; }
  bool readNext() override { return ++read_ < keyframes_.size(); }
  std::vector<std::size_t> find(const urban_nav_registration::Keyframe& keyframe, std::size_t) const override {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < keyframes_.size(); ++i)
      if (keyframes_[i].at.stamp == keyframe.at.stamp - kNextDay) found.push_back(i);
    return found;
  }

 private:
  std::vector<urban_nav_registration::SearchedKeyframe> keyframes_;
  std::size_t read_ = 0;
};

RenderedSequence aroundTheRoom(StampNs first_stamp, std::uint32_t seed) {
  urban_nav_core::testing::SequenceOptions options;
  options.rate = 1.25;
  options.first_stamp = first_stamp;
  options.seed = seed;
  return RenderedSequence(urban_nav_core::testing::texturedRoom(),
                          urban_nav_core::testing::loop(3.0, 1.5, 1.2, 24 / options.rate), options);
}

/// A robot whose base_link is its left camera, on the second day of a drive around a room.
class LiveLocaliserTest : public ::testing::Test {
 protected:
  void SetUp() override {
    path_ = ::testing::TempDir() + "live_localiser_" + std::to_string(::getpid()) + ".db";
    urban_nav_store::removeStore(path_);
    RenderedSequence first = aroundTheRoom(1, 1);
    camera_.camera = makeCamera(first.options().camera);
    urban_nav_store::Store store(path_, urban_nav_store::Access::Write);
    store.sessions().put(urban_nav_store::Session{kFirstDay, "first", "", "", 1, true});
    store.sessions().put(
        kFirstDay, urban_nav_store::Property{urban_nav_registration::kCalibrationProperty,
                                             urban_nav_registration::calibrationFingerprint(camera_.camera, Pose())});
    const urban_nav_registration::KeyframeExtractor extractor(camera_.camera, Parameters().registration.points);
    for (int i = 0; i < kDrivenFrames; ++i) {
      store.graph().put(kFirstDay, urban_nav_store::Node{first.stamp(i), first.T_world_camera(i)});
      store.keyframes().put(
          kFirstDay, kKeyframeCamera,
          urban_nav_registration::toStoredKeyframe(extractor.extract({"", first.stamp(i)}, first.frame(i).pair())));
    }
    store.commit();
  }
  void TearDown() override { urban_nav_store::removeStore(path_); }

  LiveLocaliser makeLocaliser() {
    urban_nav_store::Store store(path_, urban_nav_store::Access::Read);
    FrozenMap map(store);
    LiveLocaliser localiser(
        Parameters(), std::move(store), std::move(map), [] { return std::make_shared<SameTimeOfDay>(); },
        [this](const LocalizationEstimate& estimate, const std::optional<Pose>& T_map_odom) {
          published_.push_back(estimate);
          T_map_odom_ = T_map_odom;
        });
    localiser.setCamera(camera_);
    return localiser;
  }
  /// Pairs and odometry of all frames, without any time for queries.
  void drive(LiveLocaliser& localiser) {
    for (int i = 0; i < kDrivenFrames; ++i) {
      urban_nav_core::StereoPairWithMotion taken;
      taken.pair = second_.frame(i).pair();
      localiser.addPair(std::move(taken));
      localiser.addOdometry({second_.stamp(i), second_.T_world_camera(0).inverse() * second_.T_world_camera(i)});
      if (i == 0) continue;
      urban_nav_core::RelativePose step;
      step.from = second_.stamp(i - 1);
      step.to = second_.stamp(i);
      step.T_from_to = second_.T_world_camera(i - 1).inverse() * second_.T_world_camera(i);
      step.covariance = 1e-6 * urban_nav_core::Matrix6d::Identity();
      localiser.addStep(step);
    }
  }

  std::string path_;
  urban_nav_registration::MountedCamera camera_;
  RenderedSequence second_ = aroundTheRoom(1 + kNextDay, 2);
  std::vector<LocalizationEstimate> published_;
  std::optional<Pose> T_map_odom_;
};

TEST_F(LiveLocaliserTest, QueriesThatAreAnsweredAfterTheLastStepArePublished) {
  LiveLocaliser localiser = makeLocaliser();
  drive(localiser);
  ASSERT_EQ(published_.size(), kDrivenFrames - 1U) << "one for each step";
  EXPECT_EQ(published_.back().reason, LocalizationReason::NoMatch);
  while (localiser.work()) {
  }
  EXPECT_EQ(published_.back().state, LocalizationState::Localized) << published_.back().sentence;
  EXPECT_EQ(published_.back().stamp, second_.stamp(kDrivenFrames - 1));
  EXPECT_EQ(published_.back().supporting_matches, localiser.state().estimate.supporting_matches);
  ASSERT_TRUE(T_map_odom_);
  EXPECT_LT(distanceBetween(*T_map_odom_, second_.T_world_camera(0)), 0.1);
  const std::size_t count = published_.size();
  EXPECT_FALSE(localiser.work());
  EXPECT_EQ(published_.size(), count) << "nothing has changed";
}

TEST_F(LiveLocaliserTest, AnInitialPoseAndARestartArePublishedAtOnce) {
  LiveLocaliser localiser = makeLocaliser();
  drive(localiser);
  localiser.addInitialPose({0, {Pose(), urban_nav_core::Matrix6d::Identity()}});
  EXPECT_EQ(published_.back().reason, LocalizationReason::InitialPoseOnly);
  EXPECT_EQ(published_.back().stamp, second_.stamp(kDrivenFrames - 1));
  localiser.restart();
  EXPECT_EQ(published_.back().state, LocalizationState::Uncertain);
  EXPECT_FALSE(published_.back().T_map_base);
  EXPECT_EQ(published_.back().stamp, second_.stamp(kDrivenFrames - 1));
}

}  // namespace
}  // namespace urban_nav_localization
