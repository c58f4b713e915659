// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include "formats.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core::cloud_formats {
namespace {

constexpr BinaryNumber kU8{1, 'U'}, kU16{2, 'U'}, kU32{4, 'U'}, kU64{8, 'U'}, kI32{4, 'I'}, kF64{8, 'F'};
constexpr std::size_t kOldHeader = 227;  // bytes, of version 1.2
constexpr std::size_t kNewHeader = 375;  // of version 1.4
constexpr std::size_t kLeastRecord = 20;

/// Fields of the public header block that reading points requires (ASPRS, LAS Specification 1.4 R15, section 2.4).
struct LasHeader {
  std::size_t points_at = 0, record = 0, points = 0;
  std::array<double, 3> scale{}, offset{};
};

LasHeader readLasHeader(std::string_view bytes, const std::string& name) {
  if (bytes.size() < kOldHeader) throw UserError(name, "ends within its header", "a complete LAS file");
  const auto at = [&](std::size_t offset, BinaryNumber number) { return readBinary(&bytes[offset], number, false); };
  const double minor = at(25, kU8);
  if (at(24, kU8) != 1.0 || minor > 4.0)
    throw UserError(
        name,
        "LAS version " + std::to_string(static_cast<int>(at(24, kU8))) + "." + std::to_string(static_cast<int>(minor)),
        "1.0 to 1.4");
  if (at(104, kU8) > 127.0)
    throw UserError(name, "is compressed (LAZ)", "LAS; laszip -i FILE.laz -o FILE.las converts");
  LasHeader header;
  header.points_at = static_cast<std::size_t>(at(96, kU32));
  header.record = static_cast<std::size_t>(at(105, kU16));
  header.points = static_cast<std::size_t>(at(107, kU32));
  if (minor >= 4.0 && bytes.size() >= kNewHeader && header.points == 0)
    header.points = static_cast<std::size_t>(std::min(at(247, kU64), 1e15));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    header.scale[axis] = at(131 + 8 * axis, kF64);
    header.offset[axis] = at(155 + 8 * axis, kF64);
    if (!std::isfinite(header.scale[axis]) || header.scale[axis] == 0.0 || !std::isfinite(header.offset[axis]))
      throw UserError(name, "a scale or an offset of the coordinates that is zero or not finite", "finite numbers");
  }
  return header;
}

}  // namespace

Vertices parseLas(std::string_view content, const std::string& name) {
  const LasHeader header = readLasHeader(content, name);
  if (header.record < kLeastRecord)
    throw UserError(name, "records of " + std::to_string(header.record) + " bytes", "at least 20");
  if (header.points_at > content.size() || header.points > (content.size() - header.points_at) / header.record)
    throw UserError(name, "ends before its " + std::to_string(header.points) + " points", "a complete file");
  Vertices cloud;
  cloud.points.reserve(header.points);
  for (std::size_t i = 0; i < header.points; ++i) {
    const char* record = content.data() + header.points_at + i * header.record;
    Eigen::Vector3d point;
    for (std::size_t axis = 0; axis < 3; ++axis)
      point[static_cast<Eigen::Index>(axis)] =
          header.offset[axis] + header.scale[axis] * readBinary(record + 4 * axis, kI32, false);
    cloud.points.push_back(point);
  }
  return cloud;
}

}  // namespace urban_nav_core::cloud_formats
