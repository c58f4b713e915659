// SPDX-License-Identifier: BSD-3-Clause
#include "topics/trust/place_visits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace urban_nav {
namespace {

using urban_nav_core::PointCloud;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;

/// A robot that drives 12 m along x between walls at y = -4 and 4, with alcoves of 1.5 m every 4 m, seen with noise of
/// 2 cm. `truck`: a flat side of 2 m at y = 2.
PointCloud street(unsigned seed, bool truck = false) {
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(0.0F, 0.02F);
  PointCloud cloud;
  for (int scan = 0; scan < 120; ++scan) {
    const Eigen::Vector3f origin(-6.0F + 0.1F * static_cast<float>(scan), 0.0F, 1.0F);
    for (int beam = 0; beam < 90; ++beam)
      for (const float slope : {-0.1F, 0.0F, 0.1F, 0.2F}) {
        const float angle = static_cast<float>(M_PI) / 45.0F * static_cast<float>(beam);
        const Eigen::Vector3f along = Eigen::Vector3f(std::cos(angle), std::sin(angle), slope).normalized();
        if (std::abs(along.y()) < 0.3F) continue;
        const float side = along.y() > 0.0F ? 1.0F : -1.0F;
        float range = 4.0F / std::abs(along.y());
        const float x = origin.x() + range * along.x();
        if (std::fmod(x + 40.0F, 4.0F) < 1.5F) range = 5.0F / std::abs(along.y());
        if (truck && side > 0.0F && std::abs(origin.x() + 2.0F / along.y() * along.x()) < 1.0F)
          range = 2.0F / along.y();
        cloud.points.push_back(origin + (range + noise(random)) * along);
        cloud.origins.push_back(origin);
      }
  }
  return cloud;
}

TEST(PlaceVisits, WallsOfASoundMapAreConfirmed) {
  const urban_nav_trust::PlaceVisits same = compareVisits(street(1), street(2), Pose());
  EXPECT_GT(same.confirmed, 100.0);
  EXPECT_LT(same.share(), 0.02);
  const Pose near(Eigen::Quaterniond::Identity(), {0.1, -0.1, 0.0});
  EXPECT_LT(compareVisits(street(1), street(2), near).share(), 0.05);
}

TEST(PlaceVisits, BeamsPassThroughWallsOfAVisitThatIsPlacedWrongly) {
  const Pose aside(Eigen::Quaterniond::Identity(), {0.0, 2.0, 0.0});
  EXPECT_GT(compareVisits(street(1), street(2), aside).share(), 0.4);
  const Pose turned(Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ())), {0.0, 0.0, 0.0});
  EXPECT_GT(compareVisits(street(1), street(2), turned).share(), 0.3);
}

TEST(PlaceVisits, SomethingThatHasGoneContradictsLittle) {
  const urban_nav_trust::PlaceVisits gone = compareVisits(street(1, true), street(2), Pose());
  EXPECT_LT(gone.share(), 0.3);
  EXPECT_GT(gone.confirmed, 100.0);
}

TEST(PlaceVisits, NothingIsCountedWithoutPoints) {
  const urban_nav_trust::PlaceVisits none = compareVisits({}, street(1), Pose());
  EXPECT_EQ(none.confirmed + none.contradicted, 0.0);
}

/// Straight forth and back along x at 1 m/s.
urban_nav_core::Trajectory forthAndBack(double length) {
  urban_nav_core::Trajectory path;
  for (int i = 0; i <= static_cast<int>(20.0 * length); ++i) {
    const double s = 0.1 * i;
    path.append(static_cast<StampNs>(1e8 * i),
                Pose(Eigen::Quaterniond::Identity(), {s < length ? s : 2.0 * length - s, 0.0, 0.0}));
  }
  return path;
}

TEST(PlaceVisits, AreFoundWhereThePathComesBack) {
  EXPECT_TRUE(findVisits({}).empty());
  EXPECT_TRUE(findVisits(forthAndBack(10.0)).empty());
  const urban_nav_core::Trajectory path = forthAndBack(60.0);
  const std::vector<VisitPair> pairs = findVisits(path);
  ASSERT_GE(pairs.size(), 3U);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_LT((path[path.nearest(pairs[i].earlier)].pose.t() - path[path.nearest(pairs[i].later)].pose.t()).norm(),
              3.0);
    EXPECT_GT(pairs[i].later - pairs[i].earlier, 20'000'000'000);
    if (i > 0) {
      EXPECT_GT(pairs[i].later - pairs[i - 1].later, 12'000'000'000 - 1);
    }
  }
  EXPECT_LE(findVisits(forthAndBack(500.0)).size(), 12U);
}

}  // namespace
}  // namespace urban_nav
