// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/recording/message_definition.hpp"

#include <gtest/gtest.h>
#include <nav_msgs/OccupancyGrid.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/NavSatFix.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>

#include <stdexcept>

namespace urban_nav_input {
namespace {

template <typename Message>
MessageDefinition parseType() {
  namespace traits = ros::message_traits;
  return parseDefinition(traits::DataType<Message>::value(), traits::Definition<Message>::value());
}

template <typename Message>
void expectMd5() {
  EXPECT_EQ(computeMd5(parseType<Message>()), ros::message_traits::MD5Sum<Message>::value())
      << ros::message_traits::DataType<Message>::value();
  const std::string type = ros::message_traits::DataType<Message>::value();
  EXPECT_EQ(computeMd5(parseDefinition(type, printRos1(parseType<Message>()))),
            ros::message_traits::MD5Sum<Message>::value());
}

TEST(MessageDefinition, HasTheMd5SumOfRos1) {
  expectMd5<std_msgs::Header>();
  expectMd5<sensor_msgs::Imu>();
  expectMd5<sensor_msgs::CameraInfo>();
  expectMd5<sensor_msgs::NavSatFix>();    // constants
  expectMd5<sensor_msgs::PointCloud2>();  // constants in a type within it
  expectMd5<tf2_msgs::TFMessage>();
  expectMd5<nav_msgs::OccupancyGrid>();  // time
}

TEST(MessageDefinition, IsPrintedAsRos2WritesIt) {
  EXPECT_EQ(printRos2(parseType<sensor_msgs::CameraInfo>())
                .rfind("std_msgs/Header header\nuint32 height\nuint32 width\nstring distortion_model\nfloat64[] "
                       "d\nfloat64[9] k\n",
                       0),
            0U);
  const std::string header = printRos2(parseType<std_msgs::Header>());
  EXPECT_EQ(header.find("seq"), std::string::npos);
  EXPECT_NE(header.find("builtin_interfaces/Time stamp"), std::string::npos);
  EXPECT_NE(header.find("MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n"), std::string::npos);
}

TEST(MessageDefinition, OfRos2MayHaveBoundsDefaultsAndShortNames) {
  const MessageDefinition definition = parseDefinition("test_msgs/msg/All",
                                                       "# a comment\n"
                                                       "int32 LIMIT=5 # not a field\n"
                                                       "string<=10 name \"abc\"\n"
                                                       "int16[<=3] bounded\r\n"
                                                       "float32[2] pair [1.0, 2.0]\n"
                                                       "Inner inner\n"
                                                       "================================================\n"
                                                       "MSG: test_msgs/msg/Inner\n"
                                                       "builtin_interfaces/Duration lag\n");
  ASSERT_EQ(definition.layouts.size(), 2U);
  const std::vector<MessageField>& fields = definition.layouts[0].fields;
  ASSERT_EQ(fields.size(), 4U);
  EXPECT_EQ(fields[0].kind, FieldKind::Text);
  EXPECT_EQ(fields[0].name, "name");
  EXPECT_EQ(fields[1].array, MessageField::Array::Sequence);
  EXPECT_EQ(fields[1].kind, FieldKind::Number2);
  EXPECT_EQ(fields[2].count, 2U);
  EXPECT_EQ(fields[3].layout, 1U);
  EXPECT_EQ(definition.layouts[1].fields[0].kind, FieldKind::Time);
  EXPECT_EQ(definition.layouts[0].constants, std::vector<std::string>{"int32 LIMIT=5"});
}

TEST(MessageDefinition, WhatIsNotUnderstoodIsNamed) {
  const auto reason = [](const std::string& text) -> std::string {
    try {
      parseDefinition("a/B", text);
      return {};
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
  EXPECT_NE(reason("a/Missing x\n").find("a/Missing"), std::string::npos);
  EXPECT_NE(reason("wstring x\n").find("wstring"), std::string::npos);
  EXPECT_NE(reason("B x\n").find("itself"), std::string::npos);
  EXPECT_NE(reason("int8[x] y\n").find("[x]"), std::string::npos);
  EXPECT_NE(reason("int8 y\n===\n====\nIDL: a/msg/C\nmodule a {}\n").find("IDL"), std::string::npos);
}

}  // namespace
}  // namespace urban_nav_input
