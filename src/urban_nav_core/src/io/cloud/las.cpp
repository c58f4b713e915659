// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "formats.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core::cloud_formats {
namespace {

constexpr BinaryNumber kU8{1, 'U'}, kU16{2, 'U'}, kU32{4, 'U'}, kU64{8, 'U'}, kI32{4, 'I'}, kF64{8, 'F'};
constexpr std::size_t kOldHeader = 227;  // bytes, of version 1.2
constexpr std::size_t kNewHeader = 375;  // of version 1.4
constexpr std::size_t kLeastRecord = 20;
constexpr std::size_t kVlrHead = 54, kExtraBytesRow = 192, kExtraBytesId = 4;  // section 2.5 and table 24
/// Bytes of the records of point formats 0 to 10 without extra bytes (section 2.6).
constexpr std::array<std::size_t, 11> kFormatBytes = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
constexpr std::size_t kFirstNewFormat = 6;  // the classification has a byte of its own from there on
/// Types of extra bytes 1 to 10 (table 25).
constexpr std::array<BinaryNumber, 10> kExtraTypes = {
    {{1, 'U'}, {1, 'I'}, {2, 'U'}, {2, 'I'}, {4, 'U'}, {4, 'I'}, {8, 'U'}, {8, 'I'}, {4, 'F'}, {8, 'F'}}};

/// Fields of the public header block that reading points requires (ASPRS, LAS Specification 1.4 R15, section 2.4).
struct LasHeader {
  std::size_t bytes = 0, vlrs = 0;  ///< its length, and the number of variable length records after it
  std::size_t points_at = 0, format = 0, record = 0, points = 0;
  std::array<double, 3> scale{}, offset{};
};

/// Value in the record of a point: `scale` * number + `offset`.
struct LasField {
  std::size_t at = 0;
  BinaryNumber number{};
  double scale = 1.0, offset = 0.0;
  double modulus = 0.0;  ///< 0: the whole number; otherwise its remainder
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
  header.bytes = static_cast<std::size_t>(at(94, kU16));
  header.vlrs = static_cast<std::size_t>(at(100, kU32));
  header.format = static_cast<std::size_t>(at(104, kU8));
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

void requirePoints(const LasHeader& header, std::string_view content, const std::string& name) {
  if (header.record < kLeastRecord)
    throw UserError(name, "records of " + std::to_string(header.record) + " bytes", "at least 20");
  if (header.points_at > content.size() || header.points > (content.size() - header.points_at) / header.record)
    throw UserError(name, "ends before its " + std::to_string(header.points) + " points", "a complete file");
}

double readField(const char* record, const LasField& field) {
  double value = readBinary(record + field.at, field.number, false);
  if (field.modulus > 0.0) value -= field.modulus * std::floor(value / field.modulus);
  return field.scale * value + field.offset;
}

std::string_view untilZero(std::string_view text) { return text.substr(0, text.find('\0')); }

/// Finds a field in the rows of a record "extra bytes" (section 2.6.1), which describe the end of each point.
std::optional<LasField> findInRows(std::string_view rows, std::size_t begin, std::size_t end,
                                   const std::string& wanted) {
  for (; rows.size() >= kExtraBytesRow; rows.remove_prefix(kExtraBytesRow)) {
    const auto type = static_cast<unsigned char>(rows[2]), options = static_cast<unsigned char>(rows[3]);
    if (type > kExtraTypes.size()) return std::nullopt;  // arrays, deprecated: where the next field begins is unknown
    if (type == 0) {
      begin += options;
      continue;
    }
    LasField field{begin, kExtraTypes[type - 1U]};
    begin += field.number.size;
    if (begin > end) return std::nullopt;
    if (untilZero(rows.substr(4, 32)) != wanted) continue;
    if ((options & 8U) != 0) field.scale = readBinary(&rows[112], kF64, false);
    if ((options & 16U) != 0) field.offset = readBinary(&rows[136], kF64, false);
    return field;
  }
  return std::nullopt;
}

std::optional<LasField> findExtraBytes(const LasHeader& header, std::string_view content, const std::string& wanted) {
  if (header.format >= kFormatBytes.size()) return std::nullopt;
  std::size_t at = header.bytes;
  for (std::size_t i = 0; i < header.vlrs && at + kVlrHead <= header.points_at; ++i) {
    const std::string_view head = content.substr(at, kVlrHead);
    const auto id = static_cast<std::size_t>(readBinary(&head[18], kU16, false));
    const auto length = static_cast<std::size_t>(readBinary(&head[20], kU16, false));
    at += kVlrHead;
    if (untilZero(head.substr(2, 16)) == "LASF_Spec" && id == kExtraBytesId)
      return findInRows(content.substr(at, std::min(length, header.points_at - at)), kFormatBytes[header.format],
                        header.record, wanted);
    at += std::min(length, header.points_at - at);
  }
  return std::nullopt;
}

std::optional<LasField> findField(const LasHeader& header, std::string_view content, const std::string& wanted) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (wanted == std::string(1, "xyz"[axis]))
      return LasField{4 * axis, kI32, header.scale[axis], header.offset[axis], 0.0};
  if (wanted == "intensity") return LasField{12, kU16};
  if (wanted == "classification")
    return header.format >= kFirstNewFormat ? LasField{16, kU8} : LasField{15, kU8, 1.0, 0.0, 32.0};
  return findExtraBytes(header, content, wanted);
}

}  // namespace

NumberColumns parseLasColumns(std::string_view content, const std::string& name,
                              const std::vector<std::string>& wanted) {
  const LasHeader header = readLasHeader(content, name);
  requirePoints(header, content, name);
  NumberColumns columns(wanted.size());
  for (std::size_t column = 0; column < wanted.size(); ++column) {
    const auto field = findField(header, content, wanted[column]);
    if (!field) continue;
    std::vector<double>& values = columns[column].emplace();
    values.reserve(header.points);
    for (std::size_t i = 0; i < header.points; ++i)
      values.push_back(readField(content.data() + header.points_at + i * header.record, *field));
  }
  return columns;
}

Vertices parseLas(std::string_view content, const std::string& name) {
  const LasHeader header = readLasHeader(content, name);
  requirePoints(header, content, name);
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
