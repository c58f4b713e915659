// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace segway_drivers {

/// Host time, ns, on the clock of the transport.
using TimeNs = std::int64_t;

using Bytes = std::vector<std::uint8_t>;

/// Non-owning view of bytes.
struct ByteView {
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;

  ByteView() = default;
  ByteView(const std::uint8_t* data_in, std::size_t size_in) : data(data_in), size(size_in) {}
  ByteView(const Bytes& bytes) : data(bytes.data()), size(bytes.size()) {}  // NOLINT: a view of its argument

  std::uint8_t operator[](std::size_t i) const { return data[i]; }
  ByteView sub(std::size_t begin, std::size_t count) const { return {data + begin, count}; }
  const std::uint8_t* begin() const { return data; }
  const std::uint8_t* end() const { return data + size; }
};

/// Read little-endian and big-endian words. The bytes must exist.
std::uint16_t littleWord(const std::uint8_t* bytes);
std::uint32_t littleWord32(const std::uint8_t* bytes);
std::uint16_t bigWord(const std::uint8_t* bytes);
std::uint32_t bigWord32(const std::uint8_t* bytes);
/// Read IEEE 754 numbers.
float littleFloat(const std::uint8_t* bytes);
double littleDouble(const std::uint8_t* bytes);
float bigFloat(const std::uint8_t* bytes);
double bigDouble(const std::uint8_t* bytes);

void appendLittle(Bytes& bytes, std::uint16_t word);
void appendBig(Bytes& bytes, std::uint16_t word);
void appendBig32(Bytes& bytes, std::uint32_t word);

/// Returns "02 00 1F": upper-case hexadecimal bytes separated by blanks.
std::string printHex(ByteView bytes);
/// Inverse of printHex; blanks are optional. Returns nullopt for text other than hexadecimal bytes.
std::optional<Bytes> parseHex(std::string_view text);

}  // namespace segway_drivers
