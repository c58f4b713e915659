// SPDX-License-Identifier: BSD-3-Clause
// Errors and ms per frame by the number of tracked features; the default scales with the area to the power of 2/3, "by
// area" is proportional to the area.
//   swf_vo-bench-features [FOLDER...] [-o results/features.json]
// FOLDER: a sequence in KITTI's layout with poses.txt; default: the two real ones.
#include <cmath>
#include <numeric>
#include <string>

#include "support/program.hpp"
#include "support/run.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/testing/quantile.hpp"

namespace {

using namespace swf_vo::bench;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::quantile;

struct Variant {
  std::string name;
  std::vector<std::string> sets;
};

std::vector<Variant> variantsFor(const Sequence& sequence) {
  const double area = sequence.camera.left.width * sequence.camera.left.height / (512.0 * 384.0);
  const int normal = swf_vo::Parameters().features;
  const auto set = [](double features) {
    return std::vector<std::string>{"swf_vo.features=" + std::to_string(std::lround(features))};
  };
  return {{"half", set(0.5 * normal)},
          {"defaults", {}},
          {"by area", set(normal * std::cbrt(area))},
          {"twice", set(2.0 * normal)}};
}

double meanFeatures(const Run& run) {
  return std::accumulate(run.statistics.begin(), run.statistics.end(), 0.0,
                         [](double sum, const auto& statistics) { return sum + statistics.features; }) /
         static_cast<double>(run.statistics.size());
}

}  // namespace

int main(int argc, char** argv) try {
  const auto [folders, output] = foldersAndOutput(argc, argv);

  BenchTable table({"sequence", "features", "followed", "ms a frame, median", "10 frames", "50 frames"}, argc, argv);
  for (const std::string& folder : folders) {
    const Sequence sequence = kittiFolder(folder);
    for (const Variant& variant : variantsFor(sequence)) {
      const Run result = run(sequence, parametersFrom(variant.sets));
      const auto spans = [&](std::size_t frames) {
        const SpanErrors e = spanErrors(sequence.truth, result.settled, frames);
        return cell(e.percent, 3) + " %, " + cell(e.deg_per_m, 4) + " deg/m";
      };
      table.add({sequence.name, variant.name, cell(meanFeatures(result), 0), cell(quantile(result.ms, 0.5), 1),
                 spans(10), spans(50)});
    }
  }
  return show(table, output);
} catch (const std::exception& error) {
  return complain(error);
}
