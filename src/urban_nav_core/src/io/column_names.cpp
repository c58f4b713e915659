// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/column_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav_core {
namespace {

using NameWords = std::vector<std::string>;

constexpr std::array<std::string_view, 21> kPositions = {
    "p",           "t",     "pos",      "position", "positions",  "point",       "points",
    "translation", "trans", "coord",    "coords",   "coordinate", "coordinates", "location",
    "loc",         "xyz",   "geometry", "pose",     "vertex",     "vertices",    "m"};
constexpr std::array<std::string_view, 9> kRotations = {"q",   "quat",     "quaternion", "orientation", "orient",
                                                        "rot", "rotation", "attitude",   "quaternions"};
constexpr std::array<std::string_view, 7> kStamps = {"stamp",      "timestamp", "time", "stamps",
                                                     "timestamps", "t",         "times"};
/// Quantities that are not searched for.
constexpr std::array<std::string_view, 22> kOthers = {
    "n",   "normal", "normals",      "v",   "vel",        "velocity", "linear", "angular", "twist", "omega",  "gyro",
    "acc", "accel",  "acceleration", "cov", "covariance", "sigma",    "std",    "scale",   "color", "colour", "bias"};

template <std::size_t N>
bool isAmong(std::string_view word, const std::array<std::string_view, N>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

NameWords splitName(const std::string& plain) {
  NameWords words(1);
  for (const char c : plain) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) words.back() += c;
    else if (!words.back().empty()) words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

/// Returns the axis named by a word, 0 to 3 for x, y, z, w.
std::optional<int> findAxis(const std::string& word) {
  const std::size_t axis = word.size() == 1 ? std::string_view("xyzw").find(word.front()) : std::string_view::npos;
  return axis == std::string_view::npos ? std::nullopt : std::optional<int>(static_cast<int>(axis));
}

Quantity rotation(int axis) { return static_cast<Quantity>(static_cast<int>(Quantity::Qx) + axis); }

std::optional<Quantity> position(int axis) {
  if (axis > 2) return std::nullopt;
  return static_cast<Quantity>(static_cast<int>(Quantity::X) + axis);
}

/// Single-word names: x, qx, tx, px, posx, easting.
std::optional<Quantity> readWord(const std::string& word) {
  static const std::array<std::pair<const char*, Quantity>, 3> kSurvey = {
      {{"easting", Quantity::X}, {"northing", Quantity::Y}, {"elevation", Quantity::Z}}};
  for (const auto& [name, quantity] : kSurvey)
    if (word == name) return quantity;
  if (isAmong(word, kStamps)) return Quantity::Stamp;
  const std::optional<int> axis = findAxis(word.substr(word.size() - 1));
  if (!axis) return std::nullopt;
  const std::string before = word.substr(0, word.size() - 1);
  if (isAmong(before, kRotations)) return rotation(*axis);
  return before.empty() || isAmong(before, kPositions) ? position(*axis) : std::nullopt;
}

}  // namespace

std::string plainName(std::string_view name) {
  std::string plain(name);
  plain.erase(std::remove(plain.begin(), plain.end(), '"'), plain.end());
  plain = plain.substr(0, plain.find_first_of("[("));
  const std::size_t begin = std::min(plain.find_first_not_of("#%/ \t"), plain.size());
  plain = std::string(trimmed(std::string_view(plain).substr(begin)));
  std::transform(plain.begin(), plain.end(), plain.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return plain;
}

std::optional<Quantity> readQuantity(std::string_view name) {
  const NameWords words = splitName(plainName(name));
  if (words.empty()) return std::nullopt;
  if (words.size() == 1) return readWord(words.front());
  const auto holds = [&words](const auto& known) {
    return std::any_of(words.begin(), words.end(), [&](const std::string& word) { return isAmong(word, known); });
  };
  if (holds(kOthers)) return std::nullopt;
  if (isAmong(words.back(), kStamps) && findAxis(words.back()) == std::nullopt) return Quantity::Stamp;
  std::optional<int> axis = findAxis(words.back());
  if (!axis) axis = findAxis(words.front());  // "X coordinate"
  const std::string& last = words.back();
  const bool is_component = words.size() == 2 && last.size() == 1 && last.front() >= '0' && last.front() <= '2';
  if (!axis && is_component &&
      (words.front() == "points" || words.front() == "position" || words.front() == "coordinates"))
    axis = last.front() - '0';  // ParaView's components of a vector
  if (!axis) return std::nullopt;
  if (holds(kRotations)) return rotation(*axis);
  return holds(kPositions) ? position(*axis) : std::nullopt;
}

std::optional<std::size_t> findColumn(const std::vector<std::string>& header, Quantity quantity) {
  std::optional<std::size_t> found;
  std::size_t least = 0;
  for (std::size_t i = 0; i < header.size(); ++i) {
    if (readQuantity(header[i]) != quantity) continue;
    const std::string plain = plainName(header[i]);
    std::size_t rank = splitName(plain).size();
    // The header's stamp is that of the measurement; %time is that of receipt.
    if (quantity == Quantity::Stamp && plain.find("stamp") == std::string::npos) rank += plain.size() + header.size();
    if (found && rank >= least) continue;
    found = i;
    least = rank;
  }
  return found;
}

std::optional<double> readUnit(std::string_view name) {
  static const std::array<std::pair<std::string_view, double>, 9> kUnits = {{{"m", 1.0},
                                                                             {"cm", 0.01},
                                                                             {"mm", 1e-3},
                                                                             {"km", 1e3},
                                                                             {"s", 1.0},
                                                                             {"sec", 1.0},
                                                                             {"ms", 1e-3},
                                                                             {"us", 1e-6},
                                                                             {"ns", 1e-9}}};
  const std::size_t begin = name.find_first_of("[(");
  if (begin == std::string_view::npos) return std::nullopt;
  const std::size_t end = std::min(name.find_first_of("])", begin), name.size());
  const std::string_view unit = trimmed(name.substr(begin + 1, end - begin - 1));
  for (const auto& [known, size] : kUnits)
    if (unit == known) return size;
  return std::nullopt;
}

}  // namespace urban_nav_core
