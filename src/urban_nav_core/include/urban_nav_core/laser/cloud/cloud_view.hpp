// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// Field of the points of a cloud.
struct CloudField {
  /// Kinds of numbers, counted as sensor_msgs/PointField does.
  enum class Number : std::uint8_t { Int8 = 1, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };

  std::string name;
  std::uint32_t offset = 0;  ///< bytes from the beginning of a point
  Number number = Number::Float32;
  std::uint32_t count = 1;  ///< numbers per point; only fields with one are read
};

/// Non-owning view of a cloud in its message form: each point is a record of bytes, records are in rows. Contents are
/// unchecked; CloudPoints validates them.
struct CloudView {
  StampNs stamp = 0;                    ///< of the header
  std::uint32_t width = 0, height = 0;  ///< points per row, rows
  std::size_t point_step = 0;           ///< bytes from a point to the next one
  std::size_t row_step = 0;             ///< bytes from a row to the next one
  bool is_big_endian = false;
  std::vector<CloudField> fields;
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;  ///< bytes of data
};

/// Readable points of a cloud. The view and its bytes must outlive this object. Thread-safe for reading.
class CloudPoints {
 public:
  /// Numbers of one field.
  class Field {
   public:
    Field() = default;
    Field(const CloudField& field, bool is_big_endian);

    /// Returns whether the cloud has the field.
    explicit operator bool() const { return size_ > 0; }
    /// Returns the field's number of a point, given the point's first byte; NaN without the field.
    double operator()(const std::uint8_t* point) const;

   private:
    std::size_t offset_ = 0, size_ = 0;  // bytes
    CloudField::Number number_ = CloudField::Number::Float32;
    bool is_swapped_ = false;
  };

  /// A row step that contradicts the data (0, or the size of all rows) is replaced by that of rows without gaps.
  explicit CloudPoints(const CloudView& cloud);

  /// Returns why no point can be read: fields or bytes that are missing. Empty if points can be read.
  const std::string& fault() const { return fault_; }
  /// Returns the number of points whose bytes are present.
  std::size_t size() const { return size_; }
  /// Returns the number of declared points whose bytes are missing.
  std::size_t missing() const { return missing_; }
  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  /// Returns the first byte of a point, 0 ... size() - 1, row by row.
  const std::uint8_t* at(std::size_t point) const {
    return cloud_.data + point / columns_ * row_step_ + point % columns_ * cloud_.point_step;
  }
  /// Returns the field of this name; an empty one if it is missing or lies outside a point's record.
  Field field(std::string_view name) const;
  const CloudView& cloud() const { return cloud_; }

 private:
  const CloudView& cloud_;
  std::string fault_;
  std::size_t columns_ = 1, rows_ = 0, row_step_ = 0, size_ = 0, missing_ = 0;
};

/// Returns the size of a number in bytes.
std::size_t numberSize(CloudField::Number number);

}  // namespace urban_nav_core
