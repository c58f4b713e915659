// SPDX-License-Identifier: BSD-3-Clause
// Verdicts on planar scans of different places and of one place, drawn from recordings with known poses.
//   urban_nav_registration-bench-planar_scans LOG... [--pairs N] [--seed S] [-o results/planar_scans.json]
// LOG: CARMEN's text format; lines `FLASER n ranges... x y theta ...` with corrected poses, beams over 180 deg.
#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_registration/icp/align.hpp"

namespace {

using namespace urban_nav_registration;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::PointCloud;

constexpr double kHalfTurn = 3.14159265358979323846, kFarthest = 40.0, kNearest = 0.2;  // m

struct LoggedScan {
  PointCloud cloud;
  double x = 0.0, y = 0.0, heading = 0.0;
};

std::vector<LoggedScan> readLog(const std::string& path) {
  std::vector<LoggedScan> scans;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind;
    std::size_t count = 0;
    if (!(words >> kind >> count) || kind != "FLASER" || count < 180) continue;
    LoggedScan scan;
    const double step = kHalfTurn / static_cast<double>(count % 2 == 0 ? count : count - 1);
    for (std::size_t i = 0; i < count; ++i) {
      double range = 0.0;
      words >> range;
      if (range < kNearest || range > kFarthest) continue;
      const double angle = -0.5 * kHalfTurn + step * (static_cast<double>(i) + (count % 2 == 0 ? 0.5 : 0.0));
      scan.cloud.points.emplace_back(static_cast<float>(range * std::cos(angle)),
                                     static_cast<float>(range * std::sin(angle)), 0.0F);
    }
    if (words >> scan.x >> scan.y >> scan.heading) scans.push_back(std::move(scan));
  }
  return scans;
}

struct Pair {
  const LoggedScan *source = nullptr, *target = nullptr;
};

/// Counts of one kind of pairs.
struct Tally {
  int pairs = 0, rejected = 0, slides = 0, fixed = 0, within_10_cm = 0, wrong = 0;

  void add(const Alignment& alignment, const Pair& pair, bool same) {
    ++pairs;
    if (alignment.verdict == ClosureVerdict::Rejected) {
      ++rejected;
      return;
    }
    const bool is_fixed = alignment.verdict == ClosureVerdict::Accepted;
    (is_fixed ? fixed : slides) += 1;
    Eigen::Matrix3d covariance;
    const std::array<int, 3> in_plane = {0, 1, 5};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) covariance(i, j) = alignment.covariance(in_plane.at(i), in_plane.at(j));
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> position(covariance.topLeftCorner<2, 2>());
    if (is_fixed && std::sqrt(position.eigenvalues()[1]) < 0.1) ++within_10_cm;
    if (!same) return;
    const double c = std::cos(pair.target->heading), s = std::sin(pair.target->heading),
                 dx = pair.source->x - pair.target->x, dy = pair.source->y - pair.target->y;
    const auto R = alignment.T_target_source.R();
    const double turn = std::atan2(R(1, 0), R(0, 0)) - pair.source->heading + pair.target->heading;
    const Eigen::Vector3d off(alignment.T_target_source.t().x() - c * dx - s * dy,
                              alignment.T_target_source.t().y() + s * dx - c * dy, std::remainder(turn, 2 * kHalfTurn));
    covariance.diagonal() += Eigen::Vector3d(0.0025, 0.0025, 3e-4);  // covariance of the log's poses: 5 cm, 1 deg
    wrong += off.dot(covariance.inverse() * off) > 25.0 ? 1 : 0;
  }
};

struct PlanarOptions {
  std::vector<std::string> logs;
  std::string output;
  int pairs = 1000;
  unsigned seed = 1;
};

PlanarOptions parsePlanarOptions(int argc, char** argv) {
  PlanarOptions options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--pairs" && i + 1 < argc) options.pairs = std::atoi(argv[++i]);
    else if (word == "--seed" && i + 1 < argc) options.seed = static_cast<unsigned>(std::atoi(argv[++i]));
    else if (word == "-o" && i + 1 < argc) options.output = argv[++i];
    else options.logs.push_back(word);
  }
  return options;
}

/// Draws pairs of scans from logs.
class PairDraw {
 public:
  PairDraw(const std::vector<std::vector<LoggedScan>>& logs, unsigned seed) : logs_(logs), random_(seed) {}

  Pair ofDifferentLogs() {
    const std::size_t a = draw(logs_.size()), b = (a + 1 + draw(logs_.size() - 1)) % logs_.size();
    return {&logs_[a][draw(logs_[a].size())], &logs_[b][draw(logs_[b].size())]};
  }
  Pair farApart() {
    return until([](double distance, double) { return distance > 25.0; });
  }
  Pair ofOnePlace() {
    return until([](double distance, double turn) {
      return distance < 1.0 && turn < 0.25 * kHalfTurn && (distance > 0.1 || turn > 0.3);
    });
  }

 private:
  std::size_t draw(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }

  Pair until(const std::function<bool(double distance, double turn)>& fits) {
    for (;;) {
      const std::vector<LoggedScan>& log = logs_[draw(logs_.size())];
      const Pair pair{&log[draw(log.size())], &log[draw(log.size())]};
      const double distance = std::hypot(pair.source->x - pair.target->x, pair.source->y - pair.target->y);
      if (fits(distance, std::abs(std::remainder(pair.source->heading - pair.target->heading, 2.0 * kHalfTurn))))
        return pair;
    }
  }

  const std::vector<std::vector<LoggedScan>>& logs_;
  std::mt19937 random_;
};

}  // namespace

int main(int argc, char** argv) {
  const PlanarOptions options = parsePlanarOptions(argc, argv);
  std::vector<std::vector<LoggedScan>> logs;
  for (const std::string& path : options.logs) {
    logs.push_back(readLog(path));
    if (logs.back().size() < 2) logs.pop_back();
  }
  if (logs.size() < 2) return std::fputs("two or more logs with lines FLASER are needed\n", stderr);
  PairDraw draw(logs, options.seed);
  const std::vector<std::pair<std::string, std::function<Pair()>>> kinds = {
      {"different recordings", [&] { return draw.ofDifferentLogs(); }},
      {"one recording, more than 25 m apart", [&] { return draw.farApart(); }},
      {"one place: within 1 m and 45 deg", [&] { return draw.ofOnePlace(); }}};
  urban_nav_core::testing::BenchTable table({"places", "search", "pairs", "rejected", "slides in the plane",
                                             "held in the plane", "of these stated within 10 cm", "wrong"},
                                            argc, argv);
  for (const auto& [name, drawPair] : kinds) {
    std::vector<Pair> pairs;
    while (static_cast<int>(pairs.size()) < options.pairs) pairs.push_back(drawPair());
    const bool same = &name == &kinds.back().first;
    for (const SearchMode search : {SearchMode::AtOnce, SearchMode::IfRejected}) {
      Tally tally;
      for (const Pair& pair : pairs)
        tally.add(align(pair.source->cloud, pair.target->cloud, {}, {}, search), pair, same);
      table.add({name, search == SearchMode::AtOnce ? "at once" : "from the identity", std::to_string(tally.pairs),
                 std::to_string(tally.rejected), std::to_string(tally.slides), std::to_string(tally.fixed),
                 std::to_string(tally.within_10_cm), same ? std::to_string(tally.wrong) : ""});
    }
  }
  table.note("Wrong: off by more than 5 standard deviations, with 5 cm and 1 deg for the poses of the recordings.");
  std::fputs(table.text().c_str(), stdout);
  if (!options.output.empty()) table.write(options.output);
  return 0;
}
