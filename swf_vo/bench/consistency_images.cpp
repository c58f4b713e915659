// SPDX-License-Identifier: BSD-3-Clause
// Consistency of the covariance on images: normalised estimation error squared of the pose (6 degrees of freedom;
// expected 6) at frames 50, 100 and 200, averaged over runs in rendered rooms: wandering, turning through 360 deg with
// stops, and around the room, at three levels of image noise, with default parameters, with an exact calibration and
// with one whose disparity error is that assumed by the filter; also of T_{i,i+100} composed of the relative poses and
// their drifts, and of single steps.
//   swf_vo-bench-consistency_images [--runs N] [--set swf_vo.NAME=VALUE]... [-o results/consistency_images.json]
#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <random>
#include <string>

#include "support/program.hpp"
#include "support/run.hpp"
#include "urban_nav_core/geometry/compose.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/trajectory/nees.hpp"

namespace {

using namespace swf_vo::bench;
using swf_vo::Parameters;
using urban_nav_core::Pose;
using urban_nav_core::PoseWithCovariance;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;

constexpr std::array<std::size_t, 3> kCheckpoints = {50, 100, 200};
const std::array<const char*, 3> kMotions = {"wander", "turns", "loop"};

struct Mean {
  double sum = 0.0, translation = 0.0, rotation = 0.0;
  int count = 0;
  void add(const Pose& truth, const PoseWithCovariance& estimate) {
    const auto all = urban_nav_core::nees(truth, estimate);
    if (!all) return;
    sum += *all;
    translation += *urban_nav_core::neesTranslation(truth, estimate);
    rotation += *urban_nav_core::neesRotation(truth, estimate);
    ++count;
  }
  std::string text() const {
    return count == 0
               ? "-"
               : cell(sum / count, 2) + " (" + cell(translation / count, 2) + " + " + cell(rotation / count, 2) + ")";
  }
};

struct Score {
  std::array<Mean, 3> at;
  Mean composed, steps;
  double error_m = 0.0, error_deg = 0.0;
  int runs = 0;
};

// Frames 50 to 150 from the settled relative poses: by their drifts and the two ends (RelativePose::drift_covariance).
PoseWithCovariance composed(const Run& run) {
  constexpr std::size_t kFirst = 51, kLast = 150;
  PoseWithCovariance sum;
  sum.covariance.setZero();
  for (std::size_t i = kFirst; i <= kLast; ++i) {
    urban_nav_core::Matrix6d covariance = run.drift_covariance[i];
    if (i == kFirst || i == kLast) covariance += 0.5 * run.relative_covariance[i];
    sum = compose(sum, PoseWithCovariance{run.settled[i - 1].inverse() * run.settled[i], covariance});
  }
  return sum;
}

// Each step with its covariance.
void addSteps(Mean& steps, const Sequence& sequence, const Run& run) {
  for (std::size_t i = 1; i < run.settled.size(); ++i)
    steps.add(sequence.truth[i - 1].inverse() * sequence.truth[i],
              {run.settled[i - 1].inverse() * run.settled[i], run.relative_covariance[i]});
}

void addRun(Score& score, const Sequence& sequence, const Run& run) {
  for (std::size_t c = 0; c < kCheckpoints.size(); ++c)
    score.at[c].add(sequence.truth[kCheckpoints[c]], {run.now[kCheckpoints[c]], run.now_covariance[kCheckpoints[c]]});
  score.composed.add(sequence.truth[50].inverse() * sequence.truth[150], composed(run));
  addSteps(score.steps, sequence, run);
  score.error_m += distanceBetween(sequence.truth.back(), run.now.back());
  score.error_deg += angleBetween(sequence.truth.back(), run.now.back()) * 180.0 / M_PI;
  ++score.runs;
}

}  // namespace

int main(int argc, char** argv) try {
  int runs = 50;
  std::string output;
  std::vector<std::string> sets;
  std::vector<double> noises = {1.0, 3.0, 6.0};
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::string(argv[i]) == "--runs") runs = std::stoi(argv[++i]);
    else if (std::string(argv[i]) == "--noise") noises = {std::stod(argv[++i])};
    else if (std::string(argv[i]) == "--set") sets.emplace_back(argv[++i]);
    else if (std::string(argv[i]) == "-o") output = argv[++i];
  }
  const Parameters parameters = parametersFrom(sets);
  BenchTable table({"calibration", "image noise (grey levels)", "motion", "runs", "NEES at 50", "at 100", "at 200",
                    "T_i,i+100 composed", "one step", "error at 200"},
                   argc, argv);
  // Grouped by calibration and noise, for each motion and for all.
  std::vector<std::array<Score, kMotions.size() + 1>> scores(2 * noises.size());
  for (int r = 0; r < runs; ++r) {
    const std::size_t motion = static_cast<std::size_t>(r) % kMotions.size();
    RenderedOptions options;
    options.motion = kMotions[motion];
    options.seed = static_cast<std::uint32_t>(r + 1);
    std::vector<double> exposures = noises;
    exposures.insert(exposures.end(), noises.begin(), noises.end());
    std::vector<Sequence> sequences = renderedAt(exposures, options);
    std::mt19937 generator(options.seed);
    std::normal_distribution<double> offset(0.0, parameters.disparity_offset);
    const double wrong = offset(generator);
    for (std::size_t s = noises.size(); s < sequences.size(); ++s) sequences[s].camera.disparity_offset = wrong;
    const std::vector<Run> results = runTogether(sequences, parameters);
    for (std::size_t s = 0; s < sequences.size(); ++s) {
      addRun(scores[s][motion], sequences[s], results[s]);
      addRun(scores[s].back(), sequences[s], results[s]);
      std::cerr << sequences[s].name << ", noise " << exposures[s] << ", disparities off by "
                << cell(sequences[s].camera.disparity_offset, 3) << " px: off by "
                << cell(distanceBetween(sequences[s].truth.back(), results[s].now.back()), 4) << " m\n";
    }
  }
  for (std::size_t n = 0; n < scores.size(); ++n)
    for (std::size_t m = 0; m <= kMotions.size(); ++m) {
      const Score& s = scores[n][m];
      if (s.runs == 0) continue;
      const bool exact = n < noises.size();
      table.add({exact ? "exact" : "drawn", cell(noises[n % noises.size()], 0),
                 m < kMotions.size() ? kMotions[m] : "all", std::to_string(s.runs), s.at[0].text(), s.at[1].text(),
                 s.at[2].text(), exact ? s.composed.text() : "-", s.steps.text(),
                 cell(1000.0 * s.error_m / s.runs, 1) + " mm, " + cell(s.error_deg / s.runs, 3) + " deg"});
    }
  table.note(
      "Calibration drawn: the disparities of a run have a random offset with the standard deviation that the filter "
      "assumes (disparity_offset). It is the same in all steps, so that the drift of steps does not contain it.");
  table.note(
      "NEES: 6 is expected; of a mean over 50 runs, 99 % lie between 4.81 and 7.34. In brackets translation and "
      "rotation, 3 each.");
  return show(table, output);
} catch (const std::exception& error) {
  return complain(error);
}
