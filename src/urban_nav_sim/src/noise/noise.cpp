// SPDX-License-Identifier: BSD-3-Clause
#include "noise/noise.hpp"

#include <array>
#include <cmath>

namespace urban_nav_sim {
namespace {

constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15U;  // 2^64 divided by the golden ratio, odd

// FNV-1a (Fowler, Noll, Vo).
std::uint64_t hashName(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

int changesOfBits(std::uint64_t x) { return __builtin_popcountll(x ^ (x >> 1)); }

// ln u for 0 < u < 1: u = m 2^e with m about 1, ln m = 2 artanh((m - 1) / (m + 1)) by its series, to full precision.
double logarithm(double u) {
  int exponent = 0;
  double m = std::frexp(u, &exponent);
  if (m < 0.70710678118654752) {
    m *= 2.0;
    --exponent;
  }
  const double s = (m - 1.0) / (m + 1.0), s2 = s * s;
  double sum = 0.0;
  for (int k = 21; k >= 1; k -= 2) sum = sum * s2 + 1.0 / k;
  return 2.0 * s * sum + exponent * 0.69314718055994531;
}

// cos(2 pi v) for 0 <= v < 1: Taylor series within an eighth of a turn of the nearest quarter, to full precision.
double cosineOfTurn(double v) {
  const auto quarter = std::lround(v * 4.0);
  const double x = 6.2831853071795865 * (v - 0.25 * static_cast<double>(quarter)), x2 = x * x;
  double cosine = 1.0, sine = 1.0;
  for (int k = 16; k >= 2; k -= 2) {
    cosine = 1.0 - cosine * x2 / (k * (k - 1));
    sine = 1.0 - sine * x2 / (k * (k + 1));
  }
  const std::array<double, 4> of_quarter{cosine, -x * sine, -cosine, x * sine};
  return of_quarter[static_cast<std::size_t>(quarter % 4)];
}

}  // namespace

double normalFrom(std::uint64_t bits) {
  const double radius = (static_cast<double>(bits >> 32) + 0.5) * 0x1.0p-32;
  const double turn = static_cast<double>(bits & 0xffffffffU) * 0x1.0p-32;
  return std::sqrt(-2.0 * logarithm(radius)) * cosineOfTurn(turn);
}

Noise::Noise(std::uint64_t seed, std::uint64_t number)
    : start_(mixed(mixed(seed + kGolden) + number * kGolden)), step_(mixed(start_ + kGolden) | 1U) {
  // Steps whose bits rarely alternate mix poorly (section 4.3).
  if (changesOfBits(step_) < 24) step_ ^= 0xaaaaaaaaaaaaaaaaU;
}

Noise::Noise(std::uint64_t seed, std::string_view name) : Noise(seed, hashName(name)) {}

Noise Noise::of(std::uint64_t number) const { return Noise(start_ ^ step_, number); }
Noise Noise::of(std::string_view name) const { return Noise(start_ ^ step_, hashName(name)); }

Eigen::Vector3d Noise::normal3(std::uint64_t counter) const {
  const Noise three = of(counter);
  return {three.normal(0), three.normal(1), three.normal(2)};
}

float Noise::roughNormal(std::uint64_t counter) const {
  constexpr std::uint64_t kEveryOther = 0x00ff00ff00ff00ffU;
  const std::uint64_t both = bits(counter);
  const std::uint64_t pairs = (both & kEveryOther) + ((both >> 8) & kEveryOther);
  const auto sum = static_cast<std::int32_t>((pairs * 0x0001000100010001U) >> 48);
  return static_cast<float>(sum - 1020) * 0.00478396F;  // 1 / sqrt(8 (256^2 - 1) / 12)
}

}  // namespace urban_nav_sim
