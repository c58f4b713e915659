// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/tum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/column_names.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/io/text_table.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

constexpr std::size_t kTumColumns = 8;

// Parses a stamp. Some programs print 1.403715273262142976e+09, which is parsed as a double, whose precision it already
// has. `unit`: of the stamp, s.
std::optional<StampNs> parseStampIn(double unit, std::string_view text) {
  if (unit == 1.0)
    if (const auto stamp = parseStamp(text)) return stamp;
  if (const auto whole = unit < 1.0 ? parseInteger(text) : std::nullopt) {
    const auto ns = static_cast<std::int64_t>(std::llround(unit * 1e9));
    if (*whole > std::numeric_limits<std::int64_t>::max() / ns || *whole < 0) return std::nullopt;
    return *whole * ns;
  }
  const auto number = parseNumber(text);
  if (!number || std::abs(unit * *number) > 9.2e9) return std::nullopt;
  return static_cast<StampNs>(std::llround(unit * *number * 1e9));
}

/// Returns whether a stamp is in seconds although a header may state ns: it has decimals and the magnitude of seconds.
bool isInSeconds(std::string_view stamp) {
  constexpr double kLargestSeconds = 1e11;
  return stamp.find('.') != std::string_view::npos && std::abs(parseNumber(stamp).value_or(0.0)) < kLargestSeconds;
}

/// Returns the unit, s, in which a stamp lies in the years 1971 to 2255; 1 if it is not a number.
double guessUnit(std::string_view stamp) {
  const double number = std::abs(parseNumber(stamp).value_or(0.0));
  if (number < 3.2e10) return 1.0;
  return number < 3.2e13 ? 1e-3 : number < 3.2e16 ? 1e-6 : 1e-9;
}

/// Columns of the stamp, x y z and qx qy qz qw.
struct PoseColumns {
  std::array<std::size_t, kTumColumns> columns = {0, 1, 2, 3, 4, 5, 6, 7};
  std::array<double, 3> metres = {1.0, 1.0, 1.0};  // units of x, y, z
  std::optional<double> seconds;                   // unit of the stamp as stated in the header
  bool others_allowed = false;
};

PoseColumns findPoseColumns(const TextTable& table, PoseOrder order) {
  PoseColumns by_order;
  if (order == PoseOrder::Euroc) {
    by_order = {{0, 1, 2, 3, 5, 6, 7, 4}, {1.0, 1.0, 1.0}, 1e-9, true};
  }
  if (table.header().empty()) return by_order;
  static constexpr std::array<const char*, kTumColumns> kNames = {"stamp", "x", "y", "z", "qx", "qy", "qz", "qw"};
  PoseColumns named;
  for (std::size_t i = 0; i < kTumColumns; ++i) {
    const auto found = findColumn(table.header(), static_cast<Quantity>(i));
    if (!found && table.headerIsComment()) return by_order;
    if (!found)
      throw UserError(table.whereHeader(),
                      std::string("no column ") + kNames[i] + " in the header " + joined(table.header()),
                      "stamp x y z qx qy qz qw");
    named.columns[i] = *found;
    if (i >= 1 && i <= 3) named.metres[i - 1] = readUnit(table.header()[*found]).value_or(1.0);
  }
  named.seconds = readUnit(table.header()[named.columns.front()]);
  named.others_allowed = true;
  return named;
}

/// Returns the pose of a row; nullopt if a number is missing or not finite, or the quaternion is zero.
std::optional<StampedPose> parseRow(const TableRow& row, const PoseColumns& columns, double unit,
                                    const std::string& where) {
  const std::size_t needed = *std::max_element(columns.columns.begin(), columns.columns.end()) + 1;
  if (row.cells.size() < needed || (row.cells.size() != kTumColumns && !columns.others_allowed))
    throw UserError(where, std::to_string(row.cells.size()) + " columns", "8: stamp x y z qx qy qz qw");
  const std::string_view stamp_cell = row.cells[columns.columns.front()];
  const bool is_stamp_missing = stamp_cell.empty() || !std::isfinite(parseCell(stamp_cell).value_or(0.0));
  const auto stamp = is_stamp_missing ? std::optional<StampNs>(0) : parseStampIn(unit, stamp_cell);
  if (!stamp) throw UserError(where, "stamp " + std::string(stamp_cell), "seconds");
  std::array<double, kTumColumns - 1> v{};
  bool is_finite = !is_stamp_missing;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const std::string_view cell = row.cells[columns.columns[i + 1]];
    const auto number = cell.empty() ? std::numeric_limits<double>::quiet_NaN() : parseCell(cell);
    if (!number) throw UserError(where, quotedCell(cell), "a finite number");
    v[i] = i < columns.metres.size() ? columns.metres[i] * *number : *number;
    is_finite = is_finite && std::isfinite(v[i]);
  }
  const Quaterniond q(v[6], v[3], v[4], v[5]);
  if (!is_finite || q.norm() == 0.0) return std::nullopt;
  if (!(std::abs(q.norm() - 1.0) <= 0.01))
    throw UserError(where, "a quaternion of length " + printNumber(q.norm()), "length 1 (1 %)");
  return StampedPose{*stamp, Pose(q, {v[0], v[1], v[2]})};
}

}  // namespace

std::string printTumPose(const Pose& pose) {
  const Vector3d& t = pose.t();
  const Quaterniond& q = pose.q();
  std::string text;
  for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) {
    if (!text.empty()) text += ' ';
    appendNumber(text, value);
  }
  return text;
}

std::string printTum(const Trajectory& trajectory) {
  std::string text;
  for (const StampedPose& each : trajectory) text += printStamp(each.stamp) + " " + printTumPose(each.pose) + "\n";
  return text;
}

void writeTum(const std::string& path, const Trajectory& trajectory) { writeAtomically(path, printTum(trajectory)); }

Trajectory readTum(const std::string& path, TumRepairs* repairs, PoseOrder order) {
  return parseTum(readTextFile(path), path, repairs, order);
}

Trajectory parseTum(std::string_view text, const std::string& name, TumRepairs* repairs, PoseOrder order) {
  const TextTable table(text, name);
  const PoseColumns columns = findPoseColumns(table, order);
  std::vector<StampedPose> poses;
  TumRepairs counts;
  counts.unit = columns.seconds.value_or(1.0);
  table.forEachRow([&](const TableRow& row) {
    const std::string where = table.where(row);
    if (columns.seconds == 1e-9 && poses.empty() && columns.columns.front() < row.cells.size() &&
        isInSeconds(row.cells[columns.columns.front()]))
      counts.unit = 1.0;
    if (repairs != nullptr && !columns.seconds && poses.empty() && columns.columns.front() < row.cells.size())
      counts.unit = guessUnit(row.cells[columns.columns.front()]);
    const std::optional<StampedPose> pose = parseRow(row, columns, counts.unit, where);
    if (!pose && repairs == nullptr)
      throw UserError(where, "a number that is missing or not finite, or a quaternion of zeros", "finite numbers");
    if (!pose) {
      ++counts.not_finite;
      return;
    }
    if (!poses.empty() && pose->stamp <= poses.back().stamp) {
      if (repairs == nullptr)
        throw UserError(where, "stamp " + printStamp(pose->stamp) + " is not later than the previous one", "");
      if (pose->stamp < poses.back().stamp) ++counts.out_of_order;
    }
    poses.push_back(*pose);
  });
  std::stable_sort(poses.begin(), poses.end(),
                   [](const StampedPose& a, const StampedPose& b) { return a.stamp < b.stamp; });
  Trajectory trajectory;
  for (const StampedPose& pose : poses) counts.repeated += trajectory.append(pose.stamp, pose.pose) ? 0 : 1;
  if (repairs != nullptr) *repairs = counts;
  return trajectory;
}

}  // namespace urban_nav_core
