// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/map_picture.hpp"

#include <gtest/gtest.h>

#include <array>

namespace laser_mapper {
namespace {

using urban_nav_core::Vector3d;

const std::vector<Vector3d> kSquarePath = {{0.0, 0.0, 0.0}, {10.0, 0.0, 0.0}, {10.0, 10.0, 0.0}};

MapPoint grey(float x, float y, float z, std::uint8_t value) {
  MapPoint point;
  point.p = {x, y, z};
  point.red = point.green = point.blue = value;
  return point;
}

int valueAt(const urban_nav_registration::Picture& picture, int u, int v) {
  return picture.bgr[3 * static_cast<std::size_t>(v * picture.width + u)];
}

TEST(MapPicture, FromAboveNorthIsUpAndTheHighestPointIsShown) {
  const MapView view = viewFromAbove(kSquarePath, 5.0, 400);
  EXPECT_EQ(view.width, 400);
  EXPECT_EQ(view.height, 400);
  MapPicture picture(view);
  picture.draw({grey(-2.0F, 12.0F, 0.0F, 200), grey(-2.0F, 12.0F, 3.0F, 20), grey(-2.0F, 12.0F, 1.0F, 100)});
  const auto made = picture.finish();
  EXPECT_EQ(valueAt(made, 60, 60), 16) << "20, lit by 0.8";
  EXPECT_EQ(valueAt(made, 300, 300), 250) << "paper";
}

TEST(MapPicture, IsTransparentWhereNothingWasDrawn) {
  MapPicture picture(viewFromAbove(kSquarePath, 5.0, 400));
  MapPoint point = grey(-2.0F, 12.0F, 0.0F, 0);
  point.red = 200;
  point.green = 100;
  picture.draw({point});
  const std::vector<std::uint8_t> rgba = picture.finishRgba({50, 50, 20, 30});
  ASSERT_EQ(rgba.size(), 4U * 20U * 30U);
  for (std::size_t i = 0; i < 20U * 30U; ++i) {
    const std::array<int, 4> found{rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2], rgba[4 * i + 3]};
    const std::array<int, 4> expected = i == 10 * 20 + 10 ? std::array<int, 4>{160, 80, 0, 255} : std::array<int, 4>{};
    EXPECT_EQ(found, expected) << i;
  }
}

TEST(MapPicture, DoesNotDependOnTheOrderOfPoints) {
  std::vector<MapPoint> points;
  for (int i = 0; i < 500; ++i)
    points.push_back(grey(0.02F * static_cast<float>(i % 37), 0.03F * static_cast<float>(i % 41),
                          0.001F * static_cast<float>(i), static_cast<std::uint8_t>(i % 256)));
  for (const MapView& view : {viewFromAbove(kSquarePath, 5.0, 300), viewInPerspective(kSquarePath, 300, 200)}) {
    MapPicture forwards(view), backwards(view);
    forwards.draw(points);
    backwards.draw({points.rbegin(), points.rend()});
    EXPECT_EQ(forwards.finish().bgr, backwards.finish().bgr);
  }
}

TEST(MapPicture, PerspectiveShowsThePath) {
  MapPicture picture(viewInPerspective(kSquarePath, 300, 200));
  picture.drawPath(kSquarePath);
  const auto made = picture.finish();
  int red = 0;
  for (std::size_t i = 0; i < made.bgr.size(); i += 3) red += made.bgr[i] < 100 && made.bgr[i + 2] > 200 ? 1 : 0;
  EXPECT_GT(red, 50);
}

TEST(MapPicture, AnEmptyMapIsPaper) {
  const auto made = MapPicture(viewFromAbove({}, 5.0, 100)).finish();
  for (const std::uint8_t value : made.bgr) ASSERT_EQ(value, 250);
}

TEST(MapPicture, IsCutToPathAndPointsButForFewFarOnes) {
  std::vector<MapPoint> points;
  for (int i = 0; i < 10000; ++i)
    points.push_back(
        grey(2.0F + 0.05F * static_cast<float>(i % 100), 1.0F + 0.05F * static_cast<float>(i / 100), 0, 9));
  points.push_back(grey(-20.0F, 5.0F, 0.0F, 9));
  MapPicture picture(viewFromAbove(kSquarePath, 40.0, 1000));  // a point about a pixel
  picture.draw(points);
  picture.drawPath(kSquarePath);
  const PictureBox box = picture.shownBox();
  EXPECT_NEAR(box.width, 10.0 * 1000 / 90 + 24, 4) << "the path, and an edge of 12 px";
  EXPECT_NEAR(box.height, 10.0 * 1000 / 90 + 24, 4);
  EXPECT_NEAR(box.u0, 40.0 * 1000 / 90 - 12, 3);
  const auto made = picture.finish(box);
  EXPECT_EQ(made.width, box.width);
  EXPECT_EQ(made.bgr.size(), 3U * static_cast<std::size_t>(box.width * box.height));
  const auto whole = picture.finish();
  EXPECT_EQ(valueAt(made, 20, 30), valueAt(whole, box.u0 + 20, box.v0 + 30));
}

TEST(MapPicture, AnEmptyMapIsShownWhole) {
  const PictureBox box = MapPicture(viewFromAbove({}, 5.0, 100)).shownBox();
  EXPECT_EQ(box.width, 100);
  EXPECT_EQ(box.height, 100);
}

}  // namespace
}  // namespace laser_mapper
