// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_localization/map_search.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>

#include "urban_nav_core/testing/motion.hpp"
#include "urban_nav_core/testing/textured_street.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/session/calibration_fingerprint.hpp"
#include "urban_nav_registration/session/stored_keyframe.hpp"
#include "urban_nav_registration/testing/photographer.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_localization {
namespace {

using urban_nav_core::DataError;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::testing::lookingAlong;
using urban_nav_registration::calibrationFingerprint;
using urban_nav_registration::kCalibrationProperty;
using urban_nav_registration::Keyframe;
using urban_nav_registration::kKeyframeCamera;
using urban_nav_registration::toStoredKeyframe;
using urban_nav_store::Access;
using urban_nav_store::Store;

constexpr StampNs kSecond = 1'000'000'000;

/// Finds what the test expects to be found.
class GivenRetrieval final : public urban_nav_registration::KeyframeRetrieval {
 public:
  void open(Store&, std::vector<urban_nav_registration::SearchedKeyframe> given) override { keyframes = given; }
  std::size_t read() const override { return read_; }
  bool readNext() override { return ++read_ < keyframes.size(); }
  std::vector<std::size_t> find(const Keyframe&, std::size_t most) const override {
    ++queries;
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < keyframes.size() && found.size() < most; ++i)
      if (std::abs(keyframes[i].at.stamp - wanted) <= kSecond) found.push_back(i);
    return found;
  }

  std::vector<urban_nav_registration::SearchedKeyframe> keyframes;
  StampNs wanted = 0;  ///< of the keyframe of the map that shows where the robot is
  mutable int queries = 0;

 private:
  std::size_t read_ = 0;
};

/// A street that was driven at a metre a second, with a view each metre; base_link is the left camera.
class MapSearchTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("map_search_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    store_.emplace((folder_ / "store.db").string(), Access::Write);
    store_->sessions().put(urban_nav_store::Session{id_, "day", "", "", 0, true});
    store_->sessions().put(id_, urban_nav_store::Property{kCalibrationProperty, words()});
  }
  void TearDown() override {
    store_.reset();
    std::filesystem::remove_all(folder_);
  }
  std::string words() const { return calibrationFingerprint(street_.camera(), Pose()); }
  static Pose place(double x, double y = 0.0) { return lookingAlong({4.0 + x, y, 1.2}, 0.0); }
  void drive(int metres) {
    for (int i = 0; i <= metres; ++i) {
      store_->graph().put(id_, urban_nav_store::Node{i * kSecond, place(i)});
      Keyframe view = street_.keyframe(place(i));
      view.at.stamp = i * kSecond;
      store_->keyframes().put(id_, kKeyframeCamera, toStoredKeyframe(view));
    }
    store_->commit();
  }
  /// Returns keyframe i of another day, 0.3 m to the side, and adds the odometry up to it.
  Keyframe visit(int i, double carried = 0.0) {
    if (i > 0) {
      urban_nav_core::RelativePose step;
      step.from = (i - 1) * kSecond;
      step.to = i * kSecond;
      step.T_from_to = place(i - 1, 0.3).inverse() * place(i, 0.3);
      step.covariance *= 1e-6;
      EXPECT_TRUE(localiser_.addOdometry(step));
    }
    retrieval_->wanted = static_cast<StampNs>((i + carried) * static_cast<double>(kSecond));
    Keyframe view = street_.keyframe(place(i + carried, 0.3), 0.8);
    view.at.stamp = i * kSecond;
    return view;
  }

  urban_nav_registration::testing::Photographer street_{urban_nav_core::testing::texturedStreet()};
  const std::string id_ = "0123456789abcdef0123";
  std::filesystem::path folder_;
  std::optional<Store> store_;
  std::shared_ptr<GivenRetrieval> retrieval_ = std::make_shared<GivenRetrieval>();
  Localiser localiser_{Parameters()};
};

TEST_F(MapSearchTest, FindsTheRobotWhateverTheInitialPose) {
  drive(12);
  const FrozenMap map(*store_);
  ASSERT_EQ(map.sessions().size(), 1U);
  EXPECT_EQ(map.sessions()[0].T_map_base.size(), 13U);
  EXPECT_EQ(map.findKeyframes({street_.camera(), Pose()}).size(), 13U);
  MapSearch search(Parameters(), map, *store_, {street_.camera(), Pose()}, retrieval_);
  EXPECT_EQ(search.read(), 0U);
  while (search.readNext()) {
  }
  EXPECT_EQ(search.read(), search.views());
  EXPECT_LT(search.views(), 13U) << "those that are near to another one are found by it";
  visit(0);
  const Keyframe first = visit(1);
  localiser_.addInitialPose(kSecond, {place(11), 0.01 * urban_nav_core::Matrix6d::Identity()});
  EXPECT_TRUE(search.query(first, localiser_)) << "there is nothing of it where it was assumed to be";
  EXPECT_EQ(localiser_.now().reason, LocalizationReason::SingleMatch);
  EXPECT_TRUE(search.query(visit(2), localiser_));
  EXPECT_EQ(localiser_.now().state, LocalizationState::Localized) << localiser_.now().sentence;
  EXPECT_TRUE(search.query(visit(3), localiser_));
  ASSERT_TRUE(localiser_.now().T_map_base);
  EXPECT_LT(distanceBetween(localiser_.now().T_map_base->pose, place(3, 0.3)), 0.05);
}

TEST_F(MapSearchTest, FindsARobotThatWasCarriedWhileItWasKnown) {
  drive(20);
  const FrozenMap map(*store_);
  MapSearch search(Parameters(), map, *store_, {street_.camera(), Pose()}, retrieval_);
  while (search.readNext()) {
  }
  visit(0);
  for (int i = 1; i <= 4; ++i) EXPECT_TRUE(search.query(visit(i), localiser_));
  ASSERT_EQ(localiser_.now().state, LocalizationState::Localized);
  const int asked = retrieval_->queries;
  EXPECT_LE(asked, 2) << "near a known pose nothing is searched for";
  for (int i = 5; i <= 7; ++i) EXPECT_TRUE(search.query(visit(i, 10.0), localiser_)) << i;
  EXPECT_EQ(localiser_.now().state, LocalizationState::Localized) << localiser_.now().sentence;
  EXPECT_LT(distanceBetween(localiser_.now().T_map_base->pose, place(17, 0.3)), 0.05);
}

TEST_F(MapSearchTest, AnInvalidKeyframeIsAFailedComparison) {
  drive(1);
  const FrozenMap map(*store_);
  MapSearch search(Parameters(), map, *store_, {street_.camera(), Pose()}, retrieval_);
  while (search.readNext()) {
  }
  visit(0);
  visit(1);
  Keyframe nothing;
  nothing.at.stamp = kSecond;
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(search.query(nothing, localiser_));
  EXPECT_EQ(localiser_.now().state, LocalizationState::Unmapped);
}

TEST_F(MapSearchTest, AStoreWithoutSessionViewsOrCameraIsNamed) {
  EXPECT_THROW(FrozenMap{*store_}, DataError) << "neither views nor beams";
  drive(1);
  store_->sessions().put(id_, urban_nav_store::Property{kCalibrationProperty, "640x480 1 2 3"});
  const FrozenMap map(*store_);
  try {
    map.findKeyframes({street_.camera(), Pose()});
    FAIL();
  } catch (const DataError& error) {
    EXPECT_NE(std::string(error.what()).find("store.db"), std::string::npos);
  }
  Store empty((folder_ / "empty.db").string(), Access::Write);
  EXPECT_THROW(FrozenMap{empty}, DataError) << "no session";
}

}  // namespace
}  // namespace urban_nav_localization
