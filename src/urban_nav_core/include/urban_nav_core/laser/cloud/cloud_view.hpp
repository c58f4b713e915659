// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// A field that each point of a cloud has.
struct CloudField {
  /// Kinds of numbers, counted as sensor_msgs/PointField does.
  enum class Number : std::uint8_t { Int8 = 1, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };

  std::string name;
  std::uint32_t offset = 0;  ///< bytes from the begin of a point
  Number number = Number::Float32;
  std::uint32_t count = 1;  ///< numbers of a point; only fields with one of them are read
};

/// A cloud as a message holds it: the fields of each point in a record of bytes, the records in rows. Does not own the
/// bytes, and promises nothing: CloudPoints checks all of it.
struct CloudView {
  StampNs stamp = 0;                    ///< of the header
  std::uint32_t width = 0, height = 0;  ///< points of a row, rows
  std::size_t point_step = 0;           ///< bytes from a point to the next one
  std::size_t row_step = 0;             ///< bytes from a row to the next one
  bool is_big_endian = false;
  std::vector<CloudField> fields;
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;  ///< bytes of data
};

/// The points of a cloud that can be read. The view and its bytes outlive this object. Safe for concurrent reading.
class CloudPoints {
 public:
  /// The numbers of one field.
  class Field {
   public:
    Field() = default;
    Field(const CloudField& field, bool is_big_endian);

    /// Returns whether the cloud has the field.
    explicit operator bool() const { return size_ > 0; }
    /// Returns the number of a point, given its first byte; NaN without the field.
    double operator()(const std::uint8_t* point) const;

   private:
    std::size_t offset_ = 0, size_ = 0;  // bytes
    CloudField::Number number_ = CloudField::Number::Float32;
    bool is_swapped_ = false;
  };

  /// Steps of rows that the data contradict (0, or for all rows at once) are replaced by those of rows without gaps.
  explicit CloudPoints(const CloudView& cloud);

  /// Returns why no point can be read: fields or bytes that are missing. Empty: they can be, if there are any.
  const std::string& fault() const { return fault_; }
  /// Returns the number of points whose bytes are there.
  std::size_t size() const { return size_; }
  /// Returns the number of points that are announced without bytes.
  std::size_t missing() const { return missing_; }
  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  /// Returns the first byte of a point, 0 ... size() - 1, row by row.
  const std::uint8_t* at(std::size_t point) const {
    return cloud_.data + point / columns_ * row_step_ + point % columns_ * cloud_.point_step;
  }
  /// Returns the field of a name; one without numbers if it is missing or lies outside the record of a point.
  Field field(std::string_view name) const;
  const CloudView& cloud() const { return cloud_; }

 private:
  const CloudView& cloud_;
  std::string fault_;
  std::size_t columns_ = 1, rows_ = 0, row_step_ = 0, size_ = 0, missing_ = 0;
};

/// Returns the bytes of a number.
std::size_t numberSize(CloudField::Number number);

}  // namespace urban_nav_core
