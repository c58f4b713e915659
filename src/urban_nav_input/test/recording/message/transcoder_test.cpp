// SPDX-License-Identifier: BSD-3-Clause
#include "recording/message/transcoder.hpp"

#include <geometry_msgs/PolygonStamped.h>
#include <gtest/gtest.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/TimeReference.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>

#include <random>
#include <stdexcept>

#include "urban_nav_input/recording/message_stream.hpp"

namespace urban_nav_input {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <typename Message>
Bytes serialize(const Message& message) {
  Bytes bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

template <typename Message>
MessageDefinition typeDefinition() {
  namespace traits = ros::message_traits;
  return parseDefinition(traits::DataType<Message>::value(), traits::Definition<Message>::value());
}

template <typename Message>
Bytes toCdr(const Message& message) {
  Transcoder transcoder(typeDefinition<Message>(), withoutSequence(typeDefinition<Message>()));
  const Bytes packed = serialize(message);
  const ByteView cdr =
      transcoder.convert({packed.data(), packed.size()}, MessageEncoding::Ros1, MessageEncoding::CdrLittleEndian);
  return {cdr.data, cdr.data + cdr.size};
}

template <typename Message>
Message read(const Bytes& bytes, MessageEncoding encoding) {
  Message message;
  MessageStream stream({bytes.data(), bytes.size()}, encoding);
  stream.next(message);
  return message;
}

std_msgs::Header makeHeader(const std::string& frame) {
  std_msgs::Header header;
  header.seq = 7;
  header.stamp = ros::Time(1225719878, 123456789);
  header.frame_id = frame;
  return header;
}

/// Through CDR and back, all but seq is as it was, whatever the length of the text that shifts what follows.
template <typename Message>
void expectSameThroughCdr(Message message) {
  for (const char* frame : {"", "a", "ab", "abc", "abcdefgh"}) {
    message.header = makeHeader(frame);
    const Bytes cdr = toCdr(message);
    Message expected = message;
    expected.header.seq = 0;
    EXPECT_EQ(serialize(read<Message>(cdr, MessageEncoding::CdrLittleEndian)), serialize(expected)) << frame;
    Transcoder back(withoutSequence(typeDefinition<Message>()), typeDefinition<Message>());
    EXPECT_TRUE(back.isSame());
    const ByteView packed =
        back.convert({cdr.data(), cdr.size()}, MessageEncoding::CdrLittleEndian, MessageEncoding::Ros1);
    EXPECT_EQ(Bytes(packed.data, packed.data + packed.size), serialize(expected)) << frame;
  }
}

sensor_msgs::CameraInfo makeCameraInfo() {
  sensor_msgs::CameraInfo info;
  info.width = 256;
  info.distortion_model = "plumb_bob";
  info.D = {0.1, -0.2, 0.3, 0.0, 1e-9};
  for (std::size_t i = 0; i < info.P.size(); ++i) info.P[i] = 0.5 * static_cast<double>(i);
  info.roi.do_rectify = 1;
  return info;
}

TEST(Transcoder, MessagesAreTheSameThroughCdr) {
  expectSameThroughCdr(makeCameraInfo());
  sensor_msgs::LaserScan scan;
  scan.ranges = {1.0F, 2.0F, 3.0F};
  expectSameThroughCdr(scan);
  sensor_msgs::CompressedImage image;
  image.format = "jpeg";
  image.data = {1, 2, 3, 4, 5};
  expectSameThroughCdr(image);
  geometry_msgs::PolygonStamped polygon;
  polygon.polygon.points.resize(3);
  polygon.polygon.points[2].z = 4.0F;
  expectSameThroughCdr(polygon);
  sensor_msgs::TimeReference reference;
  reference.source = "gps";
  reference.time_ref = ros::Time(5, 6);
  expectSameThroughCdr(reference);
}

TEST(Transcoder, BytesOfCdrAreAlignedAfterTheEncapsulation) {
  std_msgs::String text;
  text.data = "hi";
  EXPECT_EQ(toCdr(text), (Bytes{0, 1, 0, 0, 3, 0, 0, 0, 'h', 'i', 0}));
  sensor_msgs::LaserScan scan;  // header: 8 bytes of stamp, 4 of length, 1 of text; then float32
  const Bytes bytes = toCdr(scan);
  EXPECT_EQ(bytes.size(), 4U + 16U + 7U * 4U + 2U * 4U);
  EXPECT_EQ((Bytes(bytes.begin() + 17, bytes.begin() + 20)), (Bytes{0, 0, 0})) << "padding";
}

TEST(Transcoder, ReadsBigEndian) {
  const Bytes bytes = {0,   0,   0, 0, 0x49, 0x0e, 0x8b, 0xc6, 0x07, 0x5b, 0xcd, 0x15, 0, 0, 0, 4,   'g',
                       'p', 's', 0, 0, 0,    0,    5,    0,    0,    0,    6,    0,    0, 0, 2, 'x', 0};
  const auto reference = read<sensor_msgs::TimeReference>(bytes, MessageEncoding::CdrBigEndian);
  EXPECT_EQ(reference.header.stamp, ros::Time(0x490e8bc6, 123456789));
  EXPECT_EQ(reference.header.frame_id, "gps");
  EXPECT_EQ(reference.time_ref, ros::Time(5, 6));
  EXPECT_EQ(reference.source, "x");
  Transcoder transcoder(withoutSequence(typeDefinition<sensor_msgs::TimeReference>()),
                        typeDefinition<sensor_msgs::TimeReference>());
  const ByteView packed =
      transcoder.convert({bytes.data(), bytes.size()}, MessageEncoding::CdrBigEndian, MessageEncoding::Ros1);
  EXPECT_EQ(Bytes(packed.data, packed.data + packed.size), serialize(reference));
}

TEST(Transcoder, MembersThatOneVersionLacksAreZeroOrLeftOut) {
  const MessageDefinition old = parseDefinition("a/B",
                                                "uint8 x\nstring gone\nC[] list\nfloat64 y\n"
                                                "=====\nMSG: a/C\nint16 v\n");
  const MessageDefinition newer = parseDefinition("a/B",
                                                  "uint8 x\nint32 added\nC[] list\nfloat64 y\nstring end\n"
                                                  "=====\nMSG: a/C\nint16 v\nuint8 w\n");
  Transcoder transcoder(old, newer);
  EXPECT_FALSE(transcoder.isSame());
  const Bytes in = {9, 2, 0, 0, 0, 'n', 'o', 1, 0, 0, 0, 5, 0, 0, 0, 0, 0, 0, 0, 0xf0, 0x3f};
  const ByteView out = transcoder.convert({in.data(), in.size()}, MessageEncoding::Ros1, MessageEncoding::Ros1);
  EXPECT_EQ(Bytes(out.data, out.data + out.size),
            (Bytes{9, 0, 0, 0, 0, 1, 0, 0, 0, 5, 0, 0, 0, 0, 0, 0, 0, 0, 0xf0, 0x3f, 0, 0, 0, 0}));
}

TEST(Transcoder, OtherTypesAndOrdersAreNamed) {
  const auto definition = [](const std::string& text) { return parseDefinition("a/B", text); };
  EXPECT_THROW(Transcoder(definition("int32 x\n"), definition("float64 x\n")), std::invalid_argument);
  EXPECT_THROW(Transcoder(definition("int32 x\n"), definition("int32[] x\n")), std::invalid_argument);
  EXPECT_THROW(Transcoder(definition("int32 x\nint32 y\n"), definition("int32 y\nint32 x\n")), std::invalid_argument);
}

TEST(Transcoder, MessagesThatAreCutOffOrDamagedAreAnErrorAtEveryByte) {
  sensor_msgs::CameraInfo info = makeCameraInfo();
  info.header = makeHeader("camera");
  const Bytes whole = toCdr(info);
  Transcoder transcoder(withoutSequence(typeDefinition<sensor_msgs::CameraInfo>()),
                        typeDefinition<sensor_msgs::CameraInfo>());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_THROW(read<sensor_msgs::CameraInfo>(cut, MessageEncoding::CdrLittleEndian), std::runtime_error) << size;
    EXPECT_THROW(transcoder.convert({cut.data(), cut.size()}, MessageEncoding::CdrLittleEndian, MessageEncoding::Ros1),
                 std::runtime_error)
        << size;
  }
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    Bytes damaged = whole;
    damaged[random() % damaged.size()] = static_cast<std::uint8_t>(random());
    try {
      read<sensor_msgs::CameraInfo>(damaged, i % 2 == 0 ? MessageEncoding::CdrLittleEndian : MessageEncoding::Ros1);
      transcoder.convert({damaged.data(), damaged.size()}, MessageEncoding::CdrLittleEndian, MessageEncoding::Ros1);
    } catch (const std::runtime_error&) {
      continue;  // nothing else is thrown, and no memory beyond the message is asked for
    }
  }
}

}  // namespace
}  // namespace urban_nav_input
