// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/serialization.h>
#include <std_msgs/Header.h>

#include <algorithm>
#include <boost/array.hpp>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "urban_nav_input/recording/byte_view.hpp"
#include "urban_nav_input/recording/message_encoding.hpp"

namespace urban_nav_input {

/// Input stream for the generated serializers of ROS 1 messages, for both ROS 1 and ROS 2. Members are equal except
/// Header.seq, which is missing in CDR and becomes 0. Throws std::runtime_error if the bytes end before the message.
class MessageStream {
 public:
  /// `bytes` outlive this object; those of CDR begin with the encapsulation header.
  MessageStream(ByteView bytes, MessageEncoding encoding)
      : at_(bytes.data),
        end_(bytes.data + bytes.size),
        is_cdr_(encoding != MessageEncoding::Ros1),
        is_swapped_(encoding == MessageEncoding::CdrBigEndian) {
    if (is_cdr_) take(kEncapsulation);
    begin_ = at_;
  }

  template <typename T>
  void next(T& value) {
    if constexpr (std::is_arithmetic_v<T>) readNumbers(&value, 1);
    else ros::serialization::Serializer<T>::template allInOne<MessageStream, T&>(*this, value);
  }
  template <typename Allocator>
  void next(std_msgs::Header_<Allocator>& header) {
    header.seq = 0;
    if (!is_cdr_) next(header.seq);
    next(header.stamp);
    next(header.frame_id);
  }
  void next(ros::Time& time) {
    next(time.sec);
    next(time.nsec);
  }
  void next(ros::Duration& duration) {
    next(duration.sec);
    next(duration.nsec);
  }
  template <typename Traits, typename Allocator>
  void next(std::basic_string<char, Traits, Allocator>& text) {
    const std::size_t size = readCount();
    const auto* characters = reinterpret_cast<const char*>(take(size));
    text.assign(characters, is_cdr_ && size > 0 && characters[size - 1] == '\0' ? size - 1 : size);
  }
  template <typename T, typename Allocator>
  void next(std::vector<T, Allocator>& values) {
    const std::size_t count = readCount();
    if constexpr (std::is_arithmetic_v<T>) {
      if (count > 0) align(sizeof(T));
      require(count, sizeof(T));
      if (is_swapped_) {
        values.resize(count);
        readNumbers(values.data(), count);
      } else {
        assign(values, count);
      }
    } else {
      require(count, 1);
      values.resize(count);
      for (T& value : values) next(value);
    }
  }
  template <typename T, std::size_t kSize>
  void next(boost::array<T, kSize>& values) {
    if constexpr (std::is_arithmetic_v<T>) {
      readNumbers(values.data(), kSize);
    } else {
      for (T& value : values) next(value);
    }
  }

 private:
  static constexpr std::size_t kEncapsulation = 4;  // bytes

  void require(std::size_t count, std::size_t size) const {
    if (count > static_cast<std::size_t>(end_ - at_) / size)
      throw std::runtime_error("a message ends before its last member");
  }
  const std::uint8_t* take(std::size_t size) {
    require(size, 1);
    const std::uint8_t* taken = at_;
    at_ += size;
    return taken;
  }
  void align(std::size_t size) {
    if (!is_cdr_) return;
    const std::size_t beyond = static_cast<std::size_t>(at_ - begin_) % size;
    if (beyond != 0) take(size - beyond);
  }
  template <typename T>
  void readNumbers(T* values, std::size_t count) {
    align(sizeof(T));
    require(count, sizeof(T));
    std::memcpy(values, take(count * sizeof(T)), count * sizeof(T));
    if (!is_swapped_ || sizeof(T) == 1) return;
    for (std::size_t i = 0; i < count; ++i) {
      auto* bytes = reinterpret_cast<std::uint8_t*>(values + i);
      std::reverse(bytes, bytes + sizeof(T));
    }
  }
  /// Does not zero-initialise pixels and points.
  template <typename T, typename Allocator>
  void assign(std::vector<T, Allocator>& values, std::size_t count) {
    const std::uint8_t* bytes = take(count * sizeof(T));
    if constexpr (sizeof(T) == 1) {
      values.assign(reinterpret_cast<const T*>(bytes), reinterpret_cast<const T*>(bytes) + count);
    } else {
      values.resize(count);
      if (count > 0) std::memcpy(values.data(), bytes, count * sizeof(T));
    }
  }
  std::size_t readCount() {
    std::uint32_t count = 0;
    next(count);
    return count;
  }

  const std::uint8_t* at_;
  const std::uint8_t* end_;
  const std::uint8_t* begin_ = nullptr;  // alignment counts from here
  bool is_cdr_, is_swapped_;
};

}  // namespace urban_nav_input
