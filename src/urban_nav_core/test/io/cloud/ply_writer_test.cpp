// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/cloud/ply_writer.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "urban_nav_core/io/cloud/cloud_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

PlyLayout colouredPoints() {
  return {{{"x", PlyType::Float}, {"y", PlyType::Float}, {"z", PlyType::Float}, {"red", PlyType::UChar}},
          {"frame map, m"}};
}

std::string colouredPoint(float x) {
  std::string bytes;
  for (const float value : {x, 2.0F, 3.0F}) appendLittleEndian(bytes, value);
  appendLittleEndian(bytes, std::uint8_t{7});
  return bytes;
}

std::string plyTestPath() { return ::testing::TempDir() + "ply_writer_test.ply"; }

TEST(PlyWriter, ReadsBackWhatItWrote) {
  for (const int count : {0, 1, 12345}) {
    PlyWriter writer(plyTestPath(), colouredPoints());
    for (int i = 0; i < count; ++i) writer.append(colouredPoint(static_cast<float>(i % 100)));
    writer.commit();
    const PointCloud cloud = readCloud(plyTestPath()).cloud;
    ASSERT_EQ(cloud.points.size(), static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
      EXPECT_EQ(cloud.points[static_cast<std::size_t>(i)], Eigen::Vector3f(static_cast<float>(i % 100), 2.0F, 3.0F));
  }
}

TEST(PlyWriter, HeaderNamesPropertiesAndComments) {
  EXPECT_EQ(plyHeader(colouredPoints(), 3),
            "ply\nformat binary_little_endian 1.0\ncomment frame map, m\nelement vertex 3\nproperty float x\nproperty "
            "float y\nproperty float z\nproperty uchar red\nend_header\n");
  EXPECT_EQ(colouredPoints().vertexBytes(), 13U);
}

TEST(PlyWriter, LeavesNoFileWithoutCommit) {
  std::filesystem::remove(plyTestPath());
  {
    PlyWriter writer(plyTestPath(), colouredPoints());
    writer.append(colouredPoint(1.0F));
  }
  EXPECT_FALSE(std::filesystem::exists(plyTestPath()));
}

TEST(PlyWriter, RefusesAPathThatCannotBeWritten) {
  EXPECT_THROW(PlyWriter("/nonexistent/folder/map.ply", colouredPoints()), UserError);
}

}  // namespace
}  // namespace urban_nav_core
