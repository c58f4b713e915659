// SPDX-License-Identifier: BSD-3-Clause
// Compares the simulated LMS291 with the truth, with its data sheet, and with the real ones of the New College log.
//   lasers [--world NAME] [--duration S] [--places N] [--seed N] [-o FILE.json]
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "laser/lms291.hpp"
#include "motion/simulate_drive.hpp"
#include "ray_tracing/tracer.hpp"
#include "rig/sensor_poses.hpp"
#include "support/distribution.hpp"
#include "support/new_college_scans.hpp"
#include "support/program.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/types/frames.hpp"

namespace {

using namespace urban_nav_sim;
using namespace urban_nav_sim::bench;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;

constexpr int kTogether = 9;        // consecutive turns at a place
constexpr double kMixed = 0.1;      // m off the surface, beyond noise
constexpr double kSameThing = 0.2;  // m: larger jumps of a beam mean another object

/// Statistics of turns without ground truth.
struct Turning {
  Values ranges, intensities, jitter;  // m, 0 ... 255, mm
  double beams = 0.0, silent = 0.0, alone = 0.0;

  void add(const Turns& turns) {
    for (std::size_t k = 0; k < turns.ranges.size(); ++k) {
      const auto& range = turns.ranges[k];
      for (std::size_t i = 0; i < range.size(); ++i) {
        beams += 1.0;
        if (range[i] > 0.0) {
          ranges.push_back(range[i]);
          intensities.push_back(turns.intensities[k][i]);
        } else {
          silent += 1.0;
          if (i > 0 && i + 1 < range.size() && range[i - 1] > 0.0 && range[i + 1] > 0.0) alone += 1.0;
        }
        if (k + 2 < turns.ranges.size()) addJitter(range[i], turns.ranges[k + 1][i], turns.ranges[k + 2][i]);
      }
    }
  }

 private:
  /// Adds second differences, which cancel uniform motion, scaled to the noise of one range.
  void addJitter(double a, double b, double c) {
    if (!(a > 0.0 && b > 0.0 && c > 0.0) || std::abs(b - a) > kSameThing || std::abs(c - b) > kSameThing) return;
    jitter.push_back(1000.0 * std::abs(a - 2.0 * b + c) / std::sqrt(6.0));
  }
};

/// Errors relative to the truth at the centre of each beam.
struct Errors {
  Values near, far;   // mm, of ranges to 20 m and beyond, without mixed ones and the device's bias
  Values path, wall;  // reflectance of the ground 1 to 1.5 m away, of walls 3.5 to 5.5 m away
  Values far_plane;   // mm, of those beyond 20 m that lie on a plane
  double returns = 0.0, mixed = 0.0, reachable = 0.0, lost = 0.0, sky_returns = 0.0;

  /// `plane`: its neighbours hit the same plane; otherwise the centre of the beam is not representative of its width.
  void add(double range, double intensity, const BeamTruth& truth, double bias, double range_max, bool plane) {
    const bool returned = std::isfinite(range), reachable_now = truth.range < range_max;
    if (reachable_now) reachable += 1.0;
    if (reachable_now && !returned) lost += 1.0;
    if (!returned) return;
    returns += 1.0;
    if (!std::isfinite(truth.range)) sky_returns += 1.0;
    const SurfaceClass met = truth.surface_class;
    const bool is_path = met == SurfaceClass::DirtPath || met == SurfaceClass::Paved;
    const bool is_wall = met == SurfaceClass::TexturedWall || met == SurfaceClass::SmoothWall;
    if (is_path && range > 1.0 && range < 1.5) path.push_back(intensity);
    if (is_wall && range > 3.5 && range < 5.5) wall.push_back(intensity);
    const double error = range - truth.range - bias;
    if (!(std::abs(error) < kMixed)) mixed += 1.0;
    else (truth.range < 20.0 ? near : far).push_back(1000.0 * error);
    if (plane && truth.range >= 20.0 && std::abs(error) < kMixed) far_plane.push_back(1000.0 * error);
  }
};

/// Returns whether this beam and its neighbours hit one plane: the inverse range is then a sum of a sine and a cosine.
bool isOnPlane(const std::vector<BeamTruth>& truth, std::size_t i) {
  constexpr double kStep = 0.5 * M_PI / 180.0, kOff = 0.02;  // m
  if (i == 0 || i + 1 >= truth.size()) return false;
  const double a = truth[i - 1].range, b = truth[i].range, c = truth[i + 1].range;
  if (!std::isfinite(a) || !std::isfinite(b) || !std::isfinite(c)) return false;
  return std::abs(2.0 * std::cos(kStep) / (1.0 / a + 1.0 / c) - b) < kOff;
}

/// Returns half the width of the central 68 %: a robust standard deviation.
double coreSpread(const Values& values) { return 0.5 * (quantile(values, 0.8413) - quantile(values, 0.1587)); }

struct Simulated {
  Turning look;
  Errors errors;
  std::array<double, 2> bias{};  // m
};

Simulated simulated(const Options& options, const std::string& name) {
  const auto seed = static_cast<std::uint32_t>(options.number("--seed", 7));
  const World world = buildWorld(name, seed, 1);
  DriveOptions ride_options;
  ride_options.duration = options.number("--duration", 300);
  ride_options.seed = seed;
  const auto motion = simulateDrive(world, makeRoute(name, seed, "loops"), ride_options);
  const Tracer tracer(world);
  const Lms291::Settings settings;
  const int places = static_cast<int>(options.number("--places", 100));
  Simulated result;
  std::size_t device = 0;
  for (const char* frame : {urban_nav_core::frames::kLaserLeft, urban_nav_core::frames::kLaserRight}) {
    const Lms291 laser(tracer, sensorPose(frame), seed, frame, settings);
    result.bias[device++] = laser.bias();
    for (int place = 0; place < places; ++place) {
      Turns turns;
      for (int k = 0; k < kTogether; ++k) {
        const double t = (place + 0.5) * motion->duration() / places + k * settings.period;
        std::vector<BeamTruth> truth;
        const auto scan = laser.scan(*motion, t, 0, static_cast<std::uint64_t>(place * kTogether + k), &truth);
        std::vector<double> ranges, intensities(scan.intensities.begin(), scan.intensities.end());
        for (std::size_t i = 0; i < truth.size(); ++i) {
          const auto range = static_cast<double>(scan.ranges[i]);
          ranges.push_back(std::isfinite(range) ? range : 0.0);
          result.errors.add(range, intensities[i], truth[i], laser.bias(), settings.range_max, isOnPlane(truth, i));
        }
        turns.ranges.push_back(std::move(ranges));
        turns.intensities.push_back(std::move(intensities));
      }
      result.look.add(turns);
    }
  }
  return result;
}

Turning realTurns() {
  Turning look;
  const std::string path = realData("new_college/QuadTree_Alog.alog.xz");
  if (path.empty()) return look;
  for (const char* side : {"LEFT", "RIGHT"}) look.add(newCollegeTurns(path, side));
  return look;
}

/// Returns "5th ... 95th percentile", as stated for the New College data set (Smith et al. 2009).
std::string band(const Values& values) {
  return cell(quantile(values, 0.05), 0) + " ... " + cell(quantile(values, 0.95), 0);
}

std::string percent(double part, double whole) { return cell(100.0 * part / std::max(whole, 1.0), 2); }

}  // namespace

int main(int argc, char** argv) try {
  const Options options(argc, argv);
  const std::string world = options.text("--world", "quad");
  const Turning real = realTurns();
  const Simulated sim = simulated(options, world);
  const Turning& look = sim.look;
  const Errors& errors = sim.errors;

  BenchTable table({"", "asked for, or real", world, "distance"}, argc, argv);
  table.add({"noise to 20 m (mm)", "5", cell(coreSpread(errors.near), 2), ""});
  table.add({"noise beyond 20 m (mm)", "10", cell(coreSpread(errors.far), 2), ""});
  table.add({"... where three beams meet one plane (mm)", "10", cell(coreSpread(errors.far_plane), 2), ""});
  table.add(
      {"bias left, right (mm)", "within 5", cell(1000 * sim.bias[0], 2) + ", " + cell(1000 * sim.bias[1], 2), ""});
  table.add({"median error to 20 m without the bias (mm)", "0", cell(quantile(errors.near, 0.5), 2), ""});
  table.add({"returns over 0.1 m off (%)", "", percent(errors.mixed, errors.returns), ""});
  table.add({"of things nearer than 32.7 m, no return (%)", "", percent(errors.lost, errors.reachable), ""});
  table.add({"reflectance of the path, 1 to 1.5 m away", "37 ... 54", band(errors.path), ""});
  table.add({"reflectance of walls, 3.5 to 5.5 m away", "53 ... 80", band(errors.wall), ""});
  const auto beside = [&](const std::string& what, const Values& a, const Values& b, int decimals) {
    table.add({what, b.empty() ? "-" : summary(b, decimals), summary(a, decimals),
               b.empty() ? "-" : cell(distributionDistance(a, b), 2)});
  };
  beside("range (m)", look.ranges, real.ranges, 2);
  beside("reflectance", look.intensities, real.intensities, 0);
  beside("jitter from turn to turn (mm)", look.jitter, real.jitter, 2);
  table.add({"no return (%)", percent(real.silent, real.beams), percent(look.silent, look.beams), ""});
  table.add(
      {"... between two that have one (%)", percent(real.alone, real.beams), percent(look.alone, look.beams), ""});
  table.note(
      "Upper half: compared with the surfaces on the axes of the simulated beams. Lower half: compared with 518 turns, "
      "3.5 s, of the two real lasers of the New College log, as median (tenth ... ninth decile); distance: earth "
      "mover's, in units of the real standard deviation. Jitter: second differences of a beam over three turns, over "
      "the root of 6.");
  return show(table, options);
} catch (const std::exception& error) {
  return urban_nav_sim::bench::complain(error);
}
