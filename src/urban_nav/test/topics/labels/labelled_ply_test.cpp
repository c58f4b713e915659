// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/labelled_ply.hpp"

#include <gtest/gtest.h>

#include "laser_mapper/map_files.hpp"
#include "urban_nav_core/io/cloud/cloud_columns.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using scene_labeler::PointLabel;
using scene_labeler::SceneClass;

void writeMap(const std::string& path, std::size_t points) {
  urban_nav_core::PlyWriter writer(path, laser_mapper::mapLayout());
  for (std::size_t i = 0; i < points; ++i) {
    laser_mapper::MapPoint point;
    point.p.x() = static_cast<float>(i);
    point.intensity = 77;
    std::string bytes;
    appendVertex(bytes, point);
    writer.append(bytes);
  }
  writer.commit();
}

TEST(LabelledPly, AddsColumnsAndKeepsTheOthers) {
  const urban_nav_input::testing::TemporaryFolder folder;
  writeMap(folder.file("map.ply"), 3);
  addLabelsToPly(folder.file("map.ply"),
                 {{SceneClass::Grass, 255, false}, {SceneClass::None, 0, true}, {SceneClass::Vehicle, 51, true}});
  const auto columns = urban_nav_core::readCloudColumns(folder.file("map.ply"),
                                                        {"x", "intensity", "label", "label_probability", "unsure"});
  ASSERT_TRUE(columns[0] && columns[1] && columns[2] && columns[3] && columns[4]);
  EXPECT_EQ(*columns[0], (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(*columns[1], (std::vector<double>{77, 77, 77}));
  EXPECT_EQ(*columns[2], (std::vector<double>{1, 255, 7}));
  EXPECT_NEAR((*columns[3])[0], 1.0, 1e-6);
  EXPECT_NEAR((*columns[3])[2], 0.2, 1e-6);
  EXPECT_EQ(*columns[4], (std::vector<double>{0, 1, 1}));
}

TEST(LabelledPly, RefusesAnotherMap) {
  const urban_nav_input::testing::TemporaryFolder folder;
  writeMap(folder.file("map.ply"), 3);
  const std::string before = urban_nav_input::testing::readFile(folder.file("map.ply"));
  EXPECT_THROW(addLabelsToPly(folder.file("map.ply"), std::vector<PointLabel>(4)), urban_nav_core::DataError);
  EXPECT_EQ(urban_nav_input::testing::readFile(folder.file("map.ply")), before);
}

}  // namespace
}  // namespace urban_nav
