// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/laser/cloud/cloud_view.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

namespace urban_nav_core {

namespace {

constexpr bool kIsBigEndianMachine = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;

template <typename T>
double toDouble(const std::uint8_t* bytes, bool is_swapped) {
  std::array<std::uint8_t, sizeof(T)> copy;
  std::memcpy(copy.data(), bytes, sizeof(T));
  if (is_swapped) std::reverse(copy.begin(), copy.end());
  T value;
  std::memcpy(&value, copy.data(), sizeof(T));
  return static_cast<double>(value);
}

bool isReadable(const CloudField& field, std::size_t point_step) {
  const std::size_t size = numberSize(field.number);
  return size > 0 && field.count <= 1 && field.offset <= point_step && size <= point_step - field.offset;
}

}  // namespace

std::size_t numberSize(CloudField::Number number) {
  switch (number) {
    case CloudField::Number::Int8:
    case CloudField::Number::UInt8: return 1;
    case CloudField::Number::Int16:
    case CloudField::Number::UInt16: return 2;
    case CloudField::Number::Int32:
    case CloudField::Number::UInt32:
    case CloudField::Number::Float32: return 4;
    case CloudField::Number::Float64: return 8;
  }
  return 0;  // number type unknown to messages
}

CloudPoints::Field::Field(const CloudField& field, bool is_big_endian)
    : offset_(field.offset),
      size_(numberSize(field.number)),
      number_(field.number),
      is_swapped_(is_big_endian != kIsBigEndianMachine) {}

double CloudPoints::Field::operator()(const std::uint8_t* point) const {
  if (size_ == 0) return std::numeric_limits<double>::quiet_NaN();
  const std::uint8_t* bytes = point + offset_;
  switch (number_) {
    case CloudField::Number::Int8: return toDouble<std::int8_t>(bytes, is_swapped_);
    case CloudField::Number::UInt8: return toDouble<std::uint8_t>(bytes, is_swapped_);
    case CloudField::Number::Int16: return toDouble<std::int16_t>(bytes, is_swapped_);
    case CloudField::Number::UInt16: return toDouble<std::uint16_t>(bytes, is_swapped_);
    case CloudField::Number::Int32: return toDouble<std::int32_t>(bytes, is_swapped_);
    case CloudField::Number::UInt32: return toDouble<std::uint32_t>(bytes, is_swapped_);
    case CloudField::Number::Float32: return toDouble<float>(bytes, is_swapped_);
    case CloudField::Number::Float64: return toDouble<double>(bytes, is_swapped_);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

CloudPoints::CloudPoints(const CloudView& cloud) : cloud_(cloud) {
  for (const char* name : {"x", "y", "z"})
    if (!field(name)) fault_ = std::string("has no field ") + name + " with one number";
  if (!fault_.empty()) return;
  std::size_t record = 0;  // bytes of a point up to the end of its last field: the last point may end there
  for (const CloudField& each : cloud.fields)
    if (isReadable(each, cloud.point_step)) record = std::max(record, each.offset + numberSize(each.number));
  columns_ = std::max<std::size_t>(1, cloud.width);
  rows_ = cloud.width == 0 ? 0 : cloud.height;
  if (cloud.data == nullptr || cloud.size < record) {
    missing_ = rows_ == 0 ? 0 : columns_ * rows_;
    return;
  }
  const std::size_t most = (cloud.size - record) / cloud.point_step + 1;  // consecutive points
  if (columns_ > most) {                                                  // less than one row
    missing_ = rows_ == 0 ? 0 : columns_ * rows_ - most;
    size_ = rows_ == 0 ? 0 : most;
    row_step_ = cloud.point_step * columns_;
    return;
  }
  const std::size_t packed = cloud.point_step * columns_, last = packed - cloud.point_step + record;
  const auto whole_rows = [&](std::size_t step) { return (cloud.size - last) / step + 1; };
  row_step_ = cloud.row_step < packed || whole_rows(cloud.row_step) < rows_ ? packed : cloud.row_step;
  const std::size_t there = std::min(rows_, whole_rows(row_step_));
  size_ = there * columns_;
  missing_ = (rows_ - there) * columns_;
}

CloudPoints::Field CloudPoints::field(std::string_view name) const {
  for (const CloudField& each : cloud_.fields)
    if (each.name == name && isReadable(each, cloud_.point_step)) return Field(each, cloud_.is_big_endian);
  return {};
}

}  // namespace urban_nav_core
