// SPDX-License-Identifier: BSD-3-Clause
// Figure 4 of the paper: mean squared error over time of the filter, of classic odometry (parameters deleted instead of
// marginalised), of window 1 and of the batch; standing and moving. Writes a table and a plot.
//   swf_vo-bench-figure4 [--runs N] [--frames N] [-o OUT.json]     (the plot goes beside it, as .svg)
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "../test/window/track_runner.hpp"
#include "urban_nav_core/testing/bench_table.hpp"

namespace {

using namespace swf_vo;
using urban_nav_core::Pose;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::TrackMotion;
using urban_nav_core::testing::TrackOptions;
using urban_nav_core::testing::Tracks;

struct Method {
  const char* name;
  int size;  // 0: all frames
  bool deletion;
  const char* colour;
};
const Method kMethods[] = {{"batch", 0, false, "#bbbbbb"},
                           {"filter, k = 10", 10, false, "#1f77b4"},
                           {"filter, k = 1", 1, false, "#2ca02c"},
                           {"deletion, k = 10", 10, true, "#ff7f0e"},
                           {"deletion, k = 1", 1, true, "#d62728"}};
const std::size_t kSteps[] = {1, 2, 5, 10, 20, 30, 50, 75, 100, 125, 150, 175, 199};

struct Errors {
  double pose = 0.0, map = 0.0;  // sums of squares, m^2
  int points = 0, runs = 0;
};
using Curve = std::map<std::size_t, Errors>;

TrackOptions scene(bool standing, std::uint64_t seed, int frames) {
  TrackOptions options;
  options.seed = seed;
  options.frames = frames;
  options.motion = standing ? TrackMotion::Standing : TrackMotion::Turning;
  options.features = 30;
  options.sigma_px = 0.5;
  options.farthest = 10.0;
  options.track_length = standing ? 1e9 : 13.0;
  return options;
}

// Wheel measurement with the stated noise: a centimetre and half a degree per step.
ProcessInput wheels(const Tracks& tracks, std::size_t i, std::uint64_t& dice) {
  constexpr double kTranslation = 0.01, kRotation = 0.01;
  ProcessInput u;
  urban_nav_core::Vector6d noise;
  for (int c = 0; c < 6; ++c) {
    double sum = -6.0;  // the sum of twelve uniform numbers is approximately normal
    for (int n = 0; n < 12; ++n)
      sum += static_cast<double>((dice = dice * 6364136223846793005ULL + 1442695040888963407ULL) >> 11) /
             9007199254740992.0;
    noise[c] = sum * (c < 3 ? kTranslation : kRotation);
  }
  const Pose moved = tracks.frames[i - 1].T_world_camera.inverse() * tracks.frames[i].T_world_camera;
  u.T_from_to = urban_nav_core::boxPlus(moved, noise);
  u.information = diagonalInformation(kTranslation, kRotation);
  return u;
}

void measure(const Window& window, const Tracks& tracks, std::size_t i, Errors& errors) {
  const Pose& truth = tracks.frames[i].T_world_camera;
  errors.pose += (window.newest().pose.t() - truth.t()).squaredNorm();
  ++errors.runs;
  std::map<LandmarkId, Eigen::Vector3d> seen;
  for (const MapPoint& point : window.map())
    if (point.p_odom.w() > 0.0) seen[point.landmark] = point.p_odom.head<3>() / point.p_odom.w();
  for (const auto& sighting : tracks.frames[i].sightings) {
    const auto at = seen.find(sighting.landmark);
    const Eigen::Vector3d& p = tracks.points[static_cast<std::size_t>(sighting.landmark)];
    if (at == seen.end() || (truth.inverse() * p).z() > 6.0) continue;
    errors.map += (at->second - p).squaredNorm();
    ++errors.points;
  }
}

void run(const Method& method, const Tracks& tracks, std::uint64_t seed, Curve& curve) {
  WindowOptions options;
  options.size = method.size > 0 ? method.size : static_cast<int>(tracks.frames.size()) + 1;
  options.forget_by_deletion = method.deletion;
  options.huber = 0.0;
  options.exact_undo = false;
  options.iterations = method.size > 0 ? 6 : 20;
  Window window(options, tracks.camera);
  std::uint64_t dice = seed * 7919;
  for (std::size_t i = 0; i < tracks.frames.size(); ++i) {
    if (i == 0) window.start(0, tracks.frames[0].T_world_camera, diagonalInformation(1e-6, 1e-6));
    else window.addPose(static_cast<FrameId>(i), wheels(tracks, i, dice));
    window.removePoses();
    for (const auto& sighting : tracks.frames[i].sightings)
      window.observe({sighting.landmark, static_cast<FrameId>(i), sighting.z, pixelInformation(tracks.sigma_px)});
    bool wanted = false;
    for (const std::size_t step : kSteps) wanted = wanted || step == i;
    // The batch has no state to pass on, so it is solved only where it is evaluated, and occasionally for a good start.
    if (method.size > 0 || wanted || i % 10 == 0) window.update();
    if (wanted) measure(window, tracks, i, curve[i]);
    for (const auto ended : tracks.frames[i].ended) window.endLandmark(ended);
  }
}

double value(const Errors& errors, bool map) { return map ? errors.map / errors.points : errors.pose / errors.runs; }

// Draws one panel, both axes logarithmic.
void panel(std::ofstream& out, const std::vector<Curve>& curves, bool map, const std::string& title, double left,
           double top) {
  constexpr double kWidth = 330.0, kHeight = 240.0;
  double low = 1e300, high = 0.0;
  for (const Curve& curve : curves)
    for (const auto& [step, errors] : curve) {
      low = std::min(low, value(errors, map));
      high = std::max(high, value(errors, map));
    }
  const double bottom = std::floor(std::log10(low)), ceiling = std::ceil(std::log10(high));
  const double most = std::log10(200.0);
  const auto x = [&](double step) { return left + kWidth * std::log10(step) / most; };
  const auto y = [&](double v) { return top + kHeight * (ceiling - std::log10(v)) / (ceiling - bottom); };
  out << "<rect x='" << left << "' y='" << top << "' width='" << kWidth << "' height='" << kHeight
      << "' fill='none' stroke='#888'/>\n";
  out << "<text x='" << left + kWidth / 2 << "' y='" << top - 8 << "' text-anchor='middle'>" << title << "</text>\n";
  for (int decade = static_cast<int>(bottom); decade <= static_cast<int>(ceiling); ++decade)
    out << "<text x='" << left - 6 << "' y='" << y(std::pow(10.0, decade)) + 4 << "' text-anchor='end'>1e" << decade
        << "</text>\n";
  for (const int step : {1, 10, 100})
    out << "<text x='" << x(step) << "' y='" << top + kHeight + 16 << "' text-anchor='middle'>" << step << "</text>\n";
  for (std::size_t m = 0; m < curves.size(); ++m) {
    // The batch is drawn as a wide line below the others.
    out << "<polyline fill='none' stroke-width='" << (m == 0 ? 8 : 2) << "' stroke='" << kMethods[m].colour
        << "' points='";
    for (const auto& [step, errors] : curves[m])
      out << x(static_cast<double>(step)) << ',' << y(value(errors, map)) << ' ';
    out << "'/>\n";
  }
}

}  // namespace

int main(int argc, char** argv) {
  int runs = 50, frames = 200;
  std::string path;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::string(argv[i]) == "--runs") runs = std::stoi(argv[i + 1]);
    else if (std::string(argv[i]) == "--frames") frames = std::stoi(argv[i + 1]);
    else if (std::string(argv[i]) == "-o") path = argv[i + 1];
  }
  urban_nav_core::testing::BenchTable table(
      {"motion", "method", "step 10: map, mm²", "step 50", "step 199", "step 10: position, mm²", "step 50", "step 199",
       "over batch (position, 199)"},
      argc, argv);
  std::ofstream plot;  // ignores output unless it is open
  if (!path.empty()) plot.open(path.substr(0, path.rfind('.')) + ".svg");
  plot << "<svg xmlns='http://www.w3.org/2000/svg' width='860' height='700' font-family='sans-serif' font-size='12'>\n"
          "<rect width='860' height='700' fill='white'/>\n";
  for (const bool standing : {true, false}) {
    std::vector<Curve> curves(std::size(kMethods));
    for (int r = 0; r < runs; ++r) {
      const std::uint64_t seed = static_cast<std::uint64_t>(1000 + r);
      const Tracks tracks = simulateTracks(scene(standing, seed, frames));
      for (std::size_t m = 0; m < curves.size(); ++m) run(kMethods[m], tracks, seed, curves[m]);
    }
    for (std::size_t m = 0; m < curves.size(); ++m) {
      std::vector<std::string> row = {standing ? "standing" : "moving", kMethods[m].name};
      for (const bool map : {true, false})
        for (const std::size_t step : {10U, 50U, 199U})
          row.push_back(curves[m].count(step) > 0 ? cell(1e6 * value(curves[m][step], map), 3) : "");
      row.push_back(curves[m].count(199) > 0 ? cell(value(curves[m][199], false) / value(curves[0][199], false), 3)
                                             : "");
      table.add(row);
    }
    const double top = standing ? 40.0 : 360.0;
    panel(plot, curves, true, std::string(standing ? "standing" : "moving") + ": map, m² over steps", 60.0, top);
    panel(plot, curves, false, std::string(standing ? "standing" : "moving") + ": position, m² over steps", 480.0, top);
  }
  double at = 60.0;
  for (const Method& method : kMethods) {
    plot << "<line x1='" << at << "' y1='670' x2='" << at + 24 << "' y2='670' stroke-width='3' stroke='"
         << method.colour << "'/><text x='" << at + 30 << "' y='674'>" << method.name << "</text>\n";
    at += 150.0;
  }
  plot << "</svg>\n";
  table.note(
      "Mean over " + std::to_string(runs) + " runs of " + std::to_string(frames) +
      " steps; map: landmarks within 6 m that the newest frame observes. Deletion keeps one more pose, as the datum.");
  std::fputs(table.text().c_str(), stdout);
  if (!path.empty()) table.write(path);
}
