// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace urban_nav_core {

class Pose;

/// Serialises the state of an object to bytes and back. A class lists its members once, in one function for both
/// directions, so that writing and reading cannot differ:
///
///   void HealthMonitor::archive(Archive& archive) { archive(was_lost_); }
///
/// Supports bool, integers and enumerators (8 bytes each), double, float, text, matrices of fixed size, poses; arrays,
/// vectors, pairs and optionals of these; and types with such a member or a function `archive(Archive&, T&)` in their
/// namespace. Little-endian on every machine, bit-exact.
///
/// Input is validated: element counts against the remaining bytes, integers against half the range of their type (so
/// that counters do not overflow), numbers must be finite, quaternions of unit length; `require` is for further
/// invariants of a class. Violations throw DataError "is damaged"; the object being read is then in an unspecified
/// state and must not be used. Not thread-safe.
class Archive {
 public:
  /// Creates an archive for writing.
  Archive() = default;
  /// Creates an archive for reading `bytes`, which must outlive it. `what`: name of the content ("state of swf_vo"),
  /// for errors.
  Archive(std::string_view bytes, std::string what) : reading_(true), what_(std::move(what)), left_(bytes) {}

  bool isReading() const { return reading_; }
  /// Returns the written bytes.
  std::string take() { return std::move(written_); }

  template <typename... Values>
  void operator()(Values&... values) {
    (one(values), ...);
  }

  /// Reading: throws DataError unless the condition holds; `found` describes the content instead. Writing: no effect.
  void require(bool holds, const char* found) const {
    if (reading_ && !holds) refuse(found);
  }
  /// Reading: throws DataError if bytes are left over.
  void finish() const { require(left_.empty(), "it has trailing bytes"); }

  /// Reads or writes an element count; each element takes at least `least` bytes.
  void count(std::size_t& value, std::size_t least = 1);

 private:
  template <typename T, typename = void>
  struct HasMember : std::false_type {};
  template <typename T>
  struct HasMember<T, std::void_t<decltype(std::declval<T&>().archive(std::declval<Archive&>()))>> : std::true_type {};

  template <typename T>
  void one(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      std::int64_t number = value ? 1 : 0;
      integer(number, 0, 1);
      value = number != 0;
    } else if constexpr (std::is_enum_v<T>) {
      auto number = static_cast<std::underlying_type_t<T>>(value);
      one(number);
      value = static_cast<T>(number);
    } else if constexpr (std::is_integral_v<T>) {
      auto number = static_cast<std::int64_t>(value);
      using Limits = std::numeric_limits<T>;
      constexpr T kPart = sizeof(T) < 4 ? 1 : 2;
      constexpr bool kWide = sizeof(T) == sizeof(std::int64_t) && !std::is_signed_v<T>;
      integer(number, static_cast<std::int64_t>(Limits::min() / kPart),
              static_cast<std::int64_t>(Limits::max() / (kWide ? 2 * kPart : kPart)));
      value = static_cast<T>(number);
    } else if constexpr (std::is_floating_point_v<T>) {
      numbers(&value, 1);
    } else if constexpr (HasMember<T>::value) {
      value.archive(*this);
    } else {
      archive(*this, value);
    }
  }
  template <typename Scalar, int rows, int columns>
  void one(Eigen::Matrix<Scalar, rows, columns>& value) {
    static_assert(rows != Eigen::Dynamic && columns != Eigen::Dynamic);
    numbers(value.data(), static_cast<std::size_t>(rows * columns));
  }
  void one(Pose& value);
  void one(std::string& value);
  template <typename T, std::size_t size>
  void one(std::array<T, size>& values) {
    all(values.data(), size);
  }
  template <typename T>
  void one(std::vector<T>& values) {
    std::size_t size = values.size();
    count(size, std::is_same_v<T, float> ? 4 : 1);
    if constexpr (std::is_arithmetic_v<T>) {
      if (reading_) values.resize(size);
      all(values.data(), size);
    } else {
      if (reading_) values.clear();
      for (std::size_t i = 0; i < size; ++i) {
        if (reading_) values.emplace_back();  // one by one: the count may be corrupt
        one(values[i]);
      }
    }
  }
  template <typename A, typename B>
  void one(std::pair<A, B>& value) {
    one(value.first);
    one(value.second);
  }
  template <typename T>
  void one(std::optional<T>& value) {
    bool is_there = value.has_value();
    one(is_there);
    if (reading_ && !is_there) value.reset();
    if (reading_ && is_there) value.emplace();
    if (is_there) one(*value);
  }
  template <typename T>
  void all(T* values, std::size_t size) {
    if constexpr (std::is_floating_point_v<T>) numbers(values, size);
    else if constexpr (std::is_integral_v<T> && sizeof(T) == 1) bytes(values, 1, size);
    else
      for (std::size_t i = 0; i < size; ++i) one(values[i]);
  }

  void integer(std::int64_t& value, std::int64_t least, std::int64_t most);
  void numbers(double* values, std::size_t size);
  void numbers(float* values, std::size_t size);
  void bytes(void* data, std::size_t width, std::size_t size);
  [[noreturn]] void refuse(const char* found) const;

  bool reading_ = false;
  std::string what_;
  std::string_view left_;  // still to be read
  std::string written_;
};

/// Returns the bytes of a state with its name, its version and a checksum.
std::string seal(std::string_view what, std::uint32_t version, std::string_view content);

/// State whose name and checksum have been verified.
struct UnsealedState {
  std::uint32_t version = 0;
  std::string_view content;  ///< part of the bytes given to unseal()
};
/// Reads a sealed state of any version from `oldest` to `newest`. Throws DataError that names the fault if the bytes
/// are damaged, belong to another state or have another version.
UnsealedState unseal(std::string_view what, std::uint32_t oldest, std::uint32_t newest, std::string_view sealed);
/// Returns the content of a sealed state of exactly this version. Throws DataError if the bytes are damaged, belong to
/// another state or have another version.
std::string_view unseal(std::string_view what, std::uint32_t version, std::string_view sealed);
/// Returns whether the bytes begin like those of seal(); older states have formats of their own.
bool isSealed(std::string_view bytes);

}  // namespace urban_nav_core
