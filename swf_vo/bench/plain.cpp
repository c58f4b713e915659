// SPDX-License-Identifier: BSD-3-Clause
// Plain visual odometry for comparison: frame to frame, without a prior, with corners at whole pixels. Writes poses.txt
// (left camera, KITTI's format), covariance.csv, and summary.json with the number of frames by status and the median ms
// per frame, for `urban_nav evaluate` and src/urban_nav/bench/worlds.py.
//   swf_vo-bench-plain FOLDER OUT
// FOLDER: a sequence in KITTI's layout. OUT: folder of the results, created if needed.
#include <filesystem>
#include <map>
#include <string>

#include "support/program.hpp"
#include "support/run.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/covariance_csv.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/testing/quantile.hpp"
#include "urban_nav_core/types/error.hpp"

namespace {

using namespace swf_vo::bench;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;

Run runPlainly(const Sequence& sequence) {
  swf_vo::Parameters parameters;
  parameters.window = 1;
  swf_vo::Ablation ablation;
  ablation.delete_departed = true;
  ablation.whole_pixels = true;
  return run(sequence, parameters, ablation);
}

/// Covariances in the axes of base_link (x forward, z up), as in covariance files.
std::string printCovariances(const Sequence& sequence, const Run& run) {
  const Pose T_base_camera(Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5), Eigen::Vector3d::Zero());
  const Matrix6d turn = urban_nav_core::adjoint(T_base_camera);
  std::string text = urban_nav_core::covarianceHeader();
  for (std::size_t i = 0; i < run.settled.size(); ++i) {
    urban_nav_core::CovarianceRow row;
    row.stamp = sequence.stamps[i];
    row.status = run.status[i].health;
    row.covariance = turn * run.settled_covariance[i] * turn.transpose();
    text += urban_nav_core::printCovarianceRow(row);
  }
  return text;
}

std::string printSummary(const Run& run) {
  std::map<std::string, int> counts;
  for (const urban_nav_core::Status& status : run.status) ++counts[toString(status.health)];
  std::string text;
  for (const auto& [health, count] : counts)
    text += (text.empty() ? "\"" : ", \"") + health + "\": " + std::to_string(count);
  return "{\"status_counts\": {" + text +
         "}, \"ms_median\": " + std::to_string(urban_nav_core::testing::quantile(run.ms, 0.5)) + "}\n";
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) throw urban_nav_core::UserError("swf_vo-bench-plain", "arguments are missing", "FOLDER OUT");
  const Sequence sequence = kittiFolder(argv[1]);
  const Run run = runPlainly(sequence);
  const std::filesystem::path out = argv[2];
  std::filesystem::create_directories(out);
  urban_nav_core::writeKitti((out / "poses.txt").string(), run.settled);
  urban_nav_core::writeAtomically((out / "covariance.csv").string(), printCovariances(sequence, run));
  urban_nav_core::writeAtomically((out / "summary.json").string(), printSummary(run));
  return 0;
} catch (const std::exception& error) {
  return complain(error);
}
