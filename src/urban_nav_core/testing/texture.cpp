// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/texture.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <random>

namespace urban_nav_core::testing {
namespace {

constexpr int kLattice = 256;
constexpr int kLatticeStride = kLattice + 3;
// Standard deviation of uniform noise in -1...1 under a cubic B-spline in both directions.
constexpr double kSplineDeviation = 0.277;
// Energy of the waves is concentrated at about 0.35 periods per lattice step: (2 pi 0.35)^2.
constexpr double kSquaredFrequency = 4.84;
constexpr double kMaskFrequency = 0.6;  // lattice steps per m
constexpr double kReach = 3.5;          // standard deviations after which an edge is over
// Largest number of lattice steps of a run for interpolation by a parabola: the error is under 1 % of the amplitude.
constexpr double kSlowRun = 0.45;
constexpr double kNegligible = 0.02;  // share of an amplitude that is neglected

/// Returns the weights of the four lattice points around a position, by the powers of its fraction t.
const Eigen::Vector4f kSpline0(1.0F / 6, 4.0F / 6, 1.0F / 6, 0.0F), kSpline1(-0.5F, 0.0F, 0.5F, 0.0F);
const Eigen::Vector4f kSpline2(0.5F, -1.0F, 0.5F, 0.0F), kSpline3(-1.0F / 6, 0.5F, -0.5F, 1.0F / 6);

inline Eigen::Vector4f splineWeights(float t) { return kSpline0 + t * (kSpline1 + t * (kSpline2 + t * kSpline3)); }

/// Approximates exp(-q) to a few per cent, smooth and never negative, which suffices for the edge of the pass band.
inline double attenuation(double q) { return 1.0 / (1.0 + q * (1.0 + q * (0.5 + q * (1.0 / 6.0)))); }

/// Normal distribution function, tabulated where it differs from 0 and 1.
class StepTable {
 public:
  StepTable() {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const double z = (2.0 * static_cast<double>(i) / kSteps - 1.0) * kReach;
      values_[i] = 0.5 * std::erfc(-z / std::sqrt(2.0));
    }
  }
  double operator()(double z) const {
    if (z <= -kReach) return 0.0;
    if (z >= kReach) return 1.0;
    const double place = (z + kReach) * (kSteps / (2.0 * kReach));
    const auto i = static_cast<std::size_t>(place);
    return values_[i] + (place - static_cast<double>(i)) * (values_[i + 1] - values_[i]);
  }

 private:
  static constexpr int kSteps = 1024;
  std::array<double, kSteps + 2> values_{};
};
const StepTable kStepUp;

std::uint32_t hash(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  std::uint32_t h = a * 0x9E3779B1U ^ (b + 0x7F4A7C15U) * 0x85EBCA77U ^ (c + 0x165667B1U) * 0xC2B2AE3DU;
  h ^= h >> 15U;
  h *= 0x2C1B3C6DU;
  h ^= h >> 12U;
  h *= 0x297A2D39U;
  return h ^ (h >> 15U);
}

}  // namespace

Texture::Texture(double base, const std::vector<Octave>& octaves, const std::vector<Cells>& cells, std::uint32_t seed)
    : base_(base) {
  assert(octaves.size() <= kMost && cells.size() <= kMost);
  for (const Octave& octave : octaves) {
    const double place = static_cast<double>(waves_.size());
    waves_.push_back({1.0 / octave.spacing, octave.amplitude, octave.patchy, 37.31 * place, 91.73 * place});
  }
  for (const Cells& c : cells) {
    const double covered = (1.0 - 2.0 * c.margin_x / c.width) * (1.0 - 2.0 * c.margin_y / c.height);
    Pattern pattern{c, 1.0 / c.width, 1.0 / c.height, 0.5 * (c.low + c.high) * c.share * covered};
    pattern.seed ^= seed * 0x9E3779B1U;
    patterns_.push_back(pattern);
  }
  lattice_.resize(static_cast<std::size_t>(kLatticeStride * kLatticeStride));
  std::mt19937 random(seed);
  const auto at = [this](int row, int column) -> float& {
    return lattice_[static_cast<std::size_t>(row * kLatticeStride + column)];
  };
  for (int row = 0; row < kLatticeStride; ++row) {
    for (int column = 0; column < kLatticeStride; ++column) {
      const bool repeats = row >= kLattice || column >= kLattice;
      at(row, column) =
          repeats ? at(row % kLattice, column % kLattice)
                  : static_cast<float>((static_cast<double>(random()) / 2147483648.0 - 1.0) / kSplineDeviation);
    }
  }
}

inline double Texture::noise(double x, double y) const {
  const double floor_x = std::floor(x), floor_y = std::floor(y);
  const int column = static_cast<int>(floor_x) & (kLattice - 1);
  const int row = static_cast<int>(floor_y) & (kLattice - 1);
  const Eigen::Vector4f wx = splineWeights(static_cast<float>(x - floor_x));
  const Eigen::Vector4f wy = splineWeights(static_cast<float>(y - floor_y));
  const float* p = lattice_.data() + row * kLatticeStride + column;
  Eigen::Vector4f sum = Eigen::Map<const Eigen::Vector4f>(p) * wy(0);
  sum += Eigen::Map<const Eigen::Vector4f>(p + kLatticeStride) * wy(1);
  sum += Eigen::Map<const Eigen::Vector4f>(p + 2 * kLatticeStride) * wy(2);
  sum += Eigen::Map<const Eigen::Vector4f>(p + 3 * kLatticeStride) * wy(3);
  return static_cast<double>(sum.dot(wx));
}

double Texture::mask(double x, double y) const {
  const double t = std::clamp(0.5 + 0.7 * noise(x * kMaskFrequency + 113.7, y * kMaskFrequency + 57.9), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

Texture::Filter Texture::filter(const Footprint& footprint) const {
  Filter result;
  const double middle = 0.5 * (footprint.xx + footprint.yy), half = 0.5 * (footprint.xx - footprint.yy);
  const double spread = std::sqrt(half * half + footprint.xy * footprint.xy);
  const double longest = middle + spread, shortest = std::max(0.0, middle - spread);
  // Eigenvector of the larger eigenvalue, from the row without cancellation.
  const double axis_x = half > 0.0 ? spread + half : footprint.xy;
  const double axis_y = half > 0.0 ? footprint.xy : spread - half;
  const double per_axis = 1.0 / (std::sqrt(axis_x * axis_x + axis_y * axis_y) + 1e-300);
  for (std::size_t i = 0; i < waves_.size(); ++i) {
    const double scale2 = waves_[i].frequency * waves_[i].frequency;
    const double major = longest * scale2, minor = shortest * scale2;
    // A long footprint (ground at a low angle) is divided into several round steps along its major axis, each with the
    // remaining variance; one step suffices where all of it is small compared with the lattice.
    const int steps = major < 0.05 || major < 3.0 * minor ? 1 : (major < 8.0 * minor ? 2 : 3);
    const double variance = steps == 1 ? major : std::max(minor, major * (steps == 2 ? 0.5 : 0.3));
    const double pass = attenuation(0.5 * kSquaredFrequency * variance);
    if (pass < kNegligible) continue;
    const double between = steps == 1 ? 0.0 : std::sqrt(12.0 * (major - variance) / (steps * steps - 1)) * per_axis;
    result.waves[result.wave_count++] = {i, waves_[i].amplitude * pass, steps, between * axis_x, between * axis_y};
  }
  const double sigma_x = std::sqrt(footprint.xx) + 1e-9, sigma_y = std::sqrt(footprint.yy) + 1e-9;
  result.per_sigma_x = 1.0 / sigma_x;
  result.per_sigma_y = 1.0 / sigma_y;
  result.base = base_;
  for (std::size_t i = 0; i < patterns_.size(); ++i) {
    // If a pixel covers several cells, the nearest ones are not representative: the pattern fades to the overall mean.
    const double blur = std::max(sigma_x * patterns_[i].per_width, sigma_y * patterns_[i].per_height);
    const double fade = attenuation(60.0 * blur * blur * blur * blur);
    result.base += (1.0 - fade) * patterns_[i].mean;
    if (fade >= kNegligible) result.patterns[result.pattern_count++] = {i, fade};
  }
  return result;
}

/// Returns the coverage of the rectangles of the footprint's own cell and of the nearest neighbour.
struct Texture::Part {
  int own, other;
  double own_share, other_share;
};

inline Texture::Part Texture::part(double x, double size, double per_size, double margin, double per_sigma) {
  const double own = std::floor(x * per_size);
  const double place = x - own * size;  // in the own cell
  const bool is_left = place < 0.5 * size;
  const double edge = is_left ? place : size - place;  // from the nearest border between cells
  const int index = static_cast<int>(own);
  const int other = is_left ? index - 1 : index + 1;
  if ((edge - margin) * per_sigma >= kReach) return {index, other, 1.0, 0.0};
  return {index, other, kStepUp((edge - margin) * per_sigma) * kStepUp((size - margin - edge) * per_sigma),
          kStepUp(-(edge + margin) * per_sigma)};
}

inline double Texture::sampleGrey(const Pattern& pattern, int column, int row) {
  const std::uint32_t h = hash(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row), pattern.seed);
  if ((h & 0xFFFFU) >= pattern.share * 65536.0) return 0.0;
  return pattern.low + (pattern.high - pattern.low) * ((h >> 16U) * (1.0 / 65535.0));
}

double Texture::rowValue(const Pattern& pattern, int row, double x, double per_sigma_x) {
  const double shifted = x - ((row & 1) != 0 ? pattern.shift * pattern.width : 0.0);
  const Part columns = part(shifted, pattern.width, pattern.per_width, pattern.margin_x, per_sigma_x);
  double sum = columns.own_share > 0.0 ? columns.own_share * sampleGrey(pattern, columns.own, row) : 0.0;
  if (columns.other_share > 0.0) sum += columns.other_share * sampleGrey(pattern, columns.other, row);
  return sum;
}

double Texture::patternValue(const Pattern& pattern, double x, double y, const Filter& filter) {
  const Part rows = part(y, pattern.height, pattern.per_height, pattern.margin_y, filter.per_sigma_y);
  double sum = rows.own_share > 0.0 ? rows.own_share * rowValue(pattern, rows.own, x, filter.per_sigma_x) : 0.0;
  if (rows.other_share > 0.0) sum += rows.other_share * rowValue(pattern, rows.other, x, filter.per_sigma_x);
  return sum;
}

inline double Texture::waveValue(double x, double y, const Filter::Wave& filtered) const {
  const Wave& wave = waves_[filtered.which];
  const double lattice_x = x * wave.frequency + wave.origin_x, lattice_y = y * wave.frequency + wave.origin_y;
  if (filtered.steps == 1) return filtered.amplitude * noise(lattice_x, lattice_y);
  double sum = 0.0;
  for (int k = 0; k < filtered.steps; ++k) {
    const double along = k - 0.5 * (filtered.steps - 1);
    sum += noise(lattice_x + along * filtered.step_x, lattice_y + along * filtered.step_y);
  }
  return filtered.amplitude * sum / filtered.steps;
}

double Texture::value(double x, double y, const Filter& filter) const {
  double sum = filter.base, patchy = 0.0;
  for (std::size_t i = 0; i < filter.wave_count; ++i) {
    (waves_[filter.waves[i].which].patchy ? patchy : sum) += waveValue(x, y, filter.waves[i]);
  }
  if (patchy != 0.0) sum += patchy * mask(x, y);
  for (std::size_t i = 0; i < filter.pattern_count; ++i) {
    sum += filter.patterns[i].fade * patternValue(patterns_[filter.patterns[i].which], x, y, filter);
  }
  return sum;
}

/// Fills a run by a function of the position, or, where the function varies slowly, by a parabola through three of its
/// values.
template <typename Function>
void Texture::alongRun(const Run& x, const Run& y, double frequency, Function function, Run& out) {
  constexpr std::size_t kMiddle = kRun / 2, kLast = kRun - 1;
  const double span = std::max(std::abs(x[kLast] - x[0]), std::abs(y[kLast] - y[0])) * frequency;
  if (span > kSlowRun) {
    for (std::size_t i = 0; i < kRun; ++i) out[i] = function(x[i], y[i]);
    return;
  }
  const double a = function(x[0], y[0]), b = function(x[kMiddle], y[kMiddle]), c = function(x[kLast], y[kLast]);
  constexpr double kH1 = kMiddle, kH2 = kLast;
  const double curve = ((c - a) / kH2 - (b - a) / kH1) / (kH2 - kH1);
  const double slope = (b - a) / kH1 - curve * kH1;
  for (std::size_t i = 0; i < kRun; ++i) {
    const auto t = static_cast<double>(i);
    out[i] = a + t * (slope + t * curve);
  }
}

/// Returns the row of cells that contains the whole run, away from its edges; empty if there is none.
std::optional<int> Texture::commonRow(const Pattern& pattern, const Run& y, const Filter& filter) {
  const Part first = part(y[0], pattern.height, pattern.per_height, pattern.margin_y, filter.per_sigma_y);
  if (first.own_share != 1.0) return std::nullopt;
  const Part last = part(y[kRun - 1], pattern.height, pattern.per_height, pattern.margin_y, filter.per_sigma_y);
  if (last.own_share != 1.0 || last.own != first.own) return std::nullopt;
  return first.own;
}

bool Texture::isUniform(const Pattern& pattern, int row, const Run& x, const Filter& filter) {
  const double shift = (row & 1) != 0 ? pattern.shift * pattern.width : 0.0;
  const Part first = part(x[0] - shift, pattern.width, pattern.per_width, pattern.margin_x, filter.per_sigma_x);
  if (first.own_share != 1.0) return false;
  const Part last = part(x[kRun - 1] - shift, pattern.width, pattern.per_width, pattern.margin_x, filter.per_sigma_x);
  return last.own_share == 1.0 && last.own == first.own;
}

void Texture::values(const Run& x, const Run& y, const Filter& filter, Run& grey) const {
  Run part_values, patchy{};
  bool any_patchy = false;
  grey.fill(filter.base);
  for (std::size_t i = 0; i < filter.wave_count; ++i) {
    const Filter::Wave& wave = filter.waves[i];
    // Several steps along a footprint imply that adjacent pixels are far apart on the lattice.
    const double frequency = wave.steps == 1 ? waves_[wave.which].frequency : 1e9;
    alongRun(
        x, y, frequency, [&](double px, double py) { return waveValue(px, py, wave); }, part_values);
    const bool is_patchy = waves_[wave.which].patchy;
    any_patchy |= is_patchy;
    Run& sum = is_patchy ? patchy : grey;
    for (std::size_t k = 0; k < kRun; ++k) sum[k] += part_values[k];
  }
  if (any_patchy) {
    alongRun(
        x, y, kMaskFrequency, [&](double px, double py) { return mask(px, py); }, part_values);
    for (std::size_t k = 0; k < kRun; ++k) grey[k] += patchy[k] * part_values[k];
  }
  for (std::size_t i = 0; i < filter.pattern_count; ++i) {
    const Pattern& pattern = patterns_[filter.patterns[i].which];
    const double fade = filter.patterns[i].fade;
    const std::optional<int> row = commonRow(pattern, y, filter);
    if (row && isUniform(pattern, *row, x, filter)) {
      const double common = fade * rowValue(pattern, *row, x[0], filter.per_sigma_x);
      for (double& value : grey) value += common;
    } else if (row) {
      for (std::size_t k = 0; k < kRun; ++k) grey[k] += fade * rowValue(pattern, *row, x[k], filter.per_sigma_x);
    } else {
      for (std::size_t k = 0; k < kRun; ++k) grey[k] += fade * patternValue(pattern, x[k], y[k], filter);
    }
  }
}

}  // namespace urban_nav_core::testing
