// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/cloud/cloud_file.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "../reader_check.hpp"
#include "urban_nav_core/testing/limited_memory.hpp"

namespace urban_nav_core {
namespace {

const std::vector<Eigen::Vector3f> kPoints = {
    {1.5F, -2.25F, 0.0F}, {1e-3F, 4e4F, -7.0F}, {0.0F, 0.0F, 3.0F}, {8.0F, 9.0F, 10.0F}};

void expectPoints(const CloudFile& file) {
  EXPECT_TRUE(file.offset.isZero());
  const PointCloud& cloud = file.cloud;
  ASSERT_EQ(cloud.points.size(), kPoints.size());
  for (std::size_t i = 0; i < kPoints.size(); ++i) EXPECT_EQ(cloud.points[i], kPoints[i]) << i;
}

template <typename Number>
void append(std::string& bytes, Number value, bool swap = false) {
  char raw[sizeof(value)];
  std::memcpy(raw, &value, sizeof(value));
  if (swap) std::reverse(raw, raw + sizeof(value));
  bytes.append(raw, sizeof(value));
}

std::string asText(const std::string& separator) {
  std::string text;
  for (const Eigen::Vector3f& p : kPoints)
    text += std::to_string(p.x()) + separator + std::to_string(p.y()) + separator + std::to_string(p.z()) + "\n";
  return text;
}

std::string plyAscii() {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nend_header\n" +
         asText(" ");
}

/// Binary PLY with a list element before the points, one after them, and other properties in between.
std::string plyBinary(bool big) {
  std::string bytes =
      std::string("ply\nformat ") + (big ? "binary_big_endian" : "binary_little_endian") +
      " 1.0\ncomment of two kinds\nelement face 2\nproperty list uchar int corners\nelement vertex 4\n"
      "property double z\n"
      "property uchar colour\nproperty float x\nproperty float y\nelement edge 1\nproperty int a\nend_header\n";
  for (int face = 0; face < 2; ++face) {
    append<std::uint8_t>(bytes, static_cast<std::uint8_t>(face + 1));
    for (int i = 0; i <= face; ++i) append<std::int32_t>(bytes, i, big);
  }
  for (const Eigen::Vector3f& p : kPoints) {
    append<double>(bytes, static_cast<double>(p.z()), big);
    append<std::uint8_t>(bytes, 7);
    append<float>(bytes, p.x(), big);
    append<float>(bytes, p.y(), big);
  }
  append<std::int32_t>(bytes, 5, big);
  return bytes;
}

std::string pcdHeader(const std::string& data) {
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS ring x y z\nSIZE 2 4 4 4\nTYPE U F F F\n"
         "COUNT 2 1 1 1\nWIDTH 4\nHEIGHT 1\n"
         "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 4\nDATA " +
         data + "\n";
}

std::string pcdAscii() {
  std::string text = pcdHeader("ascii");
  for (const Eigen::Vector3f& p : kPoints)
    text += "1 2 " + std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\n";
  return text;
}

std::string pcdBinary() {
  std::string bytes = pcdHeader("binary");
  for (const Eigen::Vector3f& p : kPoints) {
    append<std::uint32_t>(bytes, 3);
    for (int axis = 0; axis < 3; ++axis) append<float>(bytes, p[axis]);
  }
  return bytes;
}

std::string withSizes(const std::string& packed, std::size_t plain) {
  std::string bytes = pcdHeader("binary_compressed");
  append<std::uint32_t>(bytes, static_cast<std::uint32_t>(packed.size()));
  append<std::uint32_t>(bytes, static_cast<std::uint32_t>(plain));
  return bytes + packed;
}

/// Structure of arrays; the rings, all zero, as one literal byte and a copy.
std::string pcdCompressed() {
  std::string coordinates;
  for (int axis = 0; axis < 3; ++axis)
    for (const Eigen::Vector3f& p : kPoints) append<float>(coordinates, p[axis]);
  std::string packed = {'\0', '\0', static_cast<char>(7U << 5U), static_cast<char>(15 - 7 - 2), '\0'};
  for (std::size_t at = 0; at < coordinates.size(); at += 32) {
    const std::string piece = coordinates.substr(at, 32);
    packed += static_cast<char>(piece.size() - 1);
    packed += piece;
  }
  return withSizes(packed, 16 + coordinates.size());
}

std::string gzipped(const std::string& plain) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string packed(deflateBound(&stream, static_cast<uLong>(plain.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(plain.data()));
  stream.avail_in = static_cast<uInt>(plain.size());
  stream.next_out = reinterpret_cast<Bytef*>(&packed[0]);
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

std::string refusal(const std::string& content) {
  return catchError([&] { parseCloud(content, "c"); });
}

TEST(CloudFile, EveryFormatGivesThePoints) {
  for (const std::string& content :
       {plyAscii(), plyBinary(false), plyBinary(true), pcdAscii(), pcdBinary(), pcdCompressed(), asText(","),
        asText(" ; "), asText("\t"), "x, y ,\"Z\"\n" + asText(","), "# of a laser\n" + asText("  "),
        "\"Points:0\",\"Points:1\",\"Points:2\"\n" + asText(","), "//X Y Z\n" + asText(" "),
        "\xEF\xBB\xBFx;y;z\n" + asText(";"), "sep=;\n" + asText(";")}) {
    expectPoints(parseCloud(content, "c"));
    expectPoints(parseCloud(gzipped(content), "c.gz"));
  }
  expectPoints(parseCloud(gzipped(asText(",").substr(0, 40)) + gzipped(asText(",").substr(40)), "two members"));
}

TEST(CloudFile, ColumnsOfAHeaderComeInAnyOrder) {
  const PointCloud cloud = parseCloud("nx;z;x;y\n9;3;1;2\n", "c").cloud;
  ASSERT_EQ(cloud.points.size(), 1U);
  EXPECT_EQ(cloud.points[0], Eigen::Vector3f(1.0F, 2.0F, 3.0F));
}

TEST(CloudFile, OriginsOfBeamsComeWithThePoints) {
  std::string header = "1.0\nelement vertex 2\n", bytes;
  for (const char* name : {"origin_z", "x", "y", "z", "origin_x", "origin_y"})
    header += std::string("property float ") + name + "\n";
  for (const float value : {6.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 12.0F, 7.0F, 8.0F, 9.0F, 10.0F, 11.0F})
    append<float>(bytes, value);
  for (const std::string& file : {"ply\nformat binary_little_endian " + header + "end_header\n" + bytes,
                                  "ply\nformat ascii " + header + "end_header\n6 1 2 3 4 5\n12 7 8 9 10 11\n"}) {
    const PointCloud cloud = parseCloud(file, "c").cloud;
    ASSERT_EQ(cloud.points.size(), 2U);
    ASSERT_EQ(cloud.origins.size(), 2U);
    EXPECT_EQ(cloud.points[1], Eigen::Vector3f(7.0F, 8.0F, 9.0F));
    EXPECT_EQ(cloud.origins[0], Eigen::Vector3f(4.0F, 5.0F, 6.0F));
    EXPECT_EQ(cloud.origins[1], Eigen::Vector3f(10.0F, 11.0F, 12.0F));
  }
  EXPECT_TRUE(parseCloud(plyAscii(), "c").cloud.origins.empty());
}

TEST(CloudFile, IsReadAsOtherProgramsWriteIt) {
  expectPoints(parseCloud("//X,Y,Z\n" + asText(","), "CloudCompare"));
  expectPoints(parseCloud("//X Y Z\n4\n" + asText(" "), "CloudCompare, counted"));
  expectPoints(parseCloud("4\n" + asText(" "), "pts"));
  expectPoints(parseCloud("\xEF\xBB\xBFx,y,z\r\n" + asText(","), "a spreadsheet"));
  const std::string pcd = pcdAscii();
  expectPoints(parseCloud(pcd.substr(pcd.find("FIELDS")), "without comment and version"));
  std::string one_line = plyAscii();
  for (std::size_t i = one_line.find("end_header") + 11; i < one_line.size(); ++i)
    if (one_line[i] == '\n') one_line[i] = ' ';
  expectPoints(parseCloud(one_line, "all numbers in a line"));
}

TEST(CloudFile, ListsOfVerticesAreSkipped) {
  const std::string header =
      "1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nproperty list uchar int views\n"
      "end_header\n";
  std::string bytes;
  for (const int views : {2, 0}) {
    for (const float value : {1.0F, 2.0F, 3.0F}) append<float>(bytes, value);
    append<std::uint8_t>(bytes, static_cast<std::uint8_t>(views));
    for (int i = 0; i < views; ++i) append<std::int32_t>(bytes, 7);
  }
  for (const std::string& file : {"ply\nformat binary_little_endian " + header + bytes,
                                  "ply\nformat ascii " + header + "1 2 3 2 7 7\n1 2 3 0\n"}) {
    const PointCloud cloud = parseCloud(file, "c").cloud;
    ASSERT_EQ(cloud.points.size(), 2U);
    EXPECT_EQ(cloud.points[1], Eigen::Vector3f(1.0F, 2.0F, 3.0F));
  }
}

TEST(CloudFile, FarCoordinatesKeepMillimetres) {
  const CloudFile file =
      parseCloud("691244.251,5334577.502,519.001\n691245.253,5334578.504,519.003\n691246.0,5334579.0,520.0\n", "utm");
  ASSERT_EQ(file.cloud.points.size(), 3U);
  const Eigen::Vector3d first = file.offset + file.cloud.points[0].cast<double>();
  EXPECT_LT((first - Eigen::Vector3d(691244.251, 5334577.502, 519.001)).norm(), 1e-6);
  CloudFile again = file;
  recentre(again);
  EXPECT_LT((again.offset + again.cloud.points[0].cast<double>() - first).norm(), 1e-6);
  EXPECT_LT(again.cloud.points[1].norm(), 1e-6);  // the median of three
}

std::string las(const std::vector<Eigen::Vector3i>& points, std::uint8_t format = 3) {
  std::string bytes(227, '\0');
  const auto put = [&bytes](std::size_t at, auto value) { std::memcpy(&bytes[at], &value, sizeof(value)); };
  std::memcpy(&bytes[0], "LASF", 4);
  put(24, std::uint8_t{1});
  put(25, std::uint8_t{2});
  put(94, std::uint16_t{227});
  put(96, std::uint32_t{227});
  put(104, format);
  put(105, std::uint16_t{34});
  put(107, static_cast<std::uint32_t>(points.size()));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put(131 + 8 * axis, 0.001);
    put(155 + 8 * axis, 1000.0 * static_cast<double>(axis));
  }
  for (const Eigen::Vector3i& point : points) {
    for (int axis = 0; axis < 3; ++axis) append<std::int32_t>(bytes, point[axis]);
    bytes.append(34 - 12, '\0');
  }
  return bytes;
}

TEST(CloudFile, LasIsRead) {
  const CloudFile file = parseCloud(las({{1500, 0, -1}, {1, 2, 3}, {5, 5, 5}}), "c");
  ASSERT_EQ(file.cloud.points.size(), 3U);
  const Eigen::Vector3d first = file.offset + file.cloud.points[0].cast<double>();
  EXPECT_LT((first - Eigen::Vector3d(1.5, 1000.0, 1999.999)).norm(), 1e-6);
  EXPECT_NE(refusal(las({{1, 2, 3}}, 0x83)).find("LAZ"), std::string::npos);
  EXPECT_EQ(refusal(las({{1, 2, 3}}).substr(0, 250)), "c: ends before its 1 points: expected a complete file");
}

TEST(CloudFile, BeamsWithoutReturnAreKept) {
  const PointCloud cloud = parseCloud("1,2,3\nnan,NaN,-inf\n1e300,0,0\n", "c").cloud;
  ASSERT_EQ(cloud.points.size(), 3U);
  EXPECT_TRUE(std::isnan(cloud.points[1].x()));
  EXPECT_TRUE(std::isinf(cloud.points[1].z()));
  EXPECT_FALSE(cloud.points[2].allFinite());
}

TEST(CloudFile, AnEmptyFileIsAnEmptyCloud) { EXPECT_TRUE(parseCloud("", "c").cloud.points.empty()); }

TEST(CloudFile, MistakesAreNamedWithTheirLine) {
  EXPECT_EQ(refusal("1,2,3\n1,2\n"), "c:2: 2 columns: expected at least 3");
  EXPECT_EQ(refusal("1,2,3\n1,b,3\n"), "c:2: `b`: expected a number");
  EXPECT_EQ(refusal("a,b,c\n1,2,3\n"),
            "c:1: no column x in the header a, b, c: expected PLY, PCD, or CSV with the columns x, y, z");
  EXPECT_EQ(refusal("ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\nend_header\n"),
            "c:4: property type real: expected a type of PLY, such as float");
  EXPECT_EQ(refusal(plyAscii().substr(0, plyAscii().size() - 12)),
            "c: ends before its 4 of element vertex: expected a complete file");
  EXPECT_EQ(refusal(plyAscii() + "1 2\n"), "c:12: more numbers than declared in the header: expected as many");
  EXPECT_EQ(refusal("5\n1 2 3\n"), "c: ends after 1 points, the header declares 5: expected a complete file");
  EXPECT_EQ(refusal(plyBinary(false).substr(0, 300)),
            "c: ends before its 4 of element vertex: expected a complete file");
  EXPECT_EQ(refusal(pcdBinary().substr(0, pcdBinary().size() - 1)),
            "c: ends before its 4 points: expected a complete file");
  {
    const testing::LimitedMemory limit(std::size_t{8} << 20U);
    EXPECT_EQ(refusal(gzipped("x,y,z\n" + std::string(std::size_t{1} << 20U, '\n'))),
              "c: more than 1 MB when unpacked: expected an eighth of memory_mb = 8; or the unpacked file");
  }
  EXPECT_EQ(refusal(gzipped(plyAscii()).substr(0, 60)), "c: the gzip stream ends too early: expected a complete file");
  EXPECT_EQ(refusal("VERSION 0.7\nFIELDS x y\nSIZE 4 4 4\n"),
            "c:3: 3 words for 2 fields: expected one for each, after the line FIELDS");
  EXPECT_EQ(refusal(withSizes("\xff\xff", 64)), "c: the compressed points are damaged: expected a complete file");
  EXPECT_EQ(refusal(withSizes("\xff\xff", 4000000000U)), "c: ends before its 4 points: expected a complete file");
}

TEST(CloudFile, SurvivesDamage) {
  const std::vector<std::vector<std::string>> formats = {{plyAscii()},
                                                         {plyBinary(false), plyBinary(true)},
                                                         {pcdAscii()},
                                                         {pcdBinary(), pcdCompressed()},
                                                         {asText(","), "x y z\n" + asText(" ")},
                                                         {gzipped(asText(","))},
                                                         {las({{1, 2, 3}, {4, 5, 6}})}};
  for (const auto& seeds : formats)
    expectSurvives(testing::fuzzText(seeds, [](const std::string& text) { parseCloud(text, "c"); }));
}

}  // namespace
}  // namespace urban_nav_core
