// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/cloud/cloud_columns.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "urban_nav_core/io/cloud/las_writer.hpp"
#include "urban_nav_core/io/cloud/ply_writer.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

using Values = std::vector<double>;

const char* const kColumnsPly =
    "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty list uchar int faces\nproperty uchar "
    "label\nend_header\n1.5 2 7 7 3\n-2 0 4\n";

TEST(CloudColumns, AreFoundByNameInAnyOrder) {
  const auto columns = parseCloudColumns("label,y,x\n3,1,2\n\n4,nan,-1e2\r\n", "c", {"x", "label", "z", "y"});
  ASSERT_EQ(columns.size(), 4u);
  EXPECT_EQ(columns[0].value(), (Values{2.0, -100.0}));
  EXPECT_EQ(columns[1].value(), (Values{3.0, 4.0}));
  EXPECT_FALSE(columns[2].has_value());
  EXPECT_TRUE(std::isnan(columns[3].value()[1]));
}

TEST(CloudColumns, OfPlySkipListsAndOtherProperties) {
  const auto columns = parseCloudColumns(kColumnsPly, "c", {"label", "x", "faces"});
  EXPECT_EQ(columns[0].value(), (Values{3.0, 4.0}));
  EXPECT_EQ(columns[1].value(), (Values{1.5, -2.0}));
  EXPECT_FALSE(columns[2].has_value());
}

/// Two points of a LAS 1.4 file with the attributes `label` (uchar) and `sigma` (float).
std::string columnsLas() {
  const std::string path = ::testing::TempDir() + "cloud_columns_test.las";
  LasWriter writer(path, {{"label", LasAttribute::Type::UChar, ""}, {"sigma", LasAttribute::Type::Float, ""}}, "");
  LasPoint point;
  for (const int i : {1, 2}) {
    point.p = {1.5 * i, -2.0, 5'000'000.25};
    point.intensity = static_cast<std::uint16_t>(40000 + i);
    point.classification = static_cast<std::uint8_t>(63 + i);
    std::string attributes;
    appendLittleEndian(attributes, static_cast<std::uint8_t>(200 + i));
    appendLittleEndian(attributes, 0.5F * static_cast<float>(i));
    writer.append(point, attributes);
  }
  writer.commit();
  return readBytes(path);
}

TEST(CloudColumns, OfLasAreFieldsAndAttributes) {
  const auto columns = parseCloudColumns(
      columnsLas(), "c", {"sigma", "x", "label", "classification", "intensity", "z", "reflectance"});
  EXPECT_EQ(columns[0].value(), (Values{0.5, 1.0}));
  EXPECT_NEAR(columns[1].value()[1], 3.0, 1e-9);
  EXPECT_EQ(columns[2].value(), (Values{201.0, 202.0}));
  EXPECT_EQ(columns[3].value(), (Values{64.0, 65.0}));
  EXPECT_EQ(columns[4].value(), (Values{40001.0, 40002.0}));
  EXPECT_NEAR(columns[5].value()[0], 5'000'000.25, 1e-9);
  EXPECT_FALSE(columns[6].has_value());
}

/// One point of LAS 1.2, format 0, with three extra bytes: one undocumented, and a short with scale and offset.
std::string oldLas(std::uint8_t classification, std::int16_t stored, double scale, double offset) {
  std::string bytes(227 + 54 + 2 * 192, '\0');
  const auto put = [&bytes](std::size_t at, auto value) { std::memcpy(&bytes[at], &value, sizeof(value)); };
  std::memcpy(&bytes[0], "LASF", 4);
  put(24, std::uint8_t{1});
  put(25, std::uint8_t{2});
  put(94, std::uint16_t{227});
  put(96, static_cast<std::uint32_t>(bytes.size()));
  put(100, std::uint32_t{1});
  put(105, std::uint16_t{23});
  put(107, std::uint32_t{1});
  for (std::size_t axis = 0; axis < 3; ++axis) put(131 + 8 * axis, 0.01);
  std::memcpy(&bytes[227 + 2], "LASF_Spec", 9);
  put(227 + 18, std::uint16_t{4});
  put(227 + 20, std::uint16_t{2 * 192});
  const std::size_t rows = 227 + 54;
  put(rows + 3, std::uint8_t{1});  // one undocumented byte
  put(rows + 192 + 2, std::uint8_t{4});
  put(rows + 192 + 3, std::uint8_t{8 + 16});
  std::memcpy(&bytes[rows + 192 + 4], "amplitude", 9);
  put(rows + 192 + 112, scale);
  put(rows + 192 + 136, offset);
  const std::size_t point = bytes.size();
  bytes.append(23, '\0');
  put(point + 15, classification);
  put(point + 21, stored);
  return bytes;
}

TEST(CloudColumns, OfOldLasHaveClassificationsWithFlagsAndScaledAttributes) {
  const std::string las = oldLas(0x80 | 6, -300, 0.01, 40.0);  // a point that was withheld
  const auto columns = parseCloudColumns(las, "c", {"classification", "amplitude", "y"});
  EXPECT_EQ(columns[0].value(), (Values{6.0}));
  EXPECT_NEAR(columns[1].value()[0], 37.0, 1e-9);
  EXPECT_EQ(columns[2].value(), (Values{0.0}));
}

TEST(CloudColumns, RefuseWordsAndRowsOfAnotherLengthWithTheirLine) {
  for (const char* text : {"x,y\n1,2\n1,two\n", "x,y\n1,2\n1\n", "x,y\n1,2\n1,2,3\n"}) try {
      parseCloudColumns(text, "c.csv", {"x", "y"});
      FAIL() << text;
    } catch (const UserError& error) {
      EXPECT_EQ(error.parts().where, "c.csv:3");
    }
}

TEST(CloudColumns, SurviveDamage) {
  const auto result = testing::fuzzText(
      {kColumnsPly, "x,y,label\n1,2,3\n4,5,6\n", columnsLas(), oldLas(2, 1, 1.0, 0.0)}, [](const std::string& text) {
    const auto columns = parseCloudColumns(text, "c", {"x", "label"});
    if (!columns[0] || !columns[1]) return;
    EXPECT_EQ(columns[0]->size(), columns[1]->size());
  });
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.accepted, 0);
}

}  // namespace
}  // namespace urban_nav_core
