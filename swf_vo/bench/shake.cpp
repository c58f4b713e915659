// SPDX-License-Identifier: BSD-3-Clause
// A shaken handheld camera, with motion blur, at low frame rates: final error and number of predicted frames.
//   swf_vo-bench-shake [--set swf_vo.NAME=VALUE]... [-o results/shake.json]
#include <algorithm>
#include <cmath>

#include "support/program.hpp"
#include "support/run.hpp"
#include "swf_vo/swf_vo.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/testing/sequence_folder.hpp"
#include "urban_nav_core/testing/textured_room.hpp"

namespace {

using namespace swf_vo::bench;
using urban_nav_core::Pose;
using urban_nav_core::testing::cell;

constexpr double kDegree = M_PI / 180.0;
constexpr double kSeconds = 8.0;

struct Shake {
  double rate;       // Hz, of frames
  double reach, hz;  // amplitude (m) and frequency of the shaking
  double step_deg;   // approximate largest angle between two frames
  double exposure;   // s
};

/// Result of a run.
struct Outcome {
  double path_m = 0.0, end_m = 0.0, end_deg = 0.0, worst_m = 0.0;
  int frames = 0, lost = 0;
};

Outcome play(const Shake& shake, std::uint32_t seed, const swf_vo::Parameters& parameters) {
  urban_nav_core::testing::SequenceOptions options;
  options.camera = {300.0, 300.0, 191.5, 143.5, 384, 288, 0.12, 0.5};
  options.rate = shake.rate;
  options.exposure = shake.exposure;
  options.seed = seed;
  const double angle = shake.step_deg * kDegree * shake.rate / (2.0 * M_PI * shake.hz);
  urban_nav_core::testing::RenderedSequence sequence(
      urban_nav_core::testing::texturedRoom(),
      urban_nav_core::testing::shake({0.3 * seed - 0.6, 0.0, 1.1}, shake.reach, angle, shake.hz), options);
  const auto recording = urban_nav_core::testing::record(sequence, static_cast<int>(kSeconds * shake.rate));
  swf_vo::SwfVo filter(parameters, recording.camera, Pose());
  Outcome outcome;
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    const swf_vo::Frame& frame = filter.process(recording.frames[i].pair(), {});
    ++outcome.frames;
    outcome.lost += frame.status.health == urban_nav_core::Health::Lost;
    outcome.end_m = distanceBetween(recording.truth[i], frame.T_odom_base.pose);
    outcome.end_deg = angleBetween(recording.truth[i], frame.T_odom_base.pose) / kDegree;
    outcome.worst_m = std::max(outcome.worst_m, outcome.end_m);
    if (i > 0) outcome.path_m += distanceBetween(recording.truth[i - 1], recording.truth[i]);
  }
  return outcome;
}

}  // namespace

int main(int argc, char** argv) try {
  std::vector<std::string> sets;
  std::string output;
  for (int i = 1; i + 1 < argc; i += 2) (std::string(argv[i]) == "-o" ? output : sets.emplace_back()) = argv[i + 1];
  urban_nav_core::testing::BenchTable table({"frames a second", "angle of a step, at most, deg", "exposure, ms", "room",
                                             "path, m", "error at the end, m", "deg", "largest, m", "frames lost"},
                                            argc, argv);
  for (const Shake& shake : {Shake{5.0, 0.15, 0.7, 10.0, 0.0}, Shake{5.0, 0.15, 0.7, 10.0, 0.02},
                             Shake{5.0, 0.15, 0.7, 10.0, 0.04}, Shake{5.0, 0.15, 0.7, 15.0, 0.02}})
    for (const std::uint32_t seed : {1U, 2U}) {
      const Outcome outcome = play(shake, seed, parametersFrom(sets));
      table.add({cell(shake.rate, 0), cell(shake.step_deg, 1), cell(1000.0 * shake.exposure, 0), std::to_string(seed),
                 cell(outcome.path_m, 2), cell(outcome.end_m, 4), cell(outcome.end_deg, 2), cell(outcome.worst_m, 4),
                 std::to_string(outcome.lost) + " of " + std::to_string(outcome.frames)});
    }
  return show(table, output);
} catch (const std::exception& error) {
  return complain(error);
}
