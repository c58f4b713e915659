// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/device/delay_model.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {

using urban_nav_core::UserError;

namespace {

/// Returns the numbers after the first part. Throws UserError for other text.
std::vector<double> delayNumbers(const std::vector<std::string_view>& parts, std::size_t from,
                                 const std::string& where) {
  std::vector<double> numbers;
  for (std::size_t i = from; i < parts.size(); ++i) {
    const auto value = urban_nav_core::parseNumber(parts[i]);
    if (!value || std::abs(*value) > 1e9) throw UserError(where, std::string(parts[i]), "a number");
    numbers.push_back(*value);
  }
  return numbers;
}

}  // namespace

DelayModel DelayModel::parse(const std::string& text, double least, const std::string& option) {
  const std::string where = option + " " + text, allowed = "exponential:MIN:MEAN:MAX, uniform:MIN:MAX, batch:MS, in ms";
  const auto parts = urban_nav_core::splitAt(text, ':');
  const std::vector<double> numbers = delayNumbers(parts, 1, where);
  DelayModel model;
  if (parts[0] == "exponential" && numbers.size() == 3) {
    model = {Kind::Exponential, numbers[0], numbers[1], numbers[2]};
  } else if (parts[0] == "uniform" && numbers.size() == 2) {
    model = {Kind::Uniform, numbers[0], numbers[1], numbers[1]};
  } else if (parts[0] == "batch" && numbers.size() == 1) {
    model = {Kind::Batch, least, 0.0, numbers[0]};
  } else {
    throw UserError(where, text, allowed);
  }
  if (model.min_ms < 0.0 || model.mean_ms < 0.0 || (model.kind != Kind::Batch && model.max_ms < model.min_ms) ||
      model.max_ms <= 0.0)
    throw UserError(where, text, "0 <= MIN <= MAX");
  return model;
}

double DelayModel::drawExcess(std::mt19937_64& random, double arrival_ms) const {
  switch (kind) {
    case Kind::Constant: return 0.0;
    case Kind::Exponential:
      if (mean_ms <= 0.0) return 0.0;
      return std::min(std::exponential_distribution<double>(1.0 / mean_ms)(random), max_ms - min_ms);
    case Kind::Uniform: return std::uniform_real_distribution<double>(0.0, max_ms - min_ms)(random);
    case Kind::Batch: return max_ms - std::fmod(arrival_ms, max_ms);
  }
  return 0.0;
}

DeviceClock DeviceClock::parse(const std::string& text, const std::string& option) {
  const auto parts = urban_nav_core::splitAt(text, ':');
  const std::vector<double> numbers = delayNumbers(parts, 0, option + " " + text);
  if (numbers.size() != 2 || std::abs(numbers[1]) > 50000.0) throw UserError(option, text, "OFFSET_S:PPM");
  return {numbers[0], 1e-6 * numbers[1]};
}

}  // namespace urban_nav_sim
