// SPDX-License-Identifier: BSD-3-Clause
// Alignment of local clouds without a guess: number of accepted pairs by distance and relative heading, their errors,
// the consistency of their information (NEES: the expected value is the number of constrained directions), and verdicts
// of pairs of different places.
//   urban_nav_registration-bench-local_clouds FOLDER... [--true N] [--false N] [--list] [--unknown]
//     [--set registration.NAME=VALUE]... [-o results/local_clouds.json]
// FOLDER: clouds with places.csv, such as urban_nav_sim-bench-local_clouds makes. --unknown: without the deformation
// known from odometry, as for clouds from files in `urban_nav icp`.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/io/cloud/cloud_file.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/parameters/sources.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/testing/dice.hpp"
#include "urban_nav_core/testing/processor_time.hpp"
#include "urban_nav_core/testing/quantile.hpp"
#include "urban_nav_registration/icp/align.hpp"

namespace {

using namespace urban_nav_registration;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::PointCloud;
using urban_nav_core::Pose;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::processMs;
using urban_nav_core::testing::quantile;

struct Options {
  std::vector<std::string> folders, sets;
  std::string output;
  std::size_t true_pairs = 100, false_pairs = 500;
  bool list = false, unknown = false;
};

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--true" && i + 1 < argc) options.true_pairs = static_cast<std::size_t>(std::stoi(argv[++i]));
    else if (word == "--false" && i + 1 < argc) options.false_pairs = static_cast<std::size_t>(std::stoi(argv[++i]));
    else if (word == "--set" && i + 1 < argc) options.sets.push_back(argv[++i]);
    else if (word == "-o" && i + 1 < argc) options.output = argv[++i];
    else if (word == "--list") options.list = true;
    else if (word == "--unknown") options.unknown = true;
    else options.folders.push_back(word);
  }
  return options;
}

constexpr double kPlaceRadiusM = 9.0;  // loop_metric.place_radius
constexpr double kDegrees = 57.29577951308232;
constexpr double kElsewhereM = 10.0;              // minimum distance of different places
constexpr double kWrongM = 0.5, kWrongDeg = 3.0;  // beyond, a transform is wrong rather than inaccurate
constexpr double kLeastPathM = 25.0;              // between places of one day, so that their clouds share no beam

struct Place {
  int day = 0;
  double way = 0.0;
  Pose T_world_base;
  PointCloud cloud;
  double deformation_sigma = 0.0;  // m
};

std::vector<Place> readPlaces(const std::string& folder) {
  const auto csv = urban_nav_core::CsvTable::read(folder + "/places.csv");
  std::vector<Place> places;
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const auto number = [&](const char* column) { return csv.number(row, csv.column(column)); };
    places.push_back({static_cast<int>(number("day")), number("way"),
                      Pose(Eigen::Quaterniond(number("qw"), number("qx"), number("qy"), number("qz")),
                           {number("x"), number("y"), number("z")}),
                      urban_nav_core::readCloud(folder + "/" + csv.text(row, csv.column("cloud"))).cloud,
                      number("bend")});
  }
  return places;
}

struct Class {
  const char* name;
  double least_deg, most_deg;
};
constexpr std::array<Class, 3> kClasses = {
    {{"same direction", 0.0, 45.0}, {"across", 45.0, 135.0}, {"opposite direction", 135.0, 181.0}}};

struct Tally {
  std::size_t pairs = 0, degenerate = 0, wrong = 0;
  std::vector<double> metres, deg, nees, ms;
};

class Program {
 public:
  explicit Program(const Options& options) : options_(options) {
    std::vector<urban_nav_core::Assignment> assignments;
    for (const std::string& set : options.sets) assignments.push_back(urban_nav_core::parseSetting(set));
    urban_nav_core::refuseUnknownStages(assignments, {table().stage()});
    parameters_ = urban_nav_core::load(table(), assignments).parameters;
  }

  void run(const std::string& folder, BenchTable& table) {
    const std::string name = folder.substr(folder.find_last_of('/') + 1);
    const std::vector<Place> places = readPlaces(folder);
    std::array<std::vector<std::pair<std::size_t, std::size_t>>, kClasses.size() + 1> pairs;
    for (std::size_t i = 0; i < places.size(); ++i)
      for (std::size_t j = i + 1; j < places.size(); ++j) {
        const Place &a = places[i], &b = places[j];
        if (a.day == b.day && std::abs(a.way - b.way) < kLeastPathM) continue;
        const double apart = urban_nav_core::distanceBetween(a.T_world_base, b.T_world_base);
        const double turned = kDegrees * urban_nav_core::angleBetween(a.T_world_base, b.T_world_base);
        if (apart > kElsewhereM) pairs.back().emplace_back(i, j);
        if (apart > kPlaceRadiusM) continue;
        for (std::size_t k = 0; k < kClasses.size(); ++k)
          if (turned >= kClasses[k].least_deg && turned < kClasses[k].most_deg) pairs[k].emplace_back(i, j);
      }
    urban_nav_core::testing::Dice dice(1);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const std::size_t most = k < kClasses.size() ? options_.true_pairs : options_.false_pairs;
      auto& chosen = pairs[k];
      for (std::size_t i = 0; i + 1 < chosen.size(); ++i)
        std::swap(chosen[i], chosen[i + dice.below(chosen.size() - i)]);
      chosen.resize(std::min(chosen.size(), most));
      Tally tally;
      for (const auto& [i, j] : chosen)
        see(name, places, i, j, k < kClasses.size() ? kClasses[k].name : "another place", tally);
      addRow(table, name, k, tally);
    }
  }

 private:
  void see(const std::string& name, const std::vector<Place>& places, std::size_t i, std::size_t j, const char* kind,
           Tally& tally) const {
    const Pose truth = places[i].T_world_base.inverse() * places[j].T_world_base;
    const double before = processMs();
    AlignmentPrior known;
    if (!options_.unknown)
      known.deformation_sigma = std::hypot(places[i].deformation_sigma, places[j].deformation_sigma);
    const Alignment alignment = align(places[j].cloud, places[i].cloud, parameters_, {}, SearchMode::AtOnce, known);
    tally.ms.push_back(processMs() - before);
    ++tally.pairs;
    const double metres = urban_nav_core::distanceBetween(alignment.T_target_source, truth),
                 deg = kDegrees * urban_nav_core::angleBetween(alignment.T_target_source, truth);
    const urban_nav_core::Vector6d d = urban_nav_core::boxMinus(truth, alignment.T_target_source);
    const double nees = d.dot(alignment.information * d);
    if (options_.list) list(name, i, j, kind, alignment, truth, d);
    if (alignment.verdict == ClosureVerdict::Rejected) return;
    if (alignment.verdict == ClosureVerdict::Degenerate) {
      ++tally.degenerate;
      return;
    }
    if (alignment.T_target_source.t().norm() > kPlaceRadiusM) return;  // test of the caller
    tally.metres.push_back(metres);
    tally.deg.push_back(deg);
    tally.nees.push_back(nees);
    if (metres > kWrongM || deg > kWrongDeg) ++tally.wrong;
  }

  static void list(const std::string& name, std::size_t i, std::size_t j, const char* kind, const Alignment& alignment,
                   const Pose& truth, const urban_nav_core::Vector6d& d) {
    std::printf("%s,%zu,%zu,%s,%s,%s,%.3f,%.4f,%.4f,%.3f,%zu", name.c_str(), i, j, kind, toString(alignment.verdict),
                toString(alignment.reason), truth.t().norm(), d.head<3>().norm(), kDegrees * d.tail<3>().norm(),
                d.dot(alignment.information * d), alignment.free_directions.size());
    for (const AlignmentTest& test : alignment.tests) std::printf(",%s=%.4f", test.name.c_str(), test.value);
    for (int k = 0; k < 6; ++k)
      std::printf(",z%d=%.3f,d%d=%.5f", k, d[k] / std::sqrt(std::max(alignment.covariance(k, k), 1e-18)), k, d[k]);
    std::printf("\n");
    std::fflush(stdout);
  }

  static void addRow(BenchTable& table, const std::string& name, std::size_t k, const Tally& tally) {
    if (tally.pairs == 0) return;
    const bool one_place = k < kClasses.size();
    const auto spread = [&](const std::vector<double>& values, double unit, int decimals) {
      return values.empty() || !one_place ? "-"
                                          : cell(unit * quantile(values, 0.5), decimals) + " (" +
                                                cell(unit * quantile(values, 0.95), decimals) + ")";
    };
    double nees = 0.0;
    for (const double one : tally.nees) nees += one / static_cast<double>(tally.nees.size());
    const double share = 100.0 * static_cast<double>(tally.metres.size()) / static_cast<double>(tally.pairs);
    table.add(
        {name, one_place ? kClasses[k].name : "another place", std::to_string(tally.pairs),
         one_place ? cell(share, 0) + " % (" + std::to_string(tally.wrong) + ")" : std::to_string(tally.metres.size()),
         std::to_string(tally.degenerate), spread(tally.metres, 100.0, 1), spread(tally.deg, 1.0, 2),
         one_place && !tally.nees.empty() ? cell(nees, 1) + " (" + cell(quantile(tally.nees, 0.5), 1) + ")" : "-",
         cell(quantile(tally.ms, 0.5), 0)});
  }

  Options options_;
  Parameters parameters_;
};

}  // namespace

int main(int argc, char** argv) try {
  const Options options = parse(argc, argv);
  const urban_nav_core::ThreadLimit one(1);
  BenchTable table({"world", "pairs", "count", "aligned (wrong)", "with free directions", "error, cm: median (95 %)",
                    "deg: median (95 %)", "NEES: mean (median)", "ms"},
                   argc, argv);
  table.note(
      "Pairs up to 7.5 m apart of one day or two, without a guess; another place: more than 10 m apart, all that are "
      "accepted. Wrong: off by more than half a metre or 3 deg. NEES: 6 is expected, with a median of 5.3. Time: one "
      "core, from the points of both clouds to the verdict, with the search over all headings.");
  Program program(options);
  for (const std::string& folder : options.folders) program.run(folder, table);
  std::cout << table.text();
  if (!options.output.empty()) table.write(options.output);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
