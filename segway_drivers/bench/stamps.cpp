// SPDX-License-Identifier: BSD-3-Clause
// Measures errors of stamps beyond the minimum delay, by rate and delay model.
//
//   segway_drivers-bench-stamps [-o FILE.json] [--trials N]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "segway_drivers/clock/clock_filter.hpp"
#include "urban_nav_core/testing/bench_table.hpp"

namespace {

using segway_drivers::TimeNs;
using urban_nav_core::testing::cell;
using Delay = std::function<double(double, std::mt19937&)>;

constexpr double kDuration = 240.0, kLeastDelay = 1e-3;  // s

struct DelayCase {
  std::string name;
  Delay delay;          // s, as a function of time in s
  double known = 2.0;   // s after which the delays are observable
  double settled = 60;  // s
};

struct StampErrors {
  double early = 0.0, settled = 0.0;  // s, maxima
  long judged = 0, within = 0;
};

double longTail(double, std::mt19937& random) {
  return kLeastDelay + std::min(std::exponential_distribution<double>(1.0 / 3e-3)(random), 19e-3);
}

double uniform(double, std::mt19937& random) { return std::uniform_real_distribution<double>(1e-3, 20e-3)(random); }

Delay raised(const Delay& delay, double from, double to) {
  return [=](double t, std::mt19937& random) { return delay(t, random) + (t > from && t < to ? 5e-3 : 0.0); };
}

void runTrial(const DelayCase& which, double period, unsigned seed, StampErrors& errors) {
  std::mt19937 random(seed);
  const double skew = seed % 2 == 0 ? 100e-6 : -100e-6;
  segway_drivers::ClockOptions options;
  options.period = period;
  segway_drivers::ClockFilter filter(options);
  double last = 0.0;
  for (int i = 0; i * period < kDuration; ++i) {
    const double t = i * period;
    last = std::max(last, t + which.delay(t, random));
    const auto estimate = filter.add(t * (1.0 + skew), static_cast<TimeNs>(std::llround(1e9 * last)));
    if (!estimate.time || t < which.known) continue;
    const double error = std::abs(1e-9 * static_cast<double>(*estimate.time) - t - kLeastDelay);
    errors.early = std::max(errors.early, error);
    if (t > which.settled) errors.settled = std::max(errors.settled, error);
    ++errors.judged;
    errors.within += error < 4.0 * estimate.sigma + 1e-4 ? 1 : 0;
  }
}

}  // namespace

int main(int argc, char** argv) {
  urban_nav_core::testing::BenchTable table(
      {"delays", "rate, Hz", "largest error from 2 s, ms", "from 60 s, ms", "within 4 sigma + 0.1 ms, %"}, argc, argv);
  std::string output;
  unsigned trials = 40;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::string(argv[i]) == "-o") output = argv[i + 1];
    if (std::string(argv[i]) == "--trials") trials = static_cast<unsigned>(std::max(std::atoi(argv[i + 1]), 1));
  }
  const std::vector<DelayCase> cases = {
      {"1 ms + exponential of 3 ms", longTail},
      {"uniform, 1 to 20 ms", uniform},
      {"exponential, 5 ms more from 100 to 160 s", raised(longTail, 100.0, 160.0)},
      {"uniform, 5 ms more from 65 to 125 s", raised(uniform, 65.0, 125.0)},
      {"exponential, 5 ms more up to 40 s", raised(longTail, 0.0, 40.0), 45.0},
  };
  for (const DelayCase& which : cases)
    for (const double rate : {74.973, 100.0, 20.0}) {
      StampErrors errors;
      for (unsigned seed = 0; seed < trials; ++seed) runTrial(which, 1.0 / rate, seed, errors);
      table.add({which.name, cell(rate, rate > 70 && rate < 80 ? 3 : 0), cell(1e3 * errors.early, 2),
                 cell(1e3 * errors.settled, 2),
                 cell(100.0 * static_cast<double>(errors.within) / static_cast<double>(errors.judged), 1)});
    }
  table.note("Largest of " + std::to_string(trials) +
             " trials of 240 s each, skew +100 or -100 ppm; sessions whose delays are longer up to 40 s are assessed "
             "from 45 s on, since the longer delay is not observable before.");
  std::fputs(table.text().c_str(), stdout);
  if (!output.empty()) table.write(output);
  return 0;
}
