// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/tum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

constexpr std::size_t kTumColumns = 8;

// Some writers print 1.403715273262142976e+09, which goes through a double and loses what it has lost already. `unit`:
// of the stamp, s.
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

/// s: the unit in which a stamp is one of the years 1971 to 2255; 1 where it is no number.
double guessUnit(std::string_view stamp) {
  const double number = std::abs(parseNumber(stamp).value_or(0.0));
  if (number < 3.2e10) return 1.0;
  return number < 3.2e13 ? 1e-3 : number < 3.2e16 ? 1e-6 : 1e-9;
}

StampedPose parseLine(std::string_view line, double unit, const std::string& where) {
  const auto words = splitBlanks(line);
  if (words.size() != kTumColumns) {
    throw UserError(where, std::to_string(words.size()) + " columns", "8: stamp x y z qx qy qz qw");
  }
  const auto stamp = parseStampIn(unit, words[0]);
  if (!stamp) throw UserError(where, "stamp " + std::string(words[0]), "seconds");
  std::array<double, kTumColumns - 1> v{};
  for (std::size_t i = 0; i < v.size(); ++i) {
    const auto number = parseNumber(words[i + 1]);
    if (!number) throw UserError(where, "`" + std::string(words[i + 1]) + "`", "a finite number");
    v[i] = *number;
  }
  const Quaterniond q(v[6], v[3], v[4], v[5]);
  if (!(std::abs(q.norm() - 1.0) <= 0.01))
    throw UserError(where, "a quaternion of length " + printNumber(q.norm()), "length 1 (1 %)");
  return {*stamp, Pose(q, {v[0], v[1], v[2]})};
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

Trajectory readTum(const std::string& path, TumRepairs* repairs) { return parseTum(readTextFile(path), path, repairs); }

Trajectory parseTum(std::string_view text, const std::string& name, TumRepairs* repairs) {
  std::vector<StampedPose> poses;
  double unit = 1.0;
  std::size_t disorder = 0;
  forEachLine(text, [&](std::string_view line, int number) {
    const std::string_view content = trimmed(line.substr(0, line.find('#')));
    if (content.empty()) return;
    if (repairs != nullptr && poses.empty()) unit = guessUnit(splitBlanks(content).front());
    const std::string where = atLine(name, number);
    const StampedPose pose = parseLine(content, unit, where);
    if (!poses.empty() && pose.stamp <= poses.back().stamp) {
      if (repairs == nullptr)
        throw UserError(where, "stamp " + printStamp(pose.stamp) + " is not later than the one before", "");
      if (pose.stamp < poses.back().stamp) ++disorder;
    }
    poses.push_back(pose);
  });
  std::stable_sort(poses.begin(), poses.end(),
                   [](const StampedPose& a, const StampedPose& b) { return a.stamp < b.stamp; });
  Trajectory trajectory;
  std::size_t repeated = 0;
  for (const StampedPose& pose : poses) repeated += trajectory.append(pose.stamp, pose.pose) ? 0 : 1;
  if (repairs != nullptr) *repairs = {repeated, disorder, unit};
  return trajectory;
}

}  // namespace urban_nav_core
