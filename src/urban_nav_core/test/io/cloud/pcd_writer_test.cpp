// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/cloud/pcd_writer.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "urban_nav_core/io/cloud/cloud_file.hpp"
#include "urban_nav_core/io/cloud/ply_writer.hpp"

namespace urban_nav_core {
namespace {

std::string pcdTestPath() { return ::testing::TempDir() + "pcd_writer_test.pcd"; }

TEST(PcdWriter, ReadsBackWhatItWrote) {
  for (const int count : {0, 1, 4321}) {
    PcdWriter writer(pcdTestPath(), {{"x"}, {"y"}, {"label", 1, 'U'}, {"z"}});
    for (int i = 0; i < count; ++i) {
      std::string bytes;
      appendLittleEndian(bytes, static_cast<float>(i % 100));
      appendLittleEndian(bytes, 0.25F);
      appendLittleEndian(bytes, std::uint8_t{9});
      appendLittleEndian(bytes, -1.5F);
      writer.append(bytes);
    }
    writer.commit();
    const PointCloud cloud = readCloud(pcdTestPath()).cloud;
    ASSERT_EQ(cloud.points.size(), static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
      EXPECT_EQ(cloud.points[static_cast<std::size_t>(i)], Eigen::Vector3f(static_cast<float>(i % 100), 0.25F, -1.5F));
  }
}

TEST(PcdWriter, HeaderHasOneLengthForAnyNumberOfPoints) {
  const std::vector<PcdField> fields = {{"x"}, {"rgb", 4, 'U'}};
  EXPECT_EQ(pcdHeader(fields, 0).size(), pcdHeader(fields, 123456789).size());
  EXPECT_NE(pcdHeader(fields, 5).find("FIELDS x rgb\nSIZE 4 4\nTYPE F U\nCOUNT 1 1\nWIDTH 5\nHEIGHT 1\n"),
            std::string::npos);
}

TEST(PcdWriter, LeavesNoFileWithoutCommit) {
  std::filesystem::remove(pcdTestPath());
  { const PcdWriter writer(pcdTestPath(), {{"x"}}); }
  EXPECT_FALSE(std::filesystem::exists(pcdTestPath()));
}

}  // namespace
}  // namespace urban_nav_core
