// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/column_names.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace urban_nav_core {
namespace {

TEST(ColumnNames, AxesAreFoundInTheSpellingsOfCommonPrograms) {
  for (const char* name :
       {"x", "X", "//X", "\"x\"", "Points:0", "Points_0", "x [m]", "tx", "px", "pos_x", "position.x", "p_RS_R_x [m]",
        "field.pose.pose.position.x", "/pose/position/x", "Coord. X", "X coordinate", "x_m", "easting"})
    EXPECT_EQ(readQuantity(name), Quantity::X) << name;
  for (const char* name : {"z", "Points:2", "transform.translation.z", "Z (m)"})
    EXPECT_EQ(readQuantity(name), Quantity::Z) << name;
  for (const char* name : {"qw", "q_w", "quat_w", "q_RS_w []", "pose.orientation.w", "rotation.w"})
    EXPECT_EQ(readQuantity(name), Quantity::Qw) << name;
  for (const char* name : {"time", "#timestamp [ns]", "stamp", "%time", "field.header.stamp", "t"})
    EXPECT_EQ(readQuantity(name), Quantity::Stamp) << name;
}

TEST(ColumnNames, OtherQuantitiesAreNotTakenForThem) {
  for (const char* name : {"nx", "Normals:0", "normal_x", "v_RS_R_x [m s^-1]", "b_w_RS_S_x", "twist.linear.x", "cov_x",
                           "label", "intensity", "w", "", "#", "scale_x"})
    EXPECT_FALSE(readQuantity(name)) << name;
}

TEST(ColumnNames, ThePlainestNameIsTakenAndTheStampOfTheHeader) {
  EXPECT_EQ(findColumn({"%time", "field.header.stamp", "field.pose.position.x", "x"}, Quantity::Stamp), 1U);
  EXPECT_EQ(findColumn({"%time", "field.header.stamp", "field.pose.position.x", "x"}, Quantity::X), 3U);
  EXPECT_FALSE(findColumn({"a", "b"}, Quantity::X));
}

TEST(ColumnNames, UnitsAreInBrackets) {
  EXPECT_EQ(readUnit("x [mm]"), 1e-3);
  EXPECT_EQ(readUnit("#timestamp [ns]"), 1e-9);
  EXPECT_EQ(readUnit("y (cm)"), 0.01);
  EXPECT_FALSE(readUnit("x"));
  EXPECT_FALSE(readUnit("x [furlong]"));
}

}  // namespace
}  // namespace urban_nav_core
