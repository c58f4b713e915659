// SPDX-License-Identifier: BSD-3-Clause
// Cost per frame over a day of operation. A loop through the rendered room is rendered once and played back and forth.
//   swf_vo-bench-steady [FOLDER] [--frames N] [-o results/steady.json]
#include <unistd.h>
#include <fstream>
#include <string>

#include "support/program.hpp"
#include "support/run.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/testing/processor_time.hpp"
#include "urban_nav_core/testing/quantile.hpp"

namespace {

using namespace swf_vo;
using namespace swf_vo::bench;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::quantile;
using urban_nav_core::testing::threadMs;

constexpr std::size_t kDrawnFrames = 200;
constexpr std::size_t kBlock = 900;  // frames per row
constexpr std::int64_t kPeriodNs = 50000000;

double residentMb() {
  std::ifstream file("/proc/self/statm");
  double pages = 0.0;
  file >> pages >> pages;
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

std::size_t forthAndBack(std::size_t i, std::size_t count) {
  const std::size_t at = i % (2 * count - 2);
  return at < count ? at : 2 * count - 2 - at;
}

urban_nav_core::ImageView view(const cv::Mat& image) {
  return {image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)};
}

}  // namespace

int main(int argc, char** argv) try {
  std::size_t frames = 20000;
  std::string output, folder;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--frames" && i + 1 < argc) frames = static_cast<std::size_t>(std::stoi(argv[++i]));
    else if (word == "-o" && i + 1 < argc) output = argv[++i];
    else folder = word;
  }
  RenderedOptions room;
  room.motion = "loop";
  room.frames = kDrawnFrames;
  const Sequence sequence = folder.empty() ? rendered(room) : kittiFolder(folder, kDrawnFrames);
  std::vector<cv::Mat> left(sequence.stamps.size()), right(sequence.stamps.size());
  for (std::size_t i = 0; i < left.size(); ++i) sequence.read(i, left[i], right[i]);

  BenchTable table(
      {"frames", "ms a frame, median", "99 %", "features", "landmarks in the prior", "memory of the program, MB"}, argc,
      argv);
  SwfVo filter(Parameters(), sequence.camera, urban_nav_core::Pose());
  std::vector<double> ms;
  ms.reserve(kBlock);
  double features = 0.0, landmarks = 0.0;
  std::size_t next = 100;
  for (std::size_t i = 0; i < frames; ++i) {
    const std::size_t at = forthAndBack(i, left.size());
    const double start = threadMs();
    const Frame& frame = filter.process({static_cast<std::int64_t>(i) * kPeriodNs, view(left[at]), view(right[at])});
    const double took = threadMs() - start;
    if (i < next) continue;
    ms.push_back(took);
    features += frame.statistics.features;
    landmarks += frame.statistics.landmarks_in_prior;
    if (ms.size() < kBlock && i + 1 < frames) continue;
    const double count = static_cast<double>(ms.size());
    table.add({std::to_string(next) + " to " + std::to_string(i + 1), cell(quantile(ms, 0.5), 2),
               cell(quantile(ms, 0.99), 2), cell(features / count, 0), cell(landmarks / count, 0),
               cell(residentMb(), 1)});
    ms.clear();
    features = landmarks = 0.0;
    next = next < 1000 ? 4100 : next + 5000;
    if (next + kBlock > frames && i + 1 < frames) next = frames - kBlock;
  }
  return show(table, output);
} catch (const std::exception& error) {
  return complain(error);
}
