// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/map_viewer.hpp"

#include <gtest/gtest.h>

namespace urban_nav {
namespace {

std::vector<laser_mapper::MapPoint> viewerPoints(std::size_t count) {
  std::vector<laser_mapper::MapPoint> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    points[i].p = {static_cast<float>(i), 2.0F, -1.0F};
    points[i].stamp = 1'225'719'872'000'000'000 + static_cast<urban_nav_core::StampNs>(i) * 1'000'000;
  }
  return points;
}

TEST(MapViewer, HoldsPointsAndPathAndNeedsNothingOutside) {
  MapViewer viewer(3);
  viewer.add(viewerPoints(101));
  viewer.addPath({{0.0, 0.0, 0.0}, {1.25, 0.0, 0.0}});
  const std::string html = viewer.render();
  for (const char* words :
       {"id=\"map-view-3\"", "data-points=\"101\"", "data-low=\"0,2,-1\"", "data-high=\"100,2.001,-0.999\"",
        "data-paths=\"[[0,0,0,1.25,0,0]]\"", "data-seconds=\"0.1\"", "<canvas", "value=\"sigma\""})
    EXPECT_NE(html.find(words), std::string::npos) << words;
  for (const char* words : {"http", "src=", "fetch", "import"}) EXPECT_EQ(html.find(words), std::string::npos) << words;
  const std::size_t data = html.find("octet-stream\">") + 14;
  EXPECT_EQ(html.find("</script>") - data, (101U * 16 + 2) / 3 * 4) << "16 bytes a point in base 64";
}

TEST(MapViewer, ThinsLargeMapsEvenly) {
  MapViewer viewer(0);
  for (int part = 0; part < 6; ++part) viewer.add(viewerPoints(200'000));
  EXPECT_LE(viewer.points(), 500'000U);
  EXPECT_GE(viewer.points(), 250'000U);
}

TEST(MapViewer, IsEmptyWithoutPoints) { EXPECT_EQ(MapViewer(0).render(), ""); }

}  // namespace
}  // namespace urban_nav
