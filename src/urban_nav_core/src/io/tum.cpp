// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/tum.hpp"

#include <array>
#include <cmath>

#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

constexpr std::size_t kTumColumns = 8;

// Some writers print 1.403715273262142976e+09, which goes through a double and loses what it has lost already.
std::optional<StampNs> stampOf(std::string_view text) {
  if (const auto stamp = parseStamp(text)) return stamp;
  const auto seconds = parseNumber(text);
  if (!seconds || std::abs(*seconds) > 9.2e9) return std::nullopt;
  return static_cast<StampNs>(std::llround(*seconds * 1e9));
}

StampedPose parseLine(std::string_view line, const std::string& where) {
  const auto words = splitBlanks(line);
  if (words.size() != kTumColumns) {
    throw UserError(where, std::to_string(words.size()) + " columns", "8: stamp x y z qx qy qz qw");
  }
  const auto stamp = stampOf(words[0]);
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

Trajectory readTum(const std::string& path) { return parseTum(readTextFile(path), path); }

Trajectory parseTum(std::string_view text, const std::string& name) {
  Trajectory trajectory;
  forEachLine(text, [&](std::string_view line, int number) {
    const std::string_view content = trimmed(line.substr(0, line.find('#')));
    if (content.empty()) return;
    const std::string where = atLine(name, number);
    const StampedPose pose = parseLine(content, where);
    if (!trajectory.append(pose.stamp, pose.pose)) {
      throw UserError(where, "stamp " + printStamp(pose.stamp) + " is not later than the one before", "");
    }
  });
  return trajectory;
}

}  // namespace urban_nav_core
