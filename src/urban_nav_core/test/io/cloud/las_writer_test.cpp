// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/cloud/las_writer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "urban_nav_core/io/cloud/cloud_file.hpp"
#include "urban_nav_core/io/cloud/ply_writer.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

constexpr StampNs kStamp2008 = 1'225'719'873'250'000'000;  // 2008-11-03, the 308th day of a leap year

std::string lasTestPath() { return ::testing::TempDir() + "las_writer_test.las"; }

LasPoint lasTestPoint(const Eigen::Vector3d& p) {
  LasPoint point;
  point.p = p;
  point.intensity = 4660;
  point.classification = 11;
  point.channel = 1;
  point.source = 7;
  point.stamp = kStamp2008;
  point.red = 65535;
  point.green = 256;
  point.blue = 3;
  return point;
}

std::string writtenLas(const std::vector<Eigen::Vector3d>& points) {
  LasWriter writer(lasTestPath(), {{"sigma", LasAttribute::Type::Float, "m"}, {"laser", LasAttribute::Type::UChar, ""}},
                   "LOCAL_CS[\"map\"]");
  std::string attributes;
  appendLittleEndian(attributes, 0.0125F);
  appendLittleEndian(attributes, std::uint8_t{1});
  for (const Eigen::Vector3d& p : points) writer.append(lasTestPoint(p), attributes);
  writer.commit();
  std::ifstream file(lasTestPath(), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Returns the value at an offset of the specification.
template <typename Value>
Value valueAt(const std::string& bytes, std::size_t offset) {
  Value value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

TEST(LasWriter, ReadsBackTheSamePoints) {
  const std::vector<Eigen::Vector3d> points = {{12.3456, -7.0, 0.5}, {-0.00006, 99.99994, 41.0}, {150e3, 1.0, -1.0}};
  writtenLas(points);
  const CloudFile read = readCloud(lasTestPath());
  ASSERT_EQ(read.cloud.points.size(), points.size());
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LT((read.offset + read.cloud.points[i].cast<double>() - points[i]).norm(), 1e-4);
  EXPECT_LT((read.offset + read.cloud.points[2].cast<double>() - points[2]).norm(), 0.02) << "to the reader's floats";
}

TEST(LasWriter, KeepsCoordinatesFarFromTheirOrigin) {
  const std::vector<Eigen::Vector3d> points = {{2'500'123.4567, -5'000'000.1234, 50.0}, {2'500'999.1, -5'000'500.0, 0}};
  writtenLas(points);
  const CloudFile read = readCloud(lasTestPath());
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LT((read.offset + read.cloud.points[i].cast<double>() - points[i]).norm(), 2e-4);
}

TEST(LasWriter, FieldsAreWhereTheSpecificationPlacesThem) {
  const std::string bytes = writtenLas({{1.0, 2.0, 3.0}, {-4.0, 5.0, 6.5}});
  EXPECT_EQ(bytes.substr(0, 4), "LASF");
  EXPECT_EQ(valueAt<std::uint16_t>(bytes, 6), 0x11) << "adjusted standard GPS time, WKT";
  EXPECT_EQ(bytes[24], 1);
  EXPECT_EQ(bytes[25], 4);
  EXPECT_EQ(valueAt<std::uint16_t>(bytes, 90), 308) << "day of the year";
  EXPECT_EQ(valueAt<std::uint16_t>(bytes, 92), 2008);
  EXPECT_EQ(valueAt<std::uint16_t>(bytes, 94), 375);
  const auto points_at = valueAt<std::uint32_t>(bytes, 96);
  EXPECT_EQ(valueAt<std::uint32_t>(bytes, 100), 2U) << "variable length records";
  EXPECT_EQ(bytes[104], 7) << "point format";
  ASSERT_EQ(valueAt<std::uint16_t>(bytes, 105), 36 + 5);
  EXPECT_EQ(valueAt<std::uint32_t>(bytes, 107), 0U) << "the count of older versions";
  EXPECT_EQ(valueAt<double>(bytes, 131), 1e-4);
  const double box[] = {1.0, -4.0, 5.0, 2.0, 6.5, 3.0};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(valueAt<double>(bytes, 179 + 8 * i), box[i], 1e-9);
  EXPECT_EQ(valueAt<std::uint64_t>(bytes, 247), 2U);
  EXPECT_EQ(valueAt<std::uint64_t>(bytes, 255), 2U) << "first returns";
  ASSERT_EQ(bytes.size(), points_at + 2 * 41);
  const std::size_t second = points_at + 41;
  EXPECT_EQ(valueAt<std::int32_t>(bytes, second), -40000);
  EXPECT_EQ(valueAt<std::uint16_t>(bytes, second + 12), 4660) << "intensity";
  EXPECT_EQ(bytes[second + 14], 0x11) << "return 1 of 1";
  EXPECT_EQ(bytes[second + 15], 0x10) << "channel 1";
  EXPECT_EQ(bytes[second + 16], 11) << "class";
  EXPECT_EQ(valueAt<std::uint16_t>(bytes, second + 20), 7) << "source";
  EXPECT_EQ(valueAt<double>(bytes, second + 22), 1'225'719'873.25 - 315'964'800.0 + 14.0 - 1e9);
  EXPECT_EQ(valueAt<std::uint16_t>(bytes, second + 30), 65535) << "red";
  EXPECT_EQ(valueAt<std::uint16_t>(bytes, second + 34), 3) << "blue";
  EXPECT_EQ(valueAt<float>(bytes, second + 36), 0.0125F) << "sigma";
  EXPECT_EQ(bytes[second + 40], 1) << "laser";
}

TEST(LasWriter, VariableLengthRecordsHoldCoordinateSystemAndAttributes) {
  const std::string bytes = writtenLas({{1.0, 2.0, 3.0}});
  EXPECT_STREQ(bytes.data() + 375 + 2, "LASF_Projection");
  EXPECT_EQ(valueAt<std::uint16_t>(bytes, 375 + 18), 2112);
  const auto wkt = valueAt<std::uint16_t>(bytes, 375 + 20);
  EXPECT_STREQ(bytes.data() + 375 + 54, "LOCAL_CS[\"map\"]");
  const std::size_t second = 375 + 54 + wkt;
  EXPECT_STREQ(bytes.data() + second + 2, "LASF_Spec");
  EXPECT_EQ(valueAt<std::uint16_t>(bytes, second + 18), 4);
  EXPECT_EQ(valueAt<std::uint16_t>(bytes, second + 20), 2 * 192);
  EXPECT_EQ(bytes[second + 54 + 2], 9) << "float";
  EXPECT_STREQ(bytes.data() + second + 54 + 4, "sigma");
  EXPECT_STREQ(bytes.data() + second + 54 + 192 + 4, "laser");
}

TEST(LasWriter, CountsLeapSeconds) {
  EXPECT_EQ(gpsSeconds(315'964'800'000'000'000), 0.0);
  EXPECT_EQ(gpsSeconds(1'000'000'000'000'000'000), 1'000'000'000.0 - 315'964'800.0 + 13.0);
  EXPECT_EQ(gpsSeconds(1'600'000'000'500'000'000), 1'600'000'000.5 - 315'964'800.0 + 18.0);
}

TEST(LasWriter, RefusesPointsThatItCannotHold) {
  LasWriter writer(lasTestPath(), {}, "");
  writer.append(lasTestPoint({0.0, 0.0, 0.0}), "");
  EXPECT_THROW(writer.append(lasTestPoint({300e3, 0.0, 0.0}), ""), DataError);
  EXPECT_THROW(writer.append(lasTestPoint({std::nan(""), 0.0, 0.0}), ""), DataError);
}

}  // namespace
}  // namespace urban_nav_core
