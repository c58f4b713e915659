// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/bumblebee2/factory_calibration.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace segway_drivers {

using urban_nav_core::UserError;

namespace {

constexpr std::size_t kMostCoefficients = 10000, kMostPerAxis = 100;

struct CalibrationLine {
  std::string key;
  std::vector<std::string> words;
  int number = 0;
};

std::vector<CalibrationLine> splitCalibration(const std::string& text) {
  std::vector<CalibrationLine> lines;
  urban_nav_core::forEachLine(text, [&](std::string_view line, int number) {
    const auto words = urban_nav_core::splitBlanks(line.substr(0, line.find('#')));
    if (words.empty()) return;
    CalibrationLine entry{std::string(words.front()), {}, number};
    for (std::size_t i = 1; i < words.size(); ++i) entry.words.emplace_back(words[i]);
    lines.push_back(std::move(entry));
  });
  return lines;
}

/// Reads the lines of a calibration in order.
class CalibrationReader {
 public:
  CalibrationReader(const std::string& text, std::string name)
      : lines_(splitCalibration(text)), name_(std::move(name)) {}

  bool atEnd() const { return at_ >= lines_.size(); }
  const CalibrationLine& next() { return lines_[at_++]; }
  [[noreturn]] void refuse(const CalibrationLine& line, const std::string& allowed) const {
    throw UserError(urban_nav_core::atLine(name_, line.number), line.key, allowed);
  }
  std::vector<double> numbers(const CalibrationLine& line) const {
    std::vector<double> values;
    for (const std::string& word : line.words) {
      const auto value = urban_nav_core::parseNumber(word);
      if (!value || std::abs(*value) > 1e6) refuse(line, "finite numbers");
      values.push_back(*value);
    }
    return values;
  }
  std::vector<double> numbers(const CalibrationLine& line, std::size_t count) const {
    std::vector<double> values = numbers(line);
    if (values.size() < count) refuse(line, std::to_string(count) + " numbers");
    return values;
  }
  /// Returns the numbers of the following lines, up to `count`; the key of such a line is also a number.
  std::vector<double> following(std::size_t count) {
    std::vector<double> values;
    while (!atEnd() && values.size() < count) {
      CalibrationLine line = next();
      line.words.insert(line.words.begin(), line.key);
      const auto of_line = numbers(line);
      values.insert(values.end(), of_line.begin(), of_line.end());
    }
    return values;
  }
  const std::string& name() const { return name_; }

 private:
  std::vector<CalibrationLine> lines_;
  std::size_t at_ = 0;
  std::string name_;
};

struct CalibrationCamera {
  int id = -1;
  std::vector<double> forward, inverse;  // numbers of surfaces
};

CalibrationCamera readCalibrationCamera(CalibrationReader& reader) {
  CalibrationCamera camera;
  while (!reader.atEnd()) {
    const CalibrationLine& line = reader.next();
    if (line.key == "EndCamera") break;
    if (line.key == "Id") camera.id = static_cast<int>(reader.numbers(line, 1)[0]);
    if (line.key == "Warp") camera.forward = reader.numbers(line, 2);
    if (line.key == "IWarp") camera.inverse = reader.numbers(line, 2);
  }
  return camera;
}

void checkSurface(const CalibrationReader& reader, const CalibrationLine& end, const CalibrationSurface& s) {
  const auto clamped = [](const std::vector<double>& knots, int count) {
    return knots.size() == static_cast<std::size_t>(count) + 4 && std::is_sorted(knots.begin(), knots.end()) &&
           knots.front() == 0.0 && knots.back() == 1.0;
  };
  if (s.count_x < 4 || s.count_y < 4 || !clamped(s.knots_x, s.count_x) || !clamped(s.knots_y, s.count_y) ||
      s.coefficients.size() != static_cast<std::size_t>(s.count_x) * static_cast<std::size_t>(s.count_y))
    reader.refuse(end, "cubic surfaces over 0...1 with n + 4 knots an axis");
}

std::pair<int, CalibrationSurface> readCalibrationWarp(CalibrationReader& reader) {
  CalibrationSurface surface;
  int id = -1;
  while (!reader.atEnd()) {
    const CalibrationLine line = reader.next();
    if (line.key == "EndWarp") {
      checkSurface(reader, line, surface);
      return {id, surface};
    }
    if (line.key == "Id") id = static_cast<int>(reader.numbers(line, 1)[0]);
    if (line.key == "KnotsX") surface.knots_x = reader.numbers(line);
    if (line.key == "KnotsY") surface.knots_y = reader.numbers(line);
    if (line.key == "NumberCoefs") {
      const auto counts = reader.numbers(line, 2);
      if (counts[0] < 4 || counts[1] < 4 || counts[0] > kMostPerAxis || counts[1] > kMostPerAxis)
        reader.refuse(line, "4...100 an axis");
      surface.count_x = static_cast<int>(counts[0]);
      surface.count_y = static_cast<int>(counts[1]);
    }
    if (line.key == "Coefs")
      surface.coefficients = reader.following(std::min(
          kMostCoefficients, static_cast<std::size_t>(surface.count_x) * static_cast<std::size_t>(surface.count_y)));
  }
  throw UserError(reader.name(), "incomplete surface", "EndWarp");
}

ImagerCalibration chooseSurfaces(const std::map<int, CalibrationSurface>& surfaces, const CalibrationCamera& camera,
                                 const std::string& name) {
  const auto find = [&](const std::vector<double>& numbers, std::size_t i) {
    const auto found = numbers.size() < 2 ? surfaces.end() : surfaces.find(static_cast<int>(numbers[i]));
    if (found == surfaces.end())
      throw UserError(name, "surfaces of camera " + std::to_string(camera.id) + " missing",
                      "Warp and IWarp of both cameras");
    return found->second;
  };
  return {find(camera.forward, 0), find(camera.forward, 1), find(camera.inverse, 0), find(camera.inverse, 1)};
}

}  // namespace

FactoryCalibration parseFactoryCalibration(const std::string& text, const std::string& name) {
  CalibrationReader reader(text, name);
  FactoryCalibration calibration;
  std::map<int, CalibrationCamera> cameras;
  std::map<int, CalibrationSurface> surfaces;
  while (!reader.atEnd()) {
    const CalibrationLine line = reader.next();
    if (line.key == "BeginCamera") {
      const CalibrationCamera camera = readCalibrationCamera(reader);
      cameras[camera.id] = camera;
    } else if (line.key == "BeginWarp") {
      surfaces.insert(readCalibrationWarp(reader));
    } else if (line.key == "FocalLength") {
      const auto values = reader.numbers(line, 2);
      calibration.fx = values[0];
      calibration.fy = values[1];
    } else if (line.key == "ImageCenter") {
      const auto values = reader.numbers(line, 2);
      calibration.cx = values[0];
      calibration.cy = values[1];
    } else if (line.key == "BaseLine") {
      calibration.baseline = reader.numbers(line, 1)[0];
    }
  }
  if (calibration.fx <= 0.0 || calibration.fy <= 0.0 || calibration.baseline <= 0.0)
    throw UserError(name, "FocalLength or BaseLine missing", "a Triclops calibration");
  calibration.right = chooseSurfaces(surfaces, cameras[0], name);
  calibration.left = chooseSurfaces(surfaces, cameras[2], name);
  return calibration;
}

}  // namespace segway_drivers
