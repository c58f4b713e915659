// SPDX-License-Identifier: BSD-3-Clause
// Rows of Tables 2 and 3 of the paper, on real sequences: average, minimum and maximum of each.
//   swf_vo-bench-tables2_3 [FOLDER...] [-o results/tables2_3.json]
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>

#include "support/program.hpp"
#include "support/run.hpp"
#include "urban_nav_core/testing/bench_table.hpp"

namespace {

using namespace swf_vo::bench;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;

struct Series {
  std::string name;
  std::vector<double> values;
  int decimals;
};

std::vector<Series> makeSeries(const Sequence& sequence, const Run& run) {
  Series speed{"velocity (m/s)", {}, 2}, turn{"angular velocity (deg/s)", {}, 2}, rate{"frames per second", {}, 0};
  Series features{"features per frame", {}, 0}, length{"feature track length", {}, 2},
      error{"reprojection error (px)", {}, 3};
  for (std::size_t i = 1; i < run.settled.size(); ++i) {
    const double seconds = urban_nav_core::secondsBetween(sequence.stamps[i - 1], sequence.stamps[i]);
    speed.values.push_back(distanceBetween(run.settled[i - 1], run.settled[i]) / seconds);
    turn.values.push_back(angleBetween(run.settled[i - 1], run.settled[i]) * 180.0 / M_PI / seconds);
    rate.values.push_back(1000.0 / run.ms[i]);
    features.values.push_back(run.statistics[i].features);
    length.values.push_back(run.statistics[i].track_length_mean);
    error.values.push_back(run.statistics[i].reprojection_px);
  }
  return {speed, turn, rate, features, length, error};
}

double travelled(const Run& run) {
  double sum = 0.0;
  for (std::size_t i = 1; i < run.settled.size(); ++i) sum += distanceBetween(run.settled[i - 1], run.settled[i]);
  return sum;
}

}  // namespace

int main(int argc, char** argv) try {
  const auto [folders, output] = foldersAndOutput(argc, argv);

  BenchTable table({"sequence", "row", "average", "minimum", "maximum"}, argc, argv);
  for (const std::string& folder : folders) {
    const Sequence sequence = kittiFolder(folder);
    const Run result = run(sequence, swf_vo::Parameters());
    table.add({sequence.name, "distance travelled (km)", "", "", cell(travelled(result) / 1000.0, 3)});
    table.add({"", "frames processed", "", "", std::to_string(result.settled.size())});
    for (const Series& series : makeSeries(sequence, result)) {
      const auto [low, high] = std::minmax_element(series.values.begin(), series.values.end());
      const double mean =
          std::accumulate(series.values.begin(), series.values.end(), 0.0) / static_cast<double>(series.values.size());
      table.add(
          {"", series.name, cell(mean, series.decimals), cell(*low, series.decimals), cell(*high, series.decimals)});
    }
  }
  return show(table, output);
} catch (const std::exception& error) {
  return complain(error);
}
