// SPDX-License-Identifier: BSD-3-Clause
// Ground plane and obstacles compared with the ground truth of simulated sessions.
//
//   dense_stereo-bench-ground [-o FILE.json] [--step N] [NAME FOLDER TRUTH_FOLDER]...
//
// FOLDER and TRUTH_FOLDER: of `urban_nav simulate --folder FOLDER --views stereo -o BAG`.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "support/arguments.hpp"
#include "support/true_scene.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/testing/quantile.hpp"

namespace {

using dense_stereo::NearScene;
using dense_stereo::bench::TrueObstacle;
using dense_stereo::bench::TrueScene;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::quantile;

/// Figures of one world.
struct GroundFigures {
  int pairs = 0, planar = 0, found = 0, obstacles = 0, obstacles_found = 0, false_obstacles = 0;
  std::vector<double> degrees, centimetres;

  void add(const TrueScene& truth, const NearScene& scene) {
    ++pairs;
    if (truth.ground) {
      ++planar;
      if (scene.ground.isFound()) {
        ++found;
        degrees.push_back(std::acos(std::min(1.0, scene.ground.up.dot(truth.ground->up))) * 180.0 / M_PI);
        centimetres.push_back(100.0 * std::abs(scene.ground.height - truth.ground->height));
      }
    }
    if (!truth.ground || !scene.ground.isFound()) return;
    for (const TrueObstacle& obstacle : truth.obstacles) {
      ++obstacles;
      obstacles_found += obstacle.isHitBy(scene.obstacles) ? 1 : 0;
    }
    false_obstacles += truth.countFalse(scene.obstacles);
  }
};

}  // namespace

int main(int argc, char** argv) {
  urban_nav_core::testing::BenchTable table(
      {"world", "pairs", "with a true plane", "plane found", "angle, deg: median, 95 %", "height, cm: median, 95 %",
       "obstacles over 10 cm", "of these found", "false obstacles in 100 pairs"},
      argc, argv);
  const dense_stereo::bench::BenchArguments arguments = dense_stereo::bench::readBenchArguments(argc, argv, 10);
  const std::vector<std::string>& words = arguments.words;
  for (std::size_t i = 0; i + 2 < words.size(); i += 3) {
    GroundFigures figures;
    dense_stereo::bench::forEachTrueScene(
        words[i + 1], words[i + 2], arguments.step,
        [&](const TrueScene& truth, const NearScene& scene) { figures.add(truth, scene); });
    const auto both = [](const std::vector<double>& values) {
      return cell(quantile(values, 0.5), 2) + ", " + cell(quantile(values, 0.95), 2);
    };
    table.add({words[i], std::to_string(figures.pairs), std::to_string(figures.planar), std::to_string(figures.found),
               both(figures.degrees), both(figures.centimetres), std::to_string(figures.obstacles),
               std::to_string(figures.obstacles_found),
               cell(100.0 * figures.false_obstacles / std::max(figures.pairs, 1), 1)});
  }
  table.note(
      "True plane: least squares through the true ground within 5 m. Obstacles: connected surfaces 10 cm or more above "
      "it, 1 to 5 m ahead, visible in both cameras with 60 pixels or more. False: connected obstacle points with "
      "nothing over 5 cm within 25 cm.");
  std::fputs(table.text().c_str(), stdout);
  if (!arguments.output.empty()) table.write(arguments.output);
  return 0;
}
