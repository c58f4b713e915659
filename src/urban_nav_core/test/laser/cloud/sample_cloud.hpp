// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "urban_nav_core/laser/cloud/cloud_view.hpp"

namespace urban_nav_core::testing {

constexpr StampNs kBegin = 1'500'000'000'000'000'000;  // of the first sweep
constexpr StampNs kPeriod = 100'000'000;               // ns, from sweep to sweep

/// A point that a spinning sensor in a room measures.
struct SamplePoint {
  double x = 0.0, y = 0.0, z = 0.0;  ///< m
  double share = 0.0;                ///< of the sweep that has passed, 0...1
  int ring = 0;                      ///< from the lowest
  int column = 0;
};

/// One revolution, column by column, clockwise from the back: 10 m from the axis, rings 2 deg apart.
inline std::vector<SamplePoint> sampleTurn(int rings = 16, int columns = 360) {
  std::vector<SamplePoint> points;
  for (int column = 0; column < columns; ++column)
    for (int ring = 0; ring < rings; ++ring) {
      SamplePoint point;
      point.share = (column + 0.5) / columns;
      const double azimuth = M_PI - 2.0 * M_PI * point.share, elevation = (2.0 * ring - rings) * M_PI / 180.0;
      const double range = 8.0 + 2.0 * std::cos(2.0 * azimuth);
      point.x = range * std::cos(azimuth);
      point.y = range * std::sin(azimuth);
      point.z = range * std::tan(elevation);
      point.ring = ring;
      point.column = column;
      points.push_back(point);
    }
  return points;
}

/// Field of a layout with its value for a point, given the stamp of the header (ns) and the beginning of the sweep
/// (ns).
struct SampleField {
  using Value = std::function<double(const SamplePoint& point, double header, double begin)>;
  CloudField field;
  Value value;
};

/// Cloud that owns the bytes of its view.
class SampleCloud {
 public:
  /// `header`: of the cloud, ns after the begin of the sweep.
  SampleCloud(const std::vector<SamplePoint>& points, const std::vector<SampleField>& fields, std::size_t point_step,
              StampNs begin, StampNs header, bool is_big_endian = false) {
    view_.stamp = begin + header;
    view_.width = static_cast<std::uint32_t>(points.size());
    view_.height = 1;
    view_.point_step = point_step;
    view_.row_step = point_step * points.size();
    view_.is_big_endian = is_big_endian;
    bytes_.assign(view_.row_step, 0);
    for (const SampleField& field : fields) {
      view_.fields.push_back(field.field);
      for (std::size_t i = 0; i < points.size(); ++i)
        write(&bytes_[i * point_step + field.field.offset], field.field.number,
              field.value(points[i], static_cast<double>(view_.stamp), static_cast<double>(begin)));
    }
  }

  /// Returns the view, which may be modified; its bytes are those of this object.
  CloudView& view() {
    view_.data = bytes_.data();
    view_.size = bytes_.size();
    return view_;
  }
  std::vector<std::uint8_t>& bytes() { return bytes_; }

 private:
  template <typename T>
  void put(std::uint8_t* place, double value) const {
    const T number = static_cast<T>(value);
    std::memcpy(place, &number, sizeof(T));
    if (view_.is_big_endian)
      for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(place[i], place[sizeof(T) - 1 - i]);
  }
  void write(std::uint8_t* place, CloudField::Number number, double value) const {
    using Number = CloudField::Number;
    switch (number) {
      case Number::Int8: return put<std::int8_t>(place, value);
      case Number::UInt8: return put<std::uint8_t>(place, value);
      case Number::Int16: return put<std::int16_t>(place, value);
      case Number::UInt16: return put<std::uint16_t>(place, value);
      case Number::Int32: return put<std::int32_t>(place, value);
      case Number::UInt32: return put<std::uint32_t>(place, value);
      case Number::Float32: return put<float>(place, value);
      case Number::Float64: return put<double>(place, value);
    }
  }

  CloudView view_;
  std::vector<std::uint8_t> bytes_;
};

/// Fields x, y, z (float32, m) at the begin of a point, and further ones.
inline std::vector<SampleField> withPlaces(std::vector<SampleField> more) {
  using Number = CloudField::Number;
  std::vector<SampleField> fields = {
      {{"x", 0, Number::Float32}, [](const SamplePoint& p, double, double) { return p.x; }},
      {{"y", 4, Number::Float32}, [](const SamplePoint& p, double, double) { return p.y; }},
      {{"z", 8, Number::Float32}, [](const SamplePoint& p, double, double) { return p.z; }}};
  fields.insert(fields.end(), more.begin(), more.end());
  return fields;
}

/// Field with ring numbers from the lowest.
inline SampleField ringField(const char* name, std::uint32_t offset, CloudField::Number number) {
  return {{name, offset, number}, [](const SamplePoint& p, double, double) { return p.ring; }};
}

}  // namespace urban_nav_core::testing
