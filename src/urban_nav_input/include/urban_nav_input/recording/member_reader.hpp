// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "urban_nav_input/recording/byte_view.hpp"
#include "urban_nav_input/recording/message_definition.hpp"
#include "urban_nav_input/recording/message_encoding.hpp"

namespace urban_nav_input {

/// Reads the members of an encoded message one after another, in the order of a MessageDefinition. Does not copy: views
/// refer to the bytes of the message. All functions throw std::runtime_error if the bytes end before the member. Not
/// thread-safe.
class MemberReader {
 public:
  /// `bytes` outlive this object; those of CDR begin with the encapsulation header.
  MemberReader(ByteView bytes, MessageEncoding encoding)
      : at_(bytes.data),
        end_(bytes.data + bytes.size),
        is_cdr_(encoding != MessageEncoding::Ros1),
        is_swapped_(encoding == MessageEncoding::CdrBigEndian) {
    if (is_cdr_) take(kEncapsulation);
    begin_ = at_;
  }

  /// Returns whether the numbers are big endian.
  bool isSwapped() const { return is_swapped_; }

  /// Begins a message, also a nested one: in ROS 2, a message without members has one of a byte.
  void enter(const MessageLayout& layout) {
    if (is_cdr_ && layout.fields.empty()) take(1);
  }
  /// Returns the number of elements of a member: 1, that of a fixed array, or that of a sequence, which is at most the
  /// number of bytes that are left.
  std::size_t count(const MessageField& field) {
    if (field.array != MessageField::Array::Sequence) return field.count;
    const std::size_t elements = takeWord();
    if (elements > static_cast<std::size_t>(end_ - at_)) throwShort();
    return elements;
  }
  /// Returns `count` numbers of `size` bytes each, in the byte order of the message; the two words of a time (s, ns)
  /// are numbers of 4 bytes.
  ByteView numbers(std::size_t count, std::size_t size) {
    if (count == 0) return {at_, 0};
    if (is_cdr_) {
      const std::size_t beyond = static_cast<std::size_t>(at_ - begin_) % size;
      if (beyond != 0) take(size - beyond);
    }
    if (count > static_cast<std::size_t>(end_ - at_) / size) throwShort();
    return {take(count * size), count * size};
  }
  /// Returns a text without the zero that ends it in CDR.
  ByteView text() {
    const std::size_t size = takeWord();
    const std::uint8_t* letters = take(size);
    return {letters, is_cdr_ && size > 0 && letters[size - 1] == 0 ? size - 1 : size};
  }
  /// Returns an unsigned number of 4 bytes.
  std::uint32_t takeWord() {
    std::uint32_t word = 0;
    std::memcpy(&word, numbers(1, sizeof(word)).data, sizeof(word));
    return is_swapped_ ? __builtin_bswap32(word) : word;
  }

 private:
  static constexpr std::size_t kEncapsulation = 4;  // bytes

  [[noreturn]] static void throwShort() { throw std::runtime_error("a message ends before its last member"); }
  const std::uint8_t* take(std::size_t size) {
    if (size > static_cast<std::size_t>(end_ - at_)) throwShort();
    const std::uint8_t* taken = at_;
    at_ += size;
    return taken;
  }

  const std::uint8_t* at_;
  const std::uint8_t* end_;
  const std::uint8_t* begin_ = nullptr;  // alignment counts from here
  bool is_cdr_, is_swapped_;
};

}  // namespace urban_nav_input
