// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/quality/plane_search.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>

#include "support/room_rounds.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace laser_mapper {
namespace {

using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector3d;
using urban_nav_core::Vector6d;
using urban_nav_store::Store;

constexpr const char* kSearchSession = "0123456789abcdef0123";
class PlaneSearch : public ::testing::Test {
 protected:
  PlaneSearch() {
    urban_nav_store::removeStore(path_);
    store_ = std::make_unique<Store>(path_, urban_nav_store::Access::Write);
    store_->sessions().put(urban_nav_store::Session{kSearchSession, "room", "", "", 1, true});
    store_->sessions().put(kSearchSession, urban_nav_store::Extrinsic{"laser_right", testing_room::outwardLaser()});
    std::mt19937 random(7);
    for (StampNs stamp = truth_.front().stamp; stamp < truth_.back().stamp - 20'000'000; stamp += 40'000'000)
      store_->scans().put(kSearchSession, "laser_right",
                          testing_room::scanRoom(truth_, testing_room::outwardLaser(), stamp, 0.005, random));
    store_->commit();
  }
  ~PlaneSearch() override {
    store_.reset();
    urban_nav_store::removeStore(path_);
  }
  std::vector<PlaneConstraint> search(const Trajectory& T_map_base) {
    return searchPlaneConstraints({}, *store_, {{kSearchSession, &T_map_base, nullptr}}, {nullptr}, path_ + ".planes");
  }
  Pose trueRelative(const PlaneConstraint& constraint) const {
    return truth_[truth_.nearest(constraint.stamp_a)].pose.inverse() * truth_[truth_.nearest(constraint.stamp_b)].pose;
  }

  const std::string path_ = ::testing::TempDir() + "plane_search_test.db";
  const Trajectory truth_ = testing_room::driveRounds();
  std::unique_ptr<Store> store_;
};

TEST_F(PlaneSearch, FindsTheDriftBetweenRoundsByTheirWalls) {
  const Trajectory mapped = testing_room::driftFrom(truth_, 0.12);
  const auto constraints = search(mapped);
  ASSERT_GT(constraints.size(), 4U);
  double before = 0.0, after = 0.0, information = 0.0;
  for (const PlaneConstraint& constraint : constraints) {
    EXPECT_GT(urban_nav_core::secondsBetween(constraint.stamp_a, constraint.stamp_b), 20.0);
    const Matrix6d& weight = constraint.measured.information;
    const auto squared = [&](const Pose& T_a_b) {
      const Vector6d error = urban_nav_core::boxMinus(T_a_b, trueRelative(constraint));
      return error.dot(weight * error);
    };
    const Pose by_map =
        mapped[mapped.nearest(constraint.stamp_a)].pose.inverse() * mapped[mapped.nearest(constraint.stamp_b)].pose;
    before += squared(by_map);
    after += squared(constraint.measured.T_a_b);
    information += weight.topLeftCorner<3, 3>().trace();
  }
  const auto count = static_cast<double>(constraints.size());
  EXPECT_GT(before / count, 100.0) << "the drift is many standard deviations";
  // Rank 6 at most; the drift within the 4 s of a stretch, about 6 mm and 0.3 mrad here, is not included in the
  // variances.
  EXPECT_LT(after / count, 9.0);
  EXPECT_GT(information / count, 1.0 / (0.01 * 0.01)) << "1 cm and better";
}

TEST_F(PlaneSearch, LeavesTheStoreAndTheFolderAsTheyWere) {
  ASSERT_FALSE(search(truth_).empty());
  EXPECT_TRUE(store_->states().stages(kSearchSession).empty());
  LaserMap map({}, *store_, {{kSearchSession, &truth_, nullptr}});
  map.load();
  EXPECT_EQ(map.tileCount(), 0U) << "no chunk was rendered into it";
  EXPECT_FALSE(std::filesystem::exists(path_ + ".planes"));
}

TEST_F(PlaneSearch, ThreadsChangeNothing) {
  const Trajectory mapped = testing_room::driftFrom(truth_, 0.05);
  std::vector<std::vector<PlaneConstraint>> found;
  for (const int threads : {1, 3}) {
    const urban_nav_core::ThreadLimit limit(threads);
    found.push_back(search(mapped));
  }
  ASSERT_EQ(found[0].size(), found[1].size());
  for (std::size_t i = 0; i < found[0].size(); ++i) {
    EXPECT_EQ(found[0][i].measured.T_a_b.t(), found[1][i].measured.T_a_b.t());
    EXPECT_EQ(found[0][i].measured.information, found[1][i].measured.information);
  }
}

TEST_F(PlaneSearch, OnePassHasNothingToCompare) {
  Trajectory first;
  for (std::size_t i = 0; i < 600; ++i) first.append(truth_[i].stamp, truth_[i].pose);  // 36 m
  EXPECT_TRUE(search(first).empty());
}

}  // namespace
}  // namespace laser_mapper
