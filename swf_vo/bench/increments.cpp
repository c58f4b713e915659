// SPDX-License-Identifier: BSD-3-Clause
// Consistency of the covariance between two frames: squared errors of T_{i,i+n} (settled poses) over the stated
// variances (urban_nav_core/trajectory/odometry_chain.hpp), translation and rotation separately, with and without the
// drift ratio from residuals, pooled over sequences whose names differ in up to three last digits.
//   swf_vo-bench-increments [FOLDER...] [--peer NAME=SEQUENCE=FILE]... [--set swf_vo.NAME=VALUE]...
//     [-o results/increments.json]
// FOLDER: a sequence in KITTI's layout with poses.txt; default: the two real ones. FILE: result of another system for
// the folder named SEQUENCE (as for accuracy); its poses are the reference there.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "support/chain.hpp"
#include "support/peer.hpp"
#include "support/program.hpp"
#include "support/run.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/trajectory/odometry_chain.hpp"

namespace {

using namespace swf_vo::bench;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::Vector3d;
using urban_nav_core::Vector6d;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;

constexpr std::array<std::size_t, 5> kLags = {10, 50, 100, 200, 400};

// Sums for translation (m^2) and rotation (rad^2).
struct Sums {
  std::array<double, 2> squared = {}, stated = {};
  int count = 0;
};

struct Pool {
  int sequences = 0;
  std::array<Sums, kLags.size()> at;
};

/// Derivative of T_{i,j} by the disparity offset, 1/px, from two runs with constant offsets.
class PerOffset {
 public:
  PerOffset(Sequence sequence, swf_vo::Parameters parameters) {
    parameters.disparity_offset = 0.0;
    at_zero_ = run(sequence, parameters).settled;
    sequence.camera.disparity_offset += kDifferencePx;
    beside_ = run(sequence, parameters).settled;
  }
  Vector6d operator()(std::size_t i, std::size_t j) const {
    return boxMinus(beside_[i].inverse() * beside_[j], at_zero_[i].inverse() * at_zero_[j]) / kDifferencePx;
  }

 private:
  static constexpr double kDifferencePx = 0.1;
  std::vector<Pose> at_zero_, beside_;
};

/// `rig_scale`: relative standard deviation of all lengths; only with `per_offset`.
void add(Pool& pool, const Sequence& sequence, const Run& run, const PerOffset* per_offset, double rig_scale = 0.0) {
  const urban_nav_core::OdometryChain chain = makeChain(sequence, run);
  ++pool.sequences;
  for (std::size_t l = 0; l < kLags.size(); ++l)
    for (std::size_t i = 0; i + kLags[l] < run.settled.size(); i += 5) {
      const auto way = chain.between(sequence.stamps[i], sequence.stamps[i + kLags[l]]);
      if (!way) continue;
      Matrix6d covariance = way->covariance;
      if (per_offset != nullptr) {
        const Vector6d off = run.statistics[i + kLags[l]].disparity_offset_sigma_px * (*per_offset)(i, i + kLags[l]);
        covariance += off * off.transpose();
        const Vector3d path = rig_scale * way->pose.t();
        covariance.topLeftCorner<3, 3>() += path * path.transpose();
      }
      const Vector6d e = boxMinus(sequence.truth[i].inverse() * sequence.truth[i + kLags[l]], way->pose);
      Sums& sums = pool.at[l];
      for (std::size_t part = 0; part < 2; ++part) {
        const Eigen::Index at = 3 * static_cast<Eigen::Index>(part);
        sums.squared[part] += e.segment<3>(at).squaredNorm();
        sums.stated[part] += covariance.block<3, 3>(at, at).trace();
      }
      ++sums.count;
    }
}

std::vector<std::string> row(const std::string& name, const Pool& pool, const std::string& covariance,
                             std::size_t part) {
  const bool moved = part == 0;
  std::vector<std::string> cells = {name, std::to_string(pool.sequences), moved ? "translation" : "rotation",
                                    covariance};
  for (const Sums& sums : pool.at) {
    const double rms = std::sqrt(sums.squared[part] / std::max(1, sums.count));
    cells.push_back(sums.count == 0
                        ? "-"
                        : cell(sums.squared[part] / sums.stated[part], 2) + " (" +
                              (moved ? cell(1e3 * rms, 1) + " mm)" : cell(rms * 180.0 / M_PI, 3) + " deg)"));
  }
  return cells;
}

}  // namespace

int main(int argc, char** argv) try {
  std::vector<std::string> sets, peers, folders;
  std::string output;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--set" && i + 1 < argc) sets.emplace_back(argv[++i]);
    else if (word == "--peer" && i + 1 < argc) peers.emplace_back(argv[++i]);
    else if (word == "-o" && i + 1 < argc) output = argv[++i];
    else folders.push_back(word);
  }
  swf_vo::Parameters parameters = parametersFrom(sets);
  const std::array<const char*, 3> covariances = {"model", "robust", "robust, with offset and scale"};
  std::map<std::string, std::array<Pool, covariances.size()>> pools;
  for (const std::string& folder : orRealSequences(folders)) {
    Sequence sequence = kittiFolder(folder);
    std::string name = poolName(sequence.name);
    for (Peer& peer : readPeers(sequence, peers)) {
      sequence.truth = std::move(peer.poses);
      name += ", " + peer.name + " for truth";
    }
    auto& pool = pools[name];
    parameters.robust_covariance = false;
    add(pool[0], sequence, run(sequence, parameters), nullptr);
    parameters.robust_covariance = true;
    const Run robust = run(sequence, parameters);
    const PerOffset per_offset(sequence, parameters);
    add(pool[1], sequence, robust, nullptr);
    add(pool[2], sequence, robust, &per_offset, 0.01 * parameters.rig_scale);
  }
  std::vector<std::string> columns = {"sequences", "number", "of", "covariance"};
  for (const std::size_t lag : kLags) columns.push_back(std::to_string(lag) + " frames");
  BenchTable table(columns, argc, argv);
  for (const auto& [name, pool] : pools)
    for (const std::size_t part : {0U, 1U})
      for (std::size_t c = 0; c < covariances.size(); ++c) table.add(row(name, pool[c], covariances[c], part));
  table.note(
      "Squared errors over the stated variances; 1 is expected. In brackets the errors, rms. Model: "
      "robust_covariance=false. The errors of the disparity offset and of the scale of the rig are the same in all "
      "steps and not contained in their drifts; with both: included, as in the covariance of a pose.");
  return show(table, output);
} catch (const std::exception& error) {
  return complain(error);
}
