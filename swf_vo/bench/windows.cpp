// SPDX-License-Identifier: BSD-3-Clause
// Dependence of the stated uncertainty on the window size: standard deviations of T_{i,i+n} (settled poses), rms,
// relative to those of a window of ten frames; with the errors, rms.
//   swf_vo-bench-windows FOLDER... [-o results/windows.json]
// FOLDER: a sequence in KITTI's layout with poses.txt; pooled over names that differ in up to three last digits.
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "support/chain.hpp"
#include "support/program.hpp"
#include "support/run.hpp"
#include "urban_nav_core/testing/bench_table.hpp"

namespace {

using namespace swf_vo::bench;
using urban_nav_core::Vector6d;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;

constexpr std::array<int, 3> kWindows = {1, 10, 25};
constexpr std::size_t kUsual = 1;  // index in `kWindows`
constexpr std::array<std::size_t, 3> kLags = {10, 50, 200};

// Sums of squares: translation (m^2) and rotation (rad^2).
struct Sums {
  std::array<double, 2> error = {}, stated = {};
  int count = 0;
};
using Pool = std::array<std::array<Sums, kLags.size()>, kWindows.size()>;

void add(const Sequence& sequence, const Run& run, std::array<Sums, kLags.size()>& at) {
  const urban_nav_core::OdometryChain chain = makeChain(sequence, run);
  for (std::size_t l = 0; l < kLags.size(); ++l)
    for (std::size_t i = 0; i + kLags[l] < run.settled.size(); i += 5) {
      const auto way = chain.between(sequence.stamps[i], sequence.stamps[i + kLags[l]]);
      if (!way) continue;
      const Vector6d e = boxMinus(sequence.truth[i].inverse() * sequence.truth[i + kLags[l]], way->pose);
      for (const Eigen::Index part : {0, 1}) {
        at[l].error[static_cast<std::size_t>(part)] += e.segment<3>(3 * part).squaredNorm();
        at[l].stated[static_cast<std::size_t>(part)] += way->covariance.block<3, 3>(3 * part, 3 * part).trace();
      }
      ++at[l].count;
    }
}

std::string describe(const Sums& sums, const Sums& of_usual, std::size_t part) {
  const double error = std::sqrt(sums.error[part] / std::max(1, sums.count));
  return cell(std::sqrt(sums.stated[part] / of_usual.stated[part]), 2) + " (" +
         (part == 0 ? cell(1e3 * error, 1) + " mm)" : cell(error * 180.0 / M_PI, 3) + " deg)");
}

}  // namespace

int main(int argc, char** argv) try {
  const FoldersAndOutput asked = foldersAndOutput(argc, argv);
  std::map<std::string, Pool> pools;
  for (const std::string& folder : asked.folders) {
    const Sequence sequence = kittiFolder(folder);
    Pool& pool = pools[poolName(sequence.name)];
    for (std::size_t w = 0; w < kWindows.size(); ++w)
      add(sequence, run(sequence, parametersFrom({"swf_vo.window=" + std::to_string(kWindows[w])})), pool[w]);
  }
  std::vector<std::string> columns = {"sequences", "of", "window"};
  for (const std::size_t lag : kLags) columns.push_back(std::to_string(lag) + " frames");
  BenchTable table(columns, argc, argv);
  for (const auto& [name, pool] : pools)
    for (const std::size_t part : {0U, 1U})
      for (std::size_t w = 0; w < kWindows.size(); ++w) {
        std::vector<std::string> row = {name, part == 0 ? "translation" : "rotation", std::to_string(kWindows[w])};
        for (std::size_t l = 0; l < kLags.size(); ++l) row.push_back(describe(pool[w][l], pool[kUsual][l], part));
        table.add(row);
      }
  table.note("Stated standard deviations, over those with a window of 10. In brackets the errors, rms.");
  return show(table, asked.output);
} catch (const std::exception& error) {
  return complain(error);
}
