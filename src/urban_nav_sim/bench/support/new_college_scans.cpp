// SPDX-License-Identifier: BSD-3-Clause
#include "new_college_scans.hpp"

#include <array>
#include <cstdio>
#include <memory>
#include <sstream>
#include <stdexcept>

namespace urban_nav_sim::bench {
namespace {

constexpr std::size_t kBeams = 181;

std::string unpacked(const std::string& path) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(("xz -dc '" + path + "'").c_str(), "r"), pclose);
  if (!pipe) throw std::runtime_error("xz does not run");
  std::string text;
  std::array<char, 65536> part;
  while (const std::size_t n = fread(part.data(), 1, part.size(), pipe.get())) text.append(part.data(), n);
  return text;
}

/// The numbers of "Name=[181]{1.0,2.0,...}".
std::vector<double> parseArray(const std::string& line, const std::string& name) {
  std::vector<double> values;
  const std::size_t start = line.find(name + "=[");
  const std::size_t open = start == std::string::npos ? start : line.find('{', start);
  if (open == std::string::npos) return values;
  std::istringstream numbers(line.substr(open + 1, line.find('}', open) - open - 1));
  for (std::string word; std::getline(numbers, word, ',');) {
    if (!word.empty()) values.push_back(std::stod(word));
  }
  return values;
}

}  // namespace

Turns newCollegeTurns(const std::string& path, const std::string& side) {
  std::istringstream lines(unpacked(path));
  Turns turns;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("LMS_LASER_2D_" + side) >= 60) continue;
    std::vector<double> ranges = parseArray(line, "Range"), intensities = parseArray(line, "Reflectance");
    if (ranges.size() != kBeams || intensities.size() != kBeams) continue;
    turns.ranges.push_back(std::move(ranges));
    turns.intensities.push_back(std::move(intensities));
  }
  if (turns.ranges.empty()) throw std::runtime_error(path + ": no turn of " + side);
  return turns;
}

}  // namespace urban_nav_sim::bench
