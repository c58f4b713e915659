// SPDX-License-Identifier: BSD-3-Clause
// Density, error and stated standard deviation compared with OpenCV's matchers, on simulated sessions or, if none is
// given, on Middlebury pairs of URBAN_NAV_DATA. --own: without OpenCV's.
//
//   dense_stereo-bench-accuracy [-o FILE.json] [--own] [--step N] [NAME FOLDER TRUTH_FOLDER]...
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "support/arguments.hpp"
#include "support/peers.hpp"
#include "urban_nav_core/testing/bench_table.hpp"

namespace {

using dense_stereo::DisparityImage;
using dense_stereo::bench::TruePair;
using urban_nav_core::testing::cell;

/// Sums over the pixels of one scene.
struct ErrorSums {
  long pixels = 0, answered = 0, wrong = 0, sky = 0, sky_answered = 0, fair = 0;
  double normalised = 0.0, with_step = 0.0;  ///< sums of squared normalised errors, and with the step of the truth
  std::vector<float> errors;
  std::vector<std::pair<float, double>> by_variance;    ///< variance, squared normalised error
  std::vector<std::pair<float, bool>> all_by_variance;  ///< variance, whether the pixel is wrong
  std::vector<float> signed_errors;

  void add(const TruePair& pair, const DisparityImage& image) {
    for (int v = 0; v < image.height; ++v)
      for (int u = 0; u < image.width; ++u) {
        const float d = image.disparity[image.index(u, v)], truth = pair.truth.at<float>(v, u);
        if (!pair.sky.empty() && pair.sky.at<std::uint8_t>(v, u) != 0) {
          ++sky;
          sky_answered += d >= 2.0F ? 1 : 0;
        }
        if (truth < 0.0F) continue;
        ++pixels;
        if (d < 0.0F) continue;
        ++answered;
        const float error = std::abs(d - truth), variance = image.variance[image.index(u, v)];
        errors.push_back(error);
        signed_errors.push_back(d - truth);
        if (variance > 0.0F) all_by_variance.emplace_back(variance, error > 1.0F);
        wrong += error > 1.0F ? 1 : 0;
        if (error > 1.0F || variance <= 0.0F) continue;
        ++fair;
        normalised += static_cast<double>(error * error / variance);
        with_step += static_cast<double>(error * error / (variance + pair.step * pair.step / 12.0F));
        by_variance.emplace_back(variance, static_cast<double>(error * error / variance));
      }
  }
  static double median(std::vector<float>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return values.empty() ? 0.0 : static_cast<double>(*middle);
  }
  /// Returns the share of the wrong pixels that are in the half with the smaller standard deviations, %.
  double sureWrong() {
    std::sort(all_by_variance.begin(), all_by_variance.end());
    const auto half = all_by_variance.begin() + static_cast<std::ptrdiff_t>(all_by_variance.size() / 2);
    const auto count = [](auto begin, auto end) {
      return static_cast<double>(std::count_if(begin, end, [](const auto& each) { return each.second; }));
    };
    return 100.0 * count(all_by_variance.begin(), half) /
           std::max(count(all_by_variance.begin(), all_by_variance.end()), 1.0);
  }
  /// Returns "0.9 1.0 1.1 1.2": rms of the normalised errors in each quartile of the stated deviations.
  std::string quartiles() {
    std::sort(by_variance.begin(), by_variance.end());
    std::string text;
    for (std::size_t q = 0; q < 4 && !by_variance.empty(); ++q) {
      const std::size_t begin = q * by_variance.size() / 4, end = (q + 1) * by_variance.size() / 4;
      double sum = 0.0;
      for (std::size_t i = begin; i < end; ++i) sum += by_variance[i].second;
      text += (q > 0 ? " " : "") + cell(std::sqrt(sum / static_cast<double>(std::max<std::size_t>(end - begin, 1))), 2);
    }
    return text;
  }
};

void addRows(const std::string& name, const std::vector<TruePair>& pairs, bool own,
             urban_nav_core::testing::BenchTable& table) {
  for (const auto& peer : dense_stereo::bench::allPeers()) {
    if (own && peer->name() != "sgm" && peer->name() != "paper") continue;
    ErrorSums sums;
    for (const TruePair& pair : pairs) sums.add(pair, peer->match(pair.left, pair.right, pair.disparities));
    const auto percent = [](long part, long all) {
      return 100.0 * static_cast<double>(part) / static_cast<double>(std::max(all, 1L));
    };
    table.add({name, peer->name(), cell(percent(sums.answered, sums.pixels), 1),
               cell(percent(sums.wrong, sums.answered), 2), cell(ErrorSums::median(sums.signed_errors), 3),
               cell(ErrorSums::median(sums.errors), 3),
               sums.sky > 0 ? cell(percent(sums.sky_answered, sums.sky), 1) : "",
               sums.fair > 0 ? cell(std::sqrt(sums.normalised / static_cast<double>(sums.fair)), 2) : "",
               sums.fair > 0 ? cell(std::sqrt(sums.with_step / static_cast<double>(sums.fair)), 2) : "",
               sums.quartiles(), sums.fair > 0 ? cell(sums.sureWrong(), 0) : ""});
  }
}

}  // namespace

int main(int argc, char** argv) {
  urban_nav_core::testing::BenchTable table(
      {"scene", "method", "answered, %", "wrong by over 1 px, %", "median error, px", "median absolute, px",
       "sky answered, %", "error / sigma, rms", "with the step of the truth", "in quartiles of sigma",
       "wrong in the surer half, %"},
      argc, argv);
  const dense_stereo::bench::BenchArguments arguments = dense_stereo::bench::readBenchArguments(argc, argv, 20);
  const std::vector<std::string>& words = arguments.words;
  if (const char* data = std::getenv("URBAN_NAV_DATA"); data != nullptr && words.empty())
    for (const TruePair& pair : dense_stereo::bench::middleburyPairs(data))
      addRows(pair.name, {pair}, arguments.own, table);
  for (std::size_t i = 0; i + 2 < words.size(); i += 3)
    addRows(words[i], dense_stereo::bench::simulatedPairs(words[i], words[i + 1], words[i + 2], arguments.step),
            arguments.own, table);
  table.note(
      "Pixels visible in both cameras; teddy and cones 64 disparities, wood2 128; simulated worlds 64, nearer than 47 "
      "m.");
  table.note(
      "Sky: pixels without a surface that get a disparity of 2 px or more. Error / sigma: of errors below 1 px. With "
      "the step of the truth: the truth of teddy and cones is in steps of 1/4 px, that of wood2 of 1/2 px; step^2 / 12 "
      "is added to the variance. Wrong in the surer half: share of the pixels wrong by over 1 px that have the smaller "
      "half of the standard deviations.");
  table.note(
      "StereoBM 11x11; StereoSGBM block 3, P1 72, P2 288, uniqueness 10, speckles 100 px (OpenCV's defaults "
      "otherwise).");
  std::fputs(table.text().c_str(), stdout);
  if (!arguments.output.empty()) table.write(arguments.output);
  return 0;
}
