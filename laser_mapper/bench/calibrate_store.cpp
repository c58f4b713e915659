// SPDX-License-Identifier: BSD-3-Clause
// Calibrates the lasers of a session store along a trajectory, the true one for example, and reports what is found:
//   calibrate_store STORE TRAJECTORY.tum [THREADS]
// Nothing is written.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

#include "laser_mapper/calibration/laser_calibration.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace laser_mapper::bench {

void calibrateStore(const std::string& store_path, const std::string& trajectory_path, int threads) {
  const urban_nav_core::ThreadLimit limit(threads);
  urban_nav_store::Store store(store_path, urban_nav_store::Access::Read);
  const urban_nav_core::Trajectory trajectory = urban_nav_core::readTum(trajectory_path);
  const auto sessions = store.sessions().all();
  if (sessions.empty()) throw std::runtime_error(store_path + ": no session");
  const auto begin = std::chrono::steady_clock::now();
  const CalibrationResult found = calibrateLasers(Parameters(), store, sessions.front().id, trajectory, nullptr);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const char* names[] = {"delay", "shift x", "shift y", "shift z", "turn x", "turn y", "turn z"};
  const char* units[] = {"ms", "mm", "mm", "mm", "deg", "deg", "deg"};
  for (const DeviceCalibration& laser : found.lasers)
    for (std::size_t i = 0; i < laser.terms.size(); ++i) {
      const CalibrationEstimate& term = laser.terms[i];
      const double scale = i < 4 ? 1e3 : 180.0 / M_PI;
      std::printf("%s %s: %.3f +- %.3f %s, adopted %.3f%s\n", laser.frame.c_str(), names[i], scale * term.value,
                  scale * term.sigma, units[i], scale * term.adopted, term.constrained ? "" : ", not constrained");
    }
  for (const std::string& sentence : found.unconstrained) std::printf("not constrained: %s\n", sentence.c_str());
  std::printf("%zu places; %zu held out: spread %.2f mm as stated, %.2f mm calibrated, better by %.2f +- %.2f mm\n",
              found.places, found.held_out, 1e3 * found.stated_spread, 1e3 * found.calibrated_spread,
              1e3 * found.improvement, 1e3 * found.improvement_sigma);
  std::printf("%s, %.1f s\n", found.isAdopted() ? "adopted" : "not adopted", seconds);
}

}  // namespace laser_mapper::bench

int main(int argc, char** argv) try {
  if (argc < 3) {
    std::fprintf(stderr, "usage: calibrate_store STORE TRAJECTORY.tum [THREADS]\n");
    return 2;
  }
  laser_mapper::bench::calibrateStore(argv[1], argv[2], argc > 3 ? std::stoi(argv[3]) : 1);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
