// SPDX-License-Identifier: BSD-3-Clause
// Residual errors of calibration and rectification of a stereo pair as estimated by the filter: row offset of the right
// image and disparity offset; and ratio of measurement errors to the alignments' standard deviations. For comparison,
// rendered images without such errors, with a correct and with a wrong calibration.
//   swf_vo-bench-offsets [FOLDER...] [-o results/offsets.json]
// FOLDER: a sequence in KITTI's layout; default: the two real ones.
#include <algorithm>
#include <string>
#include <vector>

#include "support/program.hpp"
#include "support/run.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/testing/quantile.hpp"

namespace {

using namespace swf_vo::bench;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::quantile;

constexpr double kWrongPx = 0.2;  // disparity offset of the calibration; the true one is zero

double medianScale(const std::vector<swf_vo::Statistics>& found) {
  std::vector<double> scales;
  for (const swf_vo::Statistics& frame : found) scales.push_back(frame.noise_scale);
  return quantile(scales, 0.5);
}

void add(BenchTable& table, const std::string& name, const Run& run, const std::string& truth) {
  const std::vector<swf_vo::Statistics>& found = run.statistics;
  const swf_vo::Statistics &tenth = found[std::min<std::size_t>(9, found.size() - 1)], &last = found.back();
  table.add({name, cell(found.front().row_offset_px, 3), cell(tenth.row_offset_px, 3), cell(last.row_offset_px, 3),
             cell(last.disparity_offset_px, 3), cell(last.disparity_offset_sigma_px, 3), truth,
             cell(medianScale(found), 2)});
}

void addRendered(BenchTable& table, const RenderedOptions& options) {
  std::vector<Sequence> sequences = renderedAt({options.noise, options.noise}, options);
  sequences[1].camera.disparity_offset = kWrongPx;
  const std::vector<Run> runs = runTogether(sequences, swf_vo::Parameters());
  add(table, options.scene + ", rendered", runs[0], "0");
  add(table, options.scene + ", rendered; assumed " + cell(kWrongPx, 1) + " px", runs[1], "0");
}

}  // namespace

int main(int argc, char** argv) try {
  const FoldersAndOutput asked = foldersAndOutput(argc, argv);
  BenchTable table({"sequence", "right image lower by, px: frame 1", "frame 10", "at the end",
                    "disparities too large by, px, at the end", "its standard deviation, px", "truth, px",
                    "errors over what alignments say"},
                   argc, argv);
  for (const std::string& folder : asked.folders) {
    const Sequence sequence = kittiFolder(folder);
    add(table, sequence.name, run(sequence, swf_vo::Parameters()), "");
  }
  RenderedOptions room;
  addRendered(table, room);
  RenderedOptions street;
  street.scene = "street";
  street.rate = 10.0;
  street.camera = {718.9, 718.9, 620.0, 187.5, 1241, 376, 0.537, 0.5};
  addRendered(table, street);
  return show(table, asked.output);
} catch (const std::exception& error) {
  return complain(error);
}
