// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/tracks.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "urban_nav_core/camera/surface.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::expSo3;
using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;

StereoCamera tracksCamera() { return {{400.0, 410.0, 250.0, 190.0, 512, 384}, 0.2}; }

TEST(Tracks, IdsAreNeverReusedAndPlacesAre) {
  Tracks tracks(3);
  const LandmarkId a = tracks.start()->id, b = tracks.start()->id, c = tracks.start()->id;
  EXPECT_LT(a, b);
  EXPECT_LT(b, c);
  EXPECT_EQ(tracks.start(), nullptr);
  tracks.end(b);
  tracks.end(b);
  EXPECT_EQ(tracks.find(b), nullptr);
  const Track* fresh = tracks.start();
  ASSERT_NE(fresh, nullptr);
  EXPECT_GT(fresh->id, c);
  EXPECT_EQ(fresh->seen, 1);
  EXPECT_FALSE(fresh->left_ready);
  ASSERT_EQ(tracks.size(), 3);
  for (int i = 1; i < tracks.size(); ++i) EXPECT_LT(tracks.at(i - 1).id, tracks.at(i).id);
  EXPECT_EQ(tracks.find(a)->id, a);
  EXPECT_EQ(tracks.find(12345), nullptr);
}

/// Returns the projection into another view of a point of the surface seen at `pixel` in the first view.
Eigen::Vector2d through(Side side, const StereoCamera& c, const Eigen::Vector3d& plane, const Pose& T,
                        const Eigen::Vector2d& pixel) {
  const Eigen::Vector3d ray = c.left.ray(pixel);
  Eigen::Vector3d p = T * Eigen::Vector3d(ray / plane.dot(ray));
  if (side == Side::Right) p.x() -= c.baseline;
  return *c.left.project(p);
}

TEST(Tracks, WarpIsTheHomographyOfTheSurface) {
  const StereoCamera c = tracksCamera();
  Track track;
  const Eigen::Vector2d pixel(300.0, 250.0);
  track.ray = c.left.ray(pixel);
  track.plane = urban_nav_core::surfaceThrough(c, {300.0, 250.0, 290.0}, {0.05, 0.25});
  const Pose T(expSo3({0.03, -0.1, 0.2}), Eigen::Vector3d(0.3, -0.1, -2.0));
  for (const Side side : {Side::Left, Side::Right}) {
    const auto warp = warpInto(side, c, track, T, track.plane.dot(track.ray));
    ASSERT_TRUE(warp);
    Eigen::Matrix2d numeric;
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d d = 1e-4 * Eigen::Vector2d::Unit(k);
      numeric.col(k) =
          (through(side, c, track.plane, T, pixel + d) - through(side, c, track.plane, T, pixel - d)) / 2e-4;
    }
    EXPECT_LT((warp->A - numeric).cwiseAbs().maxCoeff(), 1e-6);
    const Eigen::Vector2d middle = through(side, c, track.plane, T, pixel);
    for (const Eigen::Vector2d& p : {Eigen::Vector2d(12, 0), Eigen::Vector2d(-7, 9), Eigen::Vector2d(0, -12)}) {
      const Eigen::Vector2d moved = through(side, c, track.plane, T, pixel + p) - middle;
      EXPECT_LT((moved - warp->A * p / (1.0 + warp->bend.dot(p))).norm(), 1e-9);
    }
  }
}

TEST(Tracks, SlantDirectionIsTheDerivativeOfTheWarp) {
  const StereoCamera c = tracksCamera();
  Track track;
  track.ray = c.left.ray({300.0, 250.0});
  track.plane = urban_nav_core::surfaceThrough(c, {300.0, 250.0, 290.0}, {0.05, 0.25});
  const Pose T(expSo3({0.03, -0.1, 0.2}), Eigen::Vector3d(0.3, -0.1, -2.0));
  const double inverse_depth = track.plane.dot(track.ray);
  const Eigen::Vector2d direction = slantDirection(c, track, T, inverse_depth);
  const Eigen::Matrix2d before = warpInto(Side::Left, c, track, T, inverse_depth)->A;
  const Eigen::Vector2d slant(1e-5, -2e-5);
  const Eigen::Vector2d change(slant.x(), slant.y() * c.left.fy / c.left.fx);
  track.plane += Eigen::Vector3d(change.x(), change.y(), -change.dot(track.ray.head<2>()));
  const Eigen::Matrix2d after = warpInto(Side::Left, c, track, T, inverse_depth)->A;
  EXPECT_LT((after - before - direction * slant.transpose()).norm(), 1e-9);
}

TEST(Tracks, WarpOfAPointAtInfinityTurnsOnly) {
  const StereoCamera c = tracksCamera();
  Track track;
  track.ray = Eigen::Vector3d::UnitZ();
  const Pose T(expSo3({0.0, 0.0, 0.3}), Eigen::Vector3d(5.0, 0.0, 3.0));
  const auto warp = warpInto(Side::Right, c, track, T, 0.0);
  ASSERT_TRUE(warp);
  EXPECT_NEAR(warp->A.determinant(), 1.0, 1e-12);
  EXPECT_EQ(warp->bend.norm(), 0.0);
  EXPECT_FALSE(warpInto(Side::Left, c, track, Pose(expSo3({0.0, 3.0, 0.0}), Eigen::Vector3d::Zero()), 0.0));
}

/// A patch with texture in both directions.
urban_nav_core::PatchSource texturedSource() {
  urban_nav_core::PatchSource source;
  for (std::size_t i = 0; i < source.pixels.size(); ++i)
    source.pixels[i] = static_cast<std::uint8_t>((i * i * 31 + i * 7) % 251);
  return source;
}

std::string archived(Track& track) {
  urban_nav_core::Archive archive;
  swf_vo::archive(archive, track);
  return archive.take();
}

TEST(Tracks, TemplatesAreArchivedByTheirWarps) {
  Track track;
  track.source = texturedSource();
  const std::size_t without = archived(track).size();
  Eigen::Matrix2d A;
  A << 1.1, 0.05, -0.02, 0.93;
  track.made_blur_right = {0.4, 0.2};
  track.left_ready = urban_nav_core::warpTemplate(track.source, {A, {0.001, 0.002}}, track.in_left);
  track.right_ready =
      urban_nav_core::warpTemplate(urban_nav_core::blurred(track.source, track.made_blur_right), A, track.in_right);
  ASSERT_TRUE(track.left_ready && track.right_ready);
  const std::string bytes = archived(track);
  EXPECT_LT(bytes.size(), without + sizeof(urban_nav_core::PatchGrid));
  Track read;
  urban_nav_core::Archive archive(bytes, "track");
  swf_vo::archive(archive, read);
  archive.finish();
  EXPECT_EQ(read.in_left.value, track.in_left.value);
  EXPECT_EQ(read.in_right.filter_x, track.in_right.filter_x);
  EXPECT_EQ(read.in_right.unit_covariance, track.in_right.unit_covariance);

  track.in_right.value.front() += 1.0F;  // one that the source does not give
  const std::string whole = archived(track);
  EXPECT_GT(whole.size(), bytes.size() + sizeof(urban_nav_core::PatchGrid));
  urban_nav_core::Archive again(whole, "track");
  swf_vo::archive(again, read);
  EXPECT_EQ(read.in_right.value, track.in_right.value);
}

}  // namespace
}  // namespace swf_vo
