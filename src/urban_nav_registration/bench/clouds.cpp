// SPDX-License-Identifier: BSD-3-Clause
// Real pairs of clouds: distance of the alignment from the stored pose, processor time from the points of both clouds
// to the verdict, and share of random starts (up to 5 m and any heading away) that converge to the right pose; compared
// with other programs on the same machine.
//   urban_nav_registration-bench-clouds [--peers FILE] [--runs N] [--starts N] [-o results/clouds.json]
// FILE: pair,peer,ms,metres,deg as CSV, metres and deg from the stored pose. Clouds: URBAN_NAV_DATA/clouds.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "urban_nav_core/io/cloud/cloud_file.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/testing/dice.hpp"
#include "urban_nav_core/testing/processor_time.hpp"
#include "urban_nav_core/testing/sequence_folder.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/icp/align.hpp"

namespace {

using namespace urban_nav_registration;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::PointCloud;
using urban_nav_core::Pose;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::Dice;
using urban_nav_core::testing::processMs;

constexpr double kDegrees = 57.29577951308232;
constexpr double kRightM = 0.3, kRightDeg = 2.0;  // limits of a correct result from a random start

struct Options {
  std::string peers, output;
  std::size_t runs = 30, starts = 20;
};

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string word = argv[i], value = argv[i + 1];
    if (word == "--peers") options.peers = value;
    else if (word == "--runs") options.runs = std::stoul(value);
    else if (word == "--starts") options.starts = std::stoul(value);
    else if (word == "-o") options.output = value;
    else throw urban_nav_core::UserError("urban_nav_registration-bench-clouds", word, "--peers, --runs, --starts, -o");
  }
  return options;
}

struct Pair {
  std::string name;
  PointCloud source, target;
  Pose T_target_source;
};

Pose toPose(const Eigen::Matrix4d& T) {
  return Pose(Eigen::Quaterniond(Eigen::Matrix3d(T.topLeftCorner<3, 3>())).normalized(), T.topRightCorner<3, 1>());
}

Pose readPose(const std::string& path) {
  std::ifstream file(path);
  Eigen::Matrix4d T;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) file >> T(row, column);
  if (!file) throw urban_nav_core::UserError(path, "not a pose", "4 x 4 numbers");
  return toPose(T);
}

std::vector<Pair> chooseKeyframePairs(const std::string& folder) {
  // From libpointmatcher's examples/data/carCloudList.csv.
  Eigen::Matrix4d car;
  car << 0.981715, 0.169605, -0.0864239, 0.0614127, -0.152902, 0.973034, 0.172703, 0.191433, 0.113385, -0.15633,
      0.981175, -0.0338571, 0, 0, 0, 1;
  const auto read = [&](const char* file) { return urban_nav_core::readCloud(folder + "/" + file).cloud; };
  return {{"outdoor_pair", read("outdoor_pair/source.ply"), read("outdoor_pair/target.ply"),
           readPose(folder + "/outdoor_pair/T_target_source.txt")},
          {"car_pair", read("car_pair/car_cloud401.csv.gz"), read("car_pair/car_cloud400.csv.gz"), toPose(car)}};
}

std::size_t startsRight(const Pair& pair, std::size_t starts) {
  Dice dice(1);
  std::size_t right = 0;
  for (std::size_t i = 0; i < starts; ++i) {
    const double heading = dice.uniform(-M_PI, M_PI), away = dice.uniform(0.0, 5.0),
                 towards = dice.uniform(-M_PI, M_PI);
    const Pose start =
        Pose(urban_nav_core::expSo3({0.0, 0.0, heading}), {away * std::cos(towards), away * std::sin(towards), 0.0}) *
        pair.T_target_source;
    const Alignment found = align(pair.source, pair.target, {}, start);
    right += found.verdict == ClosureVerdict::Accepted &&
             distanceBetween(found.T_target_source, pair.T_target_source) < kRightM &&
             kDegrees * angleBetween(found.T_target_source, pair.T_target_source) < kRightDeg;
  }
  return right;
}

void addPair(const Pair& pair, const Options& options, BenchTable& table) {
  std::vector<double> ms;
  Alignment found;
  for (std::size_t run = 0; run < std::max<std::size_t>(options.runs, 1); ++run) {
    const double before = processMs();
    found = align(pair.source, pair.target, {});
    ms.push_back(processMs() - before);
  }
  std::nth_element(ms.begin(), ms.begin() + static_cast<std::ptrdiff_t>(ms.size() / 2), ms.end());
  table.add({pair.name, "urban_nav", cell(distanceBetween(found.T_target_source, pair.T_target_source), 4),
             cell(kDegrees * angleBetween(found.T_target_source, pair.T_target_source), 3), toString(found.verdict),
             cell(ms[ms.size() / 2], 1),
             std::to_string(startsRight(pair, options.starts)) + " of " + std::to_string(options.starts)});
}

void addPeers(const std::string& pair, const std::string& file, BenchTable& table) {
  if (file.empty()) return;
  const auto peers = urban_nav_core::CsvTable::read(file);
  const auto text = [&](std::size_t row, const char* column) { return peers.text(row, peers.column(column)); };
  for (std::size_t row = 0; row < peers.rows(); ++row)
    if (text(row, "pair") == pair)
      table.add({pair, text(row, "peer"), cell(peers.number(row, peers.column("metres")), 4),
                 cell(peers.number(row, peers.column("deg")), 3), "", cell(peers.number(row, peers.column("ms")), 1),
                 ""});
}

}  // namespace

int main(int argc, char** argv) try {
  const Options options = parse(argc, argv);
  const std::string folder = urban_nav_core::testing::dataFolder("clouds");
  if (folder.empty()) throw urban_nav_core::UserError("URBAN_NAV_DATA", "no folder clouds", "the folder of the data");
  const urban_nav_core::ThreadLimit one(1);
  BenchTable table(
      {"pair", "program", "from the stored pose, m", "deg", "verdict", "ms", "random starts that end right"}, argc,
      argv);
  for (const Pair& pair : chooseKeyframePairs(folder)) {
    addPair(pair, options, table);
    addPeers(pair.name, options.peers, table);
  }
  table.note(
      "From the identity, cubes of 0.25 m, one core, reading excluded: preprocessing, alignment, and for urban_nav the "
      "search for other poses that fit as well, the validation and the covariance. Stored poses are accurate to about "
      "0.02 m and 0.2 deg, 0.04 m and 0.25 deg. Random starts: up to 5 m and any heading away.");
  if (!options.peers.empty())
    table.note(
        "Peers from the same machine, processor time, one after another: small_gicp aea1313 (headers, -O3; no tree of "
        "the source where point-to-plane reads none) and PCL 1.13 of Debian, both with normals of 10 neighbours, "
        "correspondences up to 1 m, and no verdict.");
  std::cout << table.text();
  if (!options.output.empty()) table.write(options.output);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
