// SPDX-License-Identifier: BSD-3-Clause
// Measures the cost of a second of a session by world, sensor and number of threads: processor time, wall time, memory.
// Only of measurements, without writing a bag.
//   speed [--duration S] [--seed N] [--world NAME] [-o FILE.json]
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <iostream>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/program.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/testing/processor_time.hpp"
#include "urban_nav_sim/session.hpp"

namespace {

using namespace urban_nav_sim;
using namespace urban_nav_sim::bench;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::processMs;

struct Cost {
  double build = 0.0;                   // core-seconds until the first measurement is available
  double processor = 0.0, clock = 0.0;  // s, of the session
  double memory = 0.0;                  // MB at most
};

Cost measureCost(const SessionOptions& options, int threads) {
  const urban_nav_core::ThreadLimit limit(threads);
  Cost cost;
  const double start = processMs();
  Session session(options);
  const double built = processMs();
  const auto begin = std::chrono::steady_clock::now();
  while (session.next()) continue;
  cost.build = 1e-3 * (built - start);
  cost.processor = 1e-3 * (processMs() - built);
  cost.clock = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  cost.memory = static_cast<double>(usage.ru_maxrss) / 1024.0;
  return cost;
}

/// Measures in a separate process, since peak memory is per process.
Cost measured(const SessionOptions& options, int threads) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no second process");
  if (child == 0) {
    int status = 1;
    try {
      const Cost cost = measureCost(options, threads);
      status = write(ends[1], &cost, sizeof cost) == static_cast<ssize_t>(sizeof cost) ? 0 : 1;
    } catch (const std::exception& error) {
      std::cerr << error.what() << "\n";
    }
    _exit(status);
  }
  close(ends[1]);
  Cost cost;
  const bool got = read(ends[0], &cost, sizeof cost) == static_cast<ssize_t>(sizeof cost);
  close(ends[0]);
  int status = 0;
  if (waitpid(child, &status, 0) != child || status != 0 || !got) throw std::runtime_error("a session did not end");
  return cost;
}

}  // namespace

int main(int argc, char** argv) try {
  const Options options(argc, argv);
  SessionOptions session;
  session.seed = static_cast<std::uint32_t>(options.number("--seed", 7));
  session.duration = options.number("--duration", 6);
  const std::string only = options.text("--world", "");

  BenchTable table(
      {"world", "sensors", "threads", "core-seconds a second", "seconds a second", "world, core-seconds", "memory, MB"},
      argc, argv);
  for (const std::string& world : townNames()) {
    if (!only.empty() && world != only) continue;
    session.world = world;
    const auto add = [&](const std::string& name, const std::set<Sensor>& sensors, int threads) {
      session.sensors = sensors;
      const Cost cost = measured(session, threads);
      table.add({world, name, std::to_string(threads), cell(cost.processor / session.duration, 3),
                 cell(cost.clock / session.duration, 3), cell(cost.build, 2), cell(cost.memory, 0)});
    };
    for (const Sensor sensor : kAllSensors) add(toString(sensor), {sensor}, 1);
    for (const int threads : {1, 2}) add("all", {kDefaultSensors.begin(), kDefaultSensors.end()}, threads);
  }
  table.note(
      "Allowed with all sensors: 6.67 core-seconds a second (60 s in 200 s on two cores) and 2 000 MB. Measurements "
      "only, without a bag. Wall time is meaningful only on an idle machine.");
  return show(table, options);
} catch (const std::exception& error) {
  return urban_nav_sim::bench::complain(error);
}
