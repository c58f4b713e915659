// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/bytes.hpp"

#include <cstring>

namespace urban_nav_store {

namespace {

template <typename Unsigned>
void append(std::string& bytes, Unsigned value) {
  char raw[sizeof value];
  for (std::size_t i = 0; i < sizeof value; ++i) raw[i] = static_cast<char>((value >> (8 * i)) & 0xffU);
  bytes.append(raw, sizeof value);
}

template <typename Unsigned>
Unsigned read(std::string_view bytes) {
  Unsigned value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    value |= static_cast<Unsigned>(static_cast<unsigned char>(bytes[i])) << (8 * i);
  return value;
}

}  // namespace

void appendInteger(std::string& bytes, std::uint64_t value) { append(bytes, value); }
void appendInteger32(std::string& bytes, std::uint32_t value) { append(bytes, value); }

void appendNumber(std::string& bytes, double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  append(bytes, bits);
}

void appendFloat(std::string& bytes, float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  append(bytes, bits);
}

void appendText(std::string& bytes, std::string_view text) {
  append(bytes, static_cast<std::uint64_t>(text.size()));
  bytes += text;
}

std::string_view ByteReader::take(std::size_t size) {
  if (!ok_ || size > bytes_.size()) {
    ok_ = false;
    return {};
  }
  const std::string_view taken = bytes_.substr(0, size);
  bytes_.remove_prefix(size);
  return taken;
}

std::uint64_t ByteReader::integer() { return read<std::uint64_t>(take(sizeof(std::uint64_t))); }
std::uint32_t ByteReader::integer32() { return read<std::uint32_t>(take(sizeof(std::uint32_t))); }

double ByteReader::number() {
  const std::uint64_t bits = integer();
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

float ByteReader::real32() {
  const std::uint32_t bits = integer32();
  float value = 0.0F;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

std::string_view ByteReader::text() {
  const std::uint64_t size = integer();
  return take(static_cast<std::size_t>(size));
}

}  // namespace urban_nav_store
