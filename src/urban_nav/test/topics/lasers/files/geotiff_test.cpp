// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/files/geotiff.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <opencv2/imgcodecs.hpp>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using laser_mapper::kNoValue;

/// Returns what a program prints.
std::string runProgram(const std::string& command) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen((command + " 2>&1").c_str(), "r"), pclose);
  std::string output;
  std::array<char, 4096> buffer{};
  while (pipe != nullptr && std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe.get()) != nullptr)
    output += buffer.data();
  return output;
}

bool hasGdal() { return std::system("command -v gdalinfo >/dev/null 2>&1") == 0; }

class GeoTiffTest : public ::testing::Test {
 protected:
  ImagePlacement placement(int width, int height) const {
    return {width, height, 621000.5, 5734100.25, 0.05, 32630, "WGS 84 / UTM zone 30N"};
  }
  urban_nav_input::testing::TemporaryFolder folder_;
};

TEST_F(GeoTiffTest, ColoursAndTransparencyAreReadBack) {
  const int width = 7, height = 41;  // more rows than a strip
  std::vector<std::uint8_t> rgba;
  for (int i = 0; i < width * height; ++i) {
    const bool is_drawn = i % 2 == 0;  // the colours of the others are 0: OpenCV multiplies by alpha
    for (const int value : {i, 3 * i + 1, 5 * i + 2, 255})
      rgba.push_back(static_cast<std::uint8_t>(is_drawn ? value % 256 : 0));
  }
  const std::string path = folder_.file("a.tif");
  writeGeoTiff(path, placement(width, height), rgba);
  const cv::Mat read = cv::imread(path, cv::IMREAD_UNCHANGED);
  ASSERT_EQ(read.type(), CV_8UC4);
  ASSERT_EQ(read.size(), cv::Size(width, height));
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const std::uint8_t* expected = rgba.data() + 4 * (v * width + u);
      EXPECT_EQ(read.at<cv::Vec4b>(v, u), cv::Vec4b(expected[2], expected[1], expected[0], expected[3]));
    }
}

TEST_F(GeoTiffTest, HeightsAreReadBackExactly) {
  const std::vector<float> rows = {1.5F, -0.25F, kNoValue, 123.4567F, 8848.86F, 0.0F};
  const std::string path = folder_.file("h.tif");
  writeGeoTiff(path, placement(3, 2), rows, "elevation", "m");
  const cv::Mat read = cv::imread(path, cv::IMREAD_UNCHANGED);
  ASSERT_EQ(read.type(), CV_32FC1);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(read.at<float>(i / 3, i % 3), rows[static_cast<std::size_t>(i)]);
}

TEST_F(GeoTiffTest, SameImageSameBytesAndNoPartialFile) {
  const std::vector<float> rows(6, 1.0F);
  writeGeoTiff(folder_.file("a.tif"), placement(3, 2), rows, "slope", "deg");
  writeGeoTiff(folder_.file("b.tif"), placement(3, 2), rows, "slope", "deg");
  EXPECT_EQ(urban_nav_input::testing::readFile(folder_.file("a.tif")),
            urban_nav_input::testing::readFile(folder_.file("b.tif")));
  EXPECT_THROW(writeGeoTiff(folder_.file("none/a.tif"), placement(3, 2), rows, "slope", "deg"),
               urban_nav_core::UserError);
  ImagePlacement other = placement(3, 2);
  other.epsg = 102100;
  EXPECT_THROW(writeGeoTiff(folder_.file("c.tif"), other, rows, "slope", "deg"), urban_nav_core::UserError);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_.file(""))) ++files;
  EXPECT_EQ(files, 2U);
}

TEST_F(GeoTiffTest, GdalReadsSystemPlaceLayerAndNoData) {
  if (!hasGdal()) GTEST_SKIP() << "gdalinfo (package gdal-bin) is not installed";
  const std::string path = folder_.file("h.tif");
  writeGeoTiff(path, placement(3, 2), {1.5F, -0.25F, kNoValue, 2.0F, 3.0F, 0.0F}, "elevation", "m");
  const std::string projected = runProgram("gdalinfo -stats " + path);
  for (const char* text :
       {"ID[\"EPSG\",32630]", "Origin = (621000.500000000000000,5734100.250000000000000)",
        "Pixel Size = (0.050000000000000,-0.050000000000000)", "AREA_OR_POINT=Area", "Description = elevation",
        "Unit Type: m", "NoData Value=-9999", "Minimum=-0.250", "Maximum=3.000"})
    EXPECT_NE(projected.find(text), std::string::npos) << text << "\n" << projected;
  ImagePlacement local{3, 2, -1.0, 2.0, 0.1};
  writeGeoTiff(path, local, std::vector<std::uint8_t>(24, 255));
  const std::string in_map = runProgram("gdalinfo " + path);
  for (const char* text : {"ENGCRS[\"frame map of urban_nav", "Origin = (-1.000000000000000,2.000000000000000)",
                           "ColorInterp=Alpha", "Block=3x"})
    EXPECT_NE(in_map.find(text), std::string::npos) << text << "\n" << in_map;
  EXPECT_EQ(in_map.find("PROJCRS"), std::string::npos) << in_map;
}

}  // namespace
}  // namespace urban_nav
