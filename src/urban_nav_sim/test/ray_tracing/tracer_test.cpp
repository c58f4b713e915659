// SPDX-License-Identifier: BSD-3-Clause
#include "ray_tracing/tracer.hpp"

#include <gtest/gtest.h>

#include "ray_tracing/small_worlds.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {
namespace {

using Eigen::Vector3f;

Packet one(const Vector3f& origin, const Vector3f& direction, float time = 0.0F) {
  Packet packet{};
  packet.setOrigin(0, origin);
  packet.setDirection(0, direction);
  packet.far[0] = 1000.0F;
  packet.time[0] = time;
  packet.active = 1;
  return packet;
}

TEST(Tracer, MeetsTheNearestSurface) {
  const World world = yard();
  const Tracer tracer(world);
  const Snapshot snapshot(tracer, 3.0, 3.0);  // the box is aside
  const Packet packet = one({0, 0, 1}, {2, 0, 0});
  Hits hits;
  snapshot.closest(packet, hits);
  ASSERT_NE(hits.facet[0], kNothing);
  EXPECT_EQ(hits.mover[0], kNothing);
  const SurfacePoint point = snapshot.surfaceAt(hits, 0, packet, Vector3f(0, -0.02F, 0), Vector3f(0, 0, -0.01F));
  EXPECT_NEAR(point.distance, 3.0, 1e-7);  // in lengths of the direction
  EXPECT_TRUE(point.normal.isApprox(Vector3f(-1, 0, 0), 1e-6F));
  EXPECT_EQ(point.surface_class, world.materials[kWall].surface_class);
  EXPECT_NEAR(point.spot.at.x(), 20.0F, 1e-4F);
  EXPECT_NEAR(point.spot.at.y(), 1.0F, 1e-4F);
  EXPECT_NEAR(point.spot.per_u.x(), 0.06F, 1e-5F);
  EXPECT_NEAR(point.spot.per_v.y(), -0.03F, 1e-5F);
}

TEST(Tracer, FootprintOnSlantedSurfacesMatchesNeighbouringRays) {
  const World world = yard();
  const Tracer tracer(world);
  const Snapshot snapshot(tracer, 3.0, 3.0);
  const Vector3f direction(0.3F, 0.8F, 0.1F), right(1e-3F, -4e-4F, 0), down(1e-4F, 2e-4F, -1e-3F);
  const auto at = [&](const Vector3f& d) {
    const Packet packet = one({0, 0, 1}, d);
    Hits hits;
    snapshot.closest(packet, hits);
    return snapshot.surfaceAt(hits, 0, packet, right, down).spot;
  };
  const MaterialSample spot = at(direction);
  EXPECT_LT((0.5F * (at(direction + right).at - at(direction - right).at) - spot.per_u).norm(), 1e-4F * 5);
  EXPECT_LT((0.5F * (at(direction + down).at - at(direction - down).at) - spot.per_v).norm(), 1e-4F * 5);
}

TEST(Tracer, AMoverMayTurnAboutOnTheSpot) {
  World world = yard();
  world.movers.resize(1);
  for (int axis = 0; axis < 3; ++axis) {
    world.movers[0].T_world_mover = [axis](double t) {
      const Eigen::Vector3d half_turn = M_PI * Eigen::Vector3d::Unit(axis);
      return urban_nav_core::Pose(t > 0.4 ? urban_nav_core::expSo3(half_turn) : Eigen::Quaterniond::Identity(),
                                  {3.0, 0.0, 0.0});
    };
    const Tracer tracer(world);
    const Snapshot snapshot(tracer, 0.0, 1.0);
    for (const float time : {0.0F, 0.25F, 0.5F, 0.75F, 1.0F}) {
      const Packet packet = one({0, 0, 1}, {1, 0, 0}, time);
      Hits hits;
      snapshot.closest(packet, hits);
      EXPECT_EQ(hits.mover[0], 0U);
      EXPECT_NEAR(hits.distance[0], 3.0F, 1e-5F);
      EXPECT_EQ(snapshot.occluded(packet), 1U);
    }
  }
}

TEST(Tracer, MoversAreWhereTheyAreAtTheTimeOfTheRay) {
  const World world = yard();
  const Tracer tracer(world);
  const Snapshot lasting(tracer, 0.0, 2.0);  // the box goes from y = 0 to y = 2
  for (const float time : {0.0F, 0.5F, 1.0F}) {
    const Packet packet = one({0, 2.0F * time, 1}, {1, 0, 0}, time);
    Hits hits;
    lasting.closest(packet, hits);
    ASSERT_EQ(hits.mover[0], 0U) << time;
    const SurfacePoint point = lasting.surfaceAt(hits, 0, packet, Vector3f::Zero(), Vector3f::Zero());
    EXPECT_NEAR(point.distance, 4.0, 1e-6);
    EXPECT_NEAR(point.spot.at.x(), 0.5F, 1e-5F);  // always its middle
    EXPECT_NEAR(point.position.y(), 2.0F * time, 1e-5F);
  }
  Hits hits;
  lasting.closest(one({0, 0, 1}, {1, 0, 0}, 1.0F), hits);
  EXPECT_EQ(hits.mover[0], kNothing);  // it has gone
}

TEST(Tracer, LeavesHaveHolesForRaysAndForShadows) {
  World world = emptyWorld();
  world.parts.push_back(quad(kLeaves, {5, 2, 0}, {0, -4, 0}, {0, 0, 4}));
  const Tracer tracer(world);
  const Snapshot snapshot(tracer, 0.0, 0.0);
  int met = 0, count = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3f target(5.0F, 1.9F - 3.8F * static_cast<float>(i % 50) / 50.0F,
                          0.1F + 3.8F * static_cast<float>(i) / 2000.0F);
    const Packet packet = one(Vector3f::Zero(), target);
    Hits hits;
    snapshot.closest(packet, hits);
    const bool is_there =
        isThere(world.materials[kLeaves], {2.0F - target.y(), target.z()}, world.parts[0].seed, world.day.leaves);
    met += hits.facet[0] != kNothing;
    count += (hits.facet[0] != kNothing) == is_there;
    EXPECT_EQ(snapshot.occluded(packet) == 1U, hits.facet[0] != kNothing);
  }
  EXPECT_GT(met, 100);
  EXPECT_LT(met, 1900);
  EXPECT_GT(count, 1980);  // the very rims of leaves may fall either way
}

TEST(Tracer, RefusesTrianglesOfNothing) {
  World world = emptyWorld();
  world.parts.push_back(quad(kWall, {5, 2, 0}, {0, -4, 0}, {0, 0, 4}));
  world.parts[0].triangles[1][2] = 99;
  EXPECT_THROW(Tracer{world}, urban_nav_core::UserError);
  world.parts[0].triangles[1][2] = 3;
  world.parts[0].material = 77;
  EXPECT_THROW(Tracer{world}, urban_nav_core::UserError);
}

TEST(Tracer, AnEmptyWorldIsSky) {
  const World world = emptyWorld();
  const Tracer tracer(world);
  const Snapshot snapshot(tracer, 0.0, 0.0);
  Hits hits;
  snapshot.closest(one({0, 0, 1}, {1, 0, 0}), hits);
  EXPECT_EQ(hits.facet[0], kNothing);
}

}  // namespace
}  // namespace urban_nav_sim
