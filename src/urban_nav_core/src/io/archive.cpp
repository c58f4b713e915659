// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/archive.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {

namespace {

constexpr char kMagic[] = "urban_nav state\n";
constexpr std::size_t kMagicSize = sizeof(kMagic) - 1;
constexpr std::size_t kChecksumSize = 8;

void toLittleEndian(char* bytes, std::size_t width, std::size_t size) {
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
  for (std::size_t i = 0; i < size; ++i) std::reverse(bytes + i * width, bytes + (i + 1) * width);
#else
  static_cast<void>(bytes), static_cast<void>(width), static_cast<void>(size);
#endif
}

/// FNV-1a of 64 bits (Fowler, Noll, Vo; RFC 9923): each step is a bijection of the state, so any single changed byte is
/// detected.
std::string checksum(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  std::string text;
  for (std::size_t i = 0; i < kChecksumSize; ++i) text += static_cast<char>(hash >> (8 * i) & 0xffU);
  return text;
}

template <typename Number>
bool areFinite(const Number* values, std::size_t size) {
  return std::all_of(values, values + size, [](Number value) { return std::isfinite(value); });
}

}  // namespace

void Archive::refuse(const char* found) const { throw DataError(what_, std::string("is damaged: ") + found, ""); }

void Archive::bytes(void* data, std::size_t width, std::size_t size) {
  if (size == 0) return;
  if (!reading_) {
    const std::size_t at = written_.size();
    written_.append(static_cast<const char*>(data), width * size);
    toLittleEndian(written_.data() + at, width, size);
    return;
  }
  require(size <= left_.size() / width, "it is truncated");
  std::memcpy(data, left_.data(), width * size);
  toLittleEndian(static_cast<char*>(data), width, size);
  left_.remove_prefix(width * size);
}

void Archive::integer(std::int64_t& value, std::int64_t least, std::int64_t most) {
  bytes(&value, sizeof(value), 1);
  require(value >= least && value <= most, "an integer is out of range");
}

void Archive::count(std::size_t& value, std::size_t least) {
  one(value);
  require(value <= left_.size() / std::max<std::size_t>(least, 1), "it has fewer elements than its count");
}

void Archive::numbers(double* values, std::size_t size) {
  bytes(values, sizeof(*values), size);
  require(areFinite(values, size), "a number is not finite");
}

void Archive::numbers(float* values, std::size_t size) {
  bytes(values, sizeof(*values), size);
  require(areFinite(values, size), "a number is not finite");
}

void Archive::one(Pose& value) {
  Quaterniond::Coefficients q = value.q().coeffs();
  Vector3d t = value.t();
  one(q);
  one(t);
  if (!reading_) return;
  require(std::abs(q.squaredNorm() - 1.0) < 1e-9, "a quaternion is not of unit length");
  value = Pose(Quaterniond(q), t);
  require(value.q().coeffs() == q, "a quaternion is not of unit length");
}

void Archive::one(std::string& value) {
  std::size_t size = value.size();
  count(size);
  if (reading_) value.resize(size);
  bytes(value.data(), 1, size);
}

std::string seal(std::string_view what, std::uint32_t version, std::string_view content) {
  Archive head;
  std::string name(what);
  head(name, version);
  std::string sealed = kMagic + head.take();
  sealed += content;
  return sealed + checksum(sealed);
}

bool isSealed(std::string_view bytes) { return bytes.substr(0, kMagicSize) == kMagic; }

UnsealedState unseal(std::string_view what, std::uint32_t oldest, std::uint32_t newest, std::string_view sealed) {
  const std::string where = "state of " + std::string(what);
  if (!isSealed(sealed)) throw DataError(where, "is not a saved state", "");
  if (sealed.size() < kMagicSize + kChecksumSize ||
      checksum(sealed.substr(0, sealed.size() - kChecksumSize)) != sealed.substr(sealed.size() - kChecksumSize))
    throw DataError(where, "is damaged: its checksum does not match", "");
  const std::string_view body = sealed.substr(kMagicSize, sealed.size() - kMagicSize - kChecksumSize);
  Archive head(body, where);
  std::string name;
  std::uint32_t found = 0;
  head(name, found);
  if (name != what) throw DataError(where, "is the state of " + name, "one of " + std::string(what));
  if (found < oldest || found > newest)
    throw DataError(where, "is of version " + std::to_string(found),
                    "version " + (oldest < newest ? std::to_string(oldest) + "..." : "") + std::to_string(newest));
  Archive again;
  again(name, found);
  return {found, body.substr(again.take().size())};
}

std::string_view unseal(std::string_view what, std::uint32_t version, std::string_view sealed) {
  return unseal(what, version, version, sealed).content;
}

}  // namespace urban_nav_core
