// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/kitti.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/io/text_table.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

constexpr int kKittiColumns = 12;

bool isRotation(const Matrix3d& R) {
  constexpr double kTolerance = 1e-3;
  return ((R * R.transpose() - Matrix3d::Identity()).array().abs() <= kTolerance).all() && R.determinant() > 0.0;
}

KittiMatrix parseLine(const std::vector<std::string_view>& words, const std::string& where) {
  if (words.size() != static_cast<std::size_t>(kKittiColumns)) {
    throw UserError(where, std::to_string(words.size()) + " columns", "12: a 3x4 matrix, row by row");
  }
  KittiMatrix M;
  for (int i = 0; i < kKittiColumns; ++i) {
    const std::string_view word = words[static_cast<std::size_t>(i)];
    const auto number = parseNumber(word);
    if (!number) throw UserError(where, "`" + std::string(word) + "`", "a finite number");
    M(i / 4, i % 4) = *number;
  }
  if (!isRotation(M.leftCols<3>())) throw UserError(where, "a matrix that is not a rotation (tolerance 0.001)", "");
  return M;
}

}  // namespace

std::string printKitti(const std::vector<KittiMatrix>& matrices) {
  std::string text;
  for (const KittiMatrix& M : matrices) {
    for (int i = 0; i < kKittiColumns; ++i) {
      appendNumber(text, M(i / 4, i % 4));
      text += i + 1 < kKittiColumns ? ' ' : '\n';
    }
  }
  return text;
}

std::string printKitti(const std::vector<Pose>& poses) {
  std::vector<KittiMatrix> matrices;
  matrices.reserve(poses.size());
  for (const Pose& pose : poses) matrices.emplace_back(pose.matrix().topRows<3>());
  return printKitti(matrices);
}

void writeKitti(const std::string& path, const std::vector<Pose>& poses) { writeAtomically(path, printKitti(poses)); }

std::vector<KittiMatrix> parseKittiMatrices(std::string_view text, const std::string& name) {
  std::vector<KittiMatrix> matrices;
  const TextTable table(text, name);
  table.forEachRow([&](const TableRow& row) { matrices.push_back(parseLine(row.cells, table.where(row))); });
  return matrices;
}

std::vector<Pose> parseKitti(std::string_view text, const std::string& name) {
  std::vector<Pose> poses;
  for (const KittiMatrix& M : parseKittiMatrices(text, name))
    poses.emplace_back(Matrix3d(M.leftCols<3>()), Vector3d(M.col(3)));
  return poses;
}

std::vector<Pose> readKitti(const std::string& path) { return parseKitti(readTextFile(path), path); }

std::optional<StampNs> parseTime(std::string_view word) {
  if (const auto stamp = parseStamp(word)) return stamp;
  // A double is exact enough, since KITTI's times begin at zero.
  const auto seconds = parseNumber(word);
  if (!seconds || std::abs(*seconds) > 9.2e9) return std::nullopt;
  return static_cast<StampNs>(std::llround(*seconds * 1e9));
}

std::vector<StampNs> parseTimes(std::string_view text, const std::string& name) {
  std::vector<StampNs> times;
  forEachTime(text, name, [&times](std::string_view word, StampNs stamp, const std::string& where) {
    if (!times.empty() && stamp <= times.back())
      throw UserError(where, std::string(word) + " is not later than the previous time", "");
    times.push_back(stamp);
  });
  return times;
}

namespace {

struct TimeWord {
  std::string text, where;
};

constexpr double kLargestSeconds = 1e11, kLargestMilliseconds = 1e14, kLargestMicroseconds = 1e17;  // since 1970
constexpr double kLongestSeconds = 5e3, kLongestMicroseconds = 5e6;  // interval between images; longer ones imply a
                                                                     // smaller unit

/// Returns the words of a table of one column.
std::vector<TimeWord> readTimeWords(std::string_view text, const std::string& name) {
  std::string plain(text);
  const bool has_decimal_commas = plain.find('.') == std::string::npos && plain.find(',') != std::string::npos;
  if (has_decimal_commas) std::replace(plain.begin(), plain.end(), ',', '.');  // a single column needs no separator
  std::vector<TimeWord> words;
  const TextTable table(plain, name);
  table.forEachRow([&](const TableRow& row) {
    std::string word;
    for (const std::string_view cell : row.cells) word += (word.empty() ? "" : " ") + std::string(cell);
    words.push_back({word, table.where(row)});
  });
  return words;
}

/// Returns the unit of times in s: by magnitude for times since 1970, else by their intervals.
double findTimeUnit(const std::vector<TimeWord>& words) {
  std::vector<double> times, intervals;
  for (const TimeWord& word : words)
    if (const auto number = parseNumber(word.text)) times.push_back(*number);
  if (times.size() != words.size() || times.size() < 2) return 1.0;
  const double largest = *std::max_element(times.begin(), times.end());
  if (largest > kLargestSeconds)
    return largest > kLargestMicroseconds ? 1e-9 : largest > kLargestMilliseconds ? 1e-6 : 1e-3;
  for (std::size_t i = 1; i < times.size(); ++i) intervals.push_back(std::abs(times[i] - times[i - 1]));
  std::nth_element(intervals.begin(), intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2),
                   intervals.end());
  const double interval = intervals[intervals.size() / 2];
  return interval > kLongestMicroseconds ? 1e-9 : interval > kLongestSeconds ? 1e-6 : 1.0;
}

std::optional<StampNs> parseTimeIn(double unit, const std::string& text) {
  if (unit == 1.0) return parseTime(text);
  if (const auto whole = parseInteger(text); whole && unit == 1e-9) return *whole;
  const auto number = parseNumber(text);
  if (!number || std::abs(unit * *number) > 9.2e9) return std::nullopt;
  return static_cast<StampNs>(std::llround(unit * 1e9 * *number));
}

}  // namespace

void forEachTime(std::string_view text, const std::string& name,
                 const std::function<void(std::string_view word, StampNs stamp, const std::string& where)>& time) {
  const std::vector<TimeWord> words = readTimeWords(text, name);
  const double unit = findTimeUnit(words);
  for (const TimeWord& word : words) {
    const auto stamp = parseTimeIn(unit, word.text);
    if (!stamp) throw UserError(word.where, "`" + word.text + "`", "seconds, one number a line");
    time(word.text, *stamp, word.where);
  }
}

std::vector<StampNs> readTimes(const std::string& path) { return parseTimes(readTextFile(path), path); }

}  // namespace urban_nav_core
