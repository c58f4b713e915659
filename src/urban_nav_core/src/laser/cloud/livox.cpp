// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/laser/cloud/livox.hpp"

namespace urban_nav_core {

namespace {

constexpr std::size_t kEncapsulation = 4;                       // bytes before a message in CDR
constexpr std::size_t kPointSize = 19, kPointSizeAligned = 20;  // bytes; the last point in CDR has no padding

/// Reads numbers in sequence. After the end of the data, all are 0.
class Cursor {
 public:
  Cursor(const std::uint8_t* bytes, std::size_t size, LivoxEncoding encoding)
      : bytes_(bytes), size_(size), is_aligned_(encoding != LivoxEncoding::Ros1) {
    is_big_endian_ = encoding == LivoxEncoding::CdrBigEndian;
    if (is_aligned_) begin_ = kEncapsulation;
    at_ = begin_;
    is_whole_ = at_ <= size_;
  }

  std::uint64_t number(std::size_t width) {
    if (is_aligned_ && (at_ - begin_) % width != 0) skip(width - (at_ - begin_) % width);
    const std::size_t from = at_;
    skip(width);
    std::uint64_t value = 0;
    for (std::size_t i = 0; is_whole_ && i < width; ++i)
      value |= static_cast<std::uint64_t>(bytes_[from + i]) << 8U * (is_big_endian_ ? width - 1 - i : i);
    return value;
  }
  std::string text() {
    const auto length = static_cast<std::size_t>(number(4));
    const std::size_t from = at_;
    skip(length);
    if (!is_whole_) return {};
    std::string text(bytes_ + from, bytes_ + from + length);
    if (!text.empty() && text.back() == '\0') text.pop_back();
    return text;
  }
  void skip(std::size_t count) {
    is_whole_ = is_whole_ && count <= size_ - at_;
    if (is_whole_) at_ += count;
  }
  std::size_t at() const { return at_; }
  bool isWhole() const { return is_whole_; }

 private:
  const std::uint8_t* bytes_;
  std::size_t size_, begin_ = 0, at_ = 0;
  bool is_aligned_, is_big_endian_ = false, is_whole_ = true;
};

}  // namespace

std::optional<LivoxCloud> parseLivox(const std::uint8_t* bytes, std::size_t size, LivoxEncoding encoding) {
  Cursor cursor(bytes, size, encoding);
  if (encoding == LivoxEncoding::Ros1) cursor.number(4);  // header.seq
  const std::uint64_t seconds = cursor.number(4), nanoseconds = cursor.number(4);
  LivoxCloud cloud;
  cloud.frame = cursor.text();
  cursor.number(8);  // timebase: beginning of the frame on the sensor's clock; the header has that of the host
  cursor.number(4);  // point_num
  cursor.skip(4);    // lidar_id, rsvd
  const std::uint64_t count = cursor.number(4);
  if (!cursor.isWhole()) return std::nullopt;
  CloudView& view = cloud.view;
  view.stamp = static_cast<StampNs>(seconds * 1'000'000'000U + nanoseconds);
  view.width = static_cast<std::uint32_t>(count);
  view.height = 1;
  view.point_step = encoding == LivoxEncoding::Ros1 ? kPointSize : kPointSizeAligned;
  view.row_step = view.point_step * view.width;
  view.is_big_endian = encoding == LivoxEncoding::CdrBigEndian;
  using Number = CloudField::Number;
  view.fields = {{"offset_time", 0, Number::UInt32}, {"x", 4, Number::Float32},           {"y", 8, Number::Float32},
                 {"z", 12, Number::Float32},         {"reflectivity", 16, Number::UInt8}, {"tag", 17, Number::UInt8},
                 {"line", 18, Number::UInt8}};
  view.data = bytes + cursor.at();
  view.size = size - cursor.at();
  return cloud;
}

std::string livoxDefinition(const std::string& package) {
  return "std_msgs/Header header\n"
         "uint64 timebase\n"
         "uint32 point_num\n"
         "uint8 lidar_id\n"
         "uint8[3] rsvd\n"
         "CustomPoint[] points\n"
         "================================================================================\n"
         "MSG: std_msgs/Header\n"
         "uint32 seq\n"
         "time stamp\n"
         "string frame_id\n"
         "================================================================================\n"
         "MSG: " +
         package +
         "/CustomPoint\n"
         "uint32 offset_time\n"
         "float32 x\n"
         "float32 y\n"
         "float32 z\n"
         "uint8 reflectivity\n"
         "uint8 tag\n"
         "uint8 line\n";
}

}  // namespace urban_nav_core
