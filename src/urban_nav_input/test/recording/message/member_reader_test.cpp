// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/recording/member_reader.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "urban_nav_input/recording/connection_definition.hpp"

namespace urban_nav_input {
namespace {

using Bytes = std::vector<std::uint8_t>;

ByteView view(const Bytes& bytes) { return {bytes.data(), bytes.size()}; }

std::string toText(ByteView text) { return {reinterpret_cast<const char*>(text.data), text.size}; }

MessageField sequence() {
  MessageField field;
  field.array = MessageField::Array::Sequence;
  return field;
}

TEST(MemberReader, TakesPackedMembersOneAfterAnother) {
  const Bytes bytes = {7, 2, 0, 0, 0, 'a', 'b', 1, 0, 0, 0, 9, 0};
  MemberReader reader(view(bytes), MessageEncoding::Ros1);
  EXPECT_EQ(reader.numbers(1, 1).data[0], 7);
  EXPECT_EQ(toText(reader.text()), "ab");
  ASSERT_EQ(reader.count(sequence()), 1U);
  EXPECT_EQ(reader.numbers(1, 2).data, bytes.data() + 11) << "a view, not a copy";
  EXPECT_FALSE(reader.isSwapped());
}

TEST(MemberReader, AlignsMembersOfCdrAfterTheEncapsulation) {
  const Bytes bytes = {0, 1, 0, 0, 7, 0, 0, 0, 3, 0, 0, 0, 'a', 'b', 0, 0, 0, 0, 0, 0, 5, 0, 0, 0, 0, 0, 0, 0};
  MemberReader reader(view(bytes), MessageEncoding::CdrLittleEndian);
  EXPECT_EQ(reader.numbers(1, 1).data[0], 7);
  EXPECT_EQ(toText(reader.text()), "ab") << "without the zero at its end";
  EXPECT_EQ(reader.numbers(1, 8).data, bytes.data() + 20) << "a multiple of 8 after the encapsulation";
}

TEST(MemberReader, ReadsCountsOfBigEndianMessages) {
  const Bytes bytes = {0, 0, 0, 0, 0, 0, 0, 2, 1, 2};
  MemberReader reader(view(bytes), MessageEncoding::CdrBigEndian);
  EXPECT_TRUE(reader.isSwapped());
  EXPECT_EQ(reader.count(sequence()), 2U);
}

TEST(MemberReader, EntersAMessageWithoutMembersByItsByte) {
  const Bytes bytes = {0, 1, 0, 0, 0, 4};
  MemberReader reader(view(bytes), MessageEncoding::CdrLittleEndian);
  reader.enter(MessageLayout{});
  EXPECT_EQ(reader.numbers(1, 1).data[0], 4);
}

TEST(MemberReader, ThrowsWhereTheBytesEndTooEarly) {
  const Bytes bytes = {255, 255, 255, 255, 1};
  const auto reader = [&] { return MemberReader(view(bytes), MessageEncoding::Ros1); };
  EXPECT_THROW(reader().text(), std::runtime_error);
  EXPECT_THROW(reader().count(sequence()), std::runtime_error);
  EXPECT_THROW(reader().numbers(2, 4), std::runtime_error);
  EXPECT_THROW(reader().numbers(static_cast<std::size_t>(-1), 8), std::runtime_error);
  EXPECT_THROW(MemberReader({bytes.data(), 3}, MessageEncoding::CdrLittleEndian), std::runtime_error);
}

TEST(ConnectionDefinition, GivesStandardTypesTheirNamesOfRos1) {
  const MessageDefinition known = parseDefinition("geometry_msgs/Point", "float64 X\nfloat64 y\nfloat64 more\n");
  const MessageDefinition named = withRos1Names(known);
  ASSERT_EQ(named.layouts.front().fields.size(), 3U);
  EXPECT_EQ(named.layouts.front().fields[0].name, "x");
  EXPECT_EQ(named.layouts.front().fields[2].name, "more") << "a member that ROS 1 does not have keeps its name";
  const MessageDefinition other = withRos1Names(parseDefinition("a/Point", "float64 X\n"));
  EXPECT_EQ(other.layouts.front().fields[0].name, "X");
}

}  // namespace
}  // namespace urban_nav_input
