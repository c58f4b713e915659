// SPDX-License-Identifier: BSD-3-Clause
// Effect of plane constraints on drift: laser scans of a simulated bag (`simulate --sensors lasers`, no images needed)
// with odometry from the truth plus a random walk, relaxed with and without the constraints.
//
//   urban_nav-bench-plane_drift [-o FILE.json] [--trials 3] [--icp] BAG...
//
// The truth is read from BAG_STEM.truth/trajectory.tum. Closures are the truth with noise; with --icp, measured by ICP
// of the scans.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "base/console.hpp"
#include "laser_mapper/quality/map_quality.hpp"
#include "map/closure_rows.hpp"
#include "support/laser_sessions.hpp"
#include "topics/graph/plane_closures.hpp"
#include "topics/loops/loops_run.hpp"
#include "topics/loops/stored_sessions.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/trajectory/errors.hpp"
#include "urban_nav_registration/parameters.hpp"

namespace urban_nav::bench {

using urban_nav_core::ClosureRow;
using urban_nav_core::MetricClosure;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector6d;
using urban_nav_core::testing::cell;
using urban_nav_store::Store;

constexpr const char* kBenchSession = "0123456789abcdef0123";
constexpr StampNs kFrame = 50'000'000;  // between two poses of odometry
// Random walk per root of a second: after 100 s about 5 cm and 0.2 deg, which over 100 m add about 20 cm.
constexpr double kWalkM = 0.005, kWalkRad = 0.0003;
constexpr double kRevisitM = 3.0, kRevisitS = 30.0;      // compared poses
constexpr double kClosureM = 0.02, kClosureRad = 0.005;  // standard deviations of closures
constexpr StampNs kClosurePeriod = 4'000'000'000;

Trajectory atFrames(const Trajectory& truth) {
  Trajectory frames;
  for (StampNs stamp = truth.front().stamp; stamp <= truth.back().stamp; stamp += kFrame)
    frames.append(stamp, *truth.at(stamp, kFrame));
  return frames;
}

/// Odometry with a consistent covariance.
SessionOdometry makeOdometry(const Trajectory& truth, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  const double root = std::sqrt(1e-9 * static_cast<double>(kFrame));
  SessionOdometry run;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    SmoothedFrame settled;
    settled.stamp = truth[i].stamp;
    urban_nav_core::RelativePose& step = settled.from_previous;
    step.from = truth[i == 0 ? 0 : i - 1].stamp;
    step.to = truth[i].stamp;
    Vector6d sigma;
    sigma << Vector6d::Constant(root * kWalkM).head<3>(), Vector6d::Constant(root * kWalkRad).tail<3>();
    step.covariance = sigma.cwiseAbs2().asDiagonal();
    step.drift_covariance = step.covariance;
    if (i > 0) {
      const Vector6d noise = Vector6d::NullaryExpr([&](Eigen::Index) { return normal(random); });
      step.T_from_to = urban_nav_core::boxPlus(truth[i - 1].pose.inverse() * truth[i].pose, sigma.cwiseProduct(noise));
      settled.T_odom_base.pose = run.settled.back().T_odom_base.pose * step.T_from_to;
    }
    run.settled.push_back(settled);
  }
  return run;
}

/// Returns pairs of poses at one place, a few seconds apart from each other, by index.
std::vector<std::pair<std::size_t, std::size_t>> findRevisits(const Trajectory& truth) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  const auto step = static_cast<std::size_t>(kClosurePeriod / kFrame);
  for (std::size_t b = 0; b < truth.size(); b += step) {
    std::optional<std::size_t> nearest;
    double least = kRevisitM;
    for (std::size_t a = 0; a + static_cast<std::size_t>(kRevisitS * 20.0) < b; ++a)
      if (const double d = distanceBetween(truth[a].pose, truth[b].pose); d < least) {
        least = d;
        nearest = a;
      }
    if (nearest) pairs.emplace_back(*nearest, b);
  }
  return pairs;
}

ClosureRow makeCandidate(const Trajectory& truth, std::size_t a, std::size_t b) {
  ClosureRow row;
  row.a = {"drive", truth[a].stamp};
  row.b = {"drive", truth[b].stamp};
  return row;
}

std::vector<MetricClosure> drawClosures(const Trajectory& truth, unsigned seed) {
  std::mt19937 random(seed + 1000);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<MetricClosure> closures;
  for (const auto& [a, b] : findRevisits(truth)) {
    ClosureRow row = makeCandidate(truth, a, b);
    row.method = urban_nav_core::ClosureMethod::Stereo;
    Vector6d error = Vector6d::NullaryExpr([&](Eigen::Index) { return normal(random); });
    error.head<3>() *= kClosureM;
    error.tail<3>() *= kClosureRad;
    row.T_a_b = urban_nav_core::boxPlus(truth[a].pose.inverse() * truth[b].pose, error);
    row.sigma_m = kClosureM;
    row.sigma_rad = kClosureRad;
    closures.push_back(toMetricClosure(row));
  }
  return closures;
}

std::vector<MetricClosure> measureClosures(const Trajectory& truth, const SessionOdometry& odometry, Store& store) {
  std::vector<MetricClosure> candidates;
  for (const auto& [a, b] : findRevisits(truth)) candidates.push_back(toMetricClosure(makeCandidate(truth, a, b)));
  Console console;
  CandidateMeasurer measurer;
  measurer.stores = {store.path()};
  measurer.sessions = storedSessions({{"drive", kBenchSession, &odometry}}, store, measurer.camera);
  return runLoops(measurer, candidates, {}, console).closures;
}

struct Figures {
  double displacement = 0.0, angle = 0.0;  ///< m, rad: of the walls of all passes
  double ate = 0.0;                        ///< m, after alignment
  double revisits = 0.0;                   ///< m, rms error of one pass relative to another
  double constraints = 0.0, accepted = 0.0, closures = 0.0;

  Figures& operator+=(const Figures& other) {
    displacement += other.displacement;
    angle += other.angle;
    ate += other.ate;
    revisits += other.revisits;
    constraints += other.constraints;
    accepted += other.accepted;
    closures += other.closures;
    return *this;
  }
};

Figures measure(const GraphRun& run, const Trajectory& truth, Store& store) {
  const Trajectory trajectory = run.trajectory(0);
  laser_mapper::Parameters parameters;
  parameters.ghosts = false;
  laser_mapper::LaserMap map(parameters, store, {{kBenchSession, &trajectory, nullptr}});
  map.render();
  const laser_mapper::QualityFigures walls = laser_mapper::MapQuality(map).walls();
  const VerdictCounts planes = run.planeVerdicts();
  Figures figures;
  figures.constraints = static_cast<double>(planes.all());
  figures.accepted = static_cast<double>(planes.accepted);
  figures.closures = static_cast<double>(run.closureVerdicts().accepted);
  figures.displacement = walls.displacement.mean;
  figures.angle = walls.angle.mean;
  std::vector<Pose> true_poses, poses;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    true_poses.push_back(truth[i].pose);
    poses.push_back(trajectory[i].pose);
  }
  figures.ate = urban_nav_core::absoluteError(true_poses, poses, urban_nav_core::TrajectoryAlignment::Se3).rmse;
  const auto pairs = findRevisits(truth);
  for (const auto& [a, b] : pairs)
    figures.revisits +=
        ((poses[a].inverse() * poses[b]).t() - (true_poses[a].inverse() * true_poses[b]).t()).squaredNorm() /
        static_cast<double>(pairs.size());
  figures.revisits = std::sqrt(figures.revisits);
  return figures;
}

/// Returns the length of the session, s.
double compare(const std::string& bag, unsigned trials, bool by_icp, urban_nav_core::testing::BenchTable& table) {
  const std::filesystem::path path(bag);
  const std::string store_path = (std::filesystem::temp_directory_path() / "urban_nav_plane_drift.db").string();
  urban_nav_store::removeStore(store_path);
  std::optional<Store> opened(std::in_place, store_path, urban_nav_store::Access::Write);
  Store& store = *opened;
  putLaserSession(bag, kBenchSession, "drive", store);
  const Trajectory truth = atFrames(trueTrajectory(bag));
  const double half_length = urban_nav_registration::Parameters().cloud_half_length;
  const PlaneFinder find_planes = [&](const GraphRun& run) {
    return findPlaneClosures({}, store, {kBenchSession}, run, half_length);
  };
  for (const bool has_closures : {false, true})
    for (const bool has_planes : {false, true}) {
      Figures sum;
      for (unsigned seed = 1; seed <= trials; ++seed) {
        const SessionOdometry odometry = makeOdometry(truth, seed);
        std::vector<MetricClosure> closures;
        if (has_closures) closures = by_icp ? measureClosures(truth, odometry, store) : drawClosures(truth, seed);
        const GraphRun run =
            runGraph({}, {&odometry}, {"drive"}, closures, {}, {}, {}, has_planes ? find_planes : PlaneFinder());
        sum += measure(run, truth, store);
      }
      const double mean = 1.0 / trials;
      const auto count = [&](double value) { return has_planes ? cell(mean * value, 0) : std::string("-"); };
      const std::string closures = cell(mean * sum.closures, 0) + (by_icp ? " closures by ICP" : " closures");
      table.add({path.stem().string(), has_closures ? "odometry and " + closures : "odometry", count(sum.constraints),
                 count(sum.accepted), cell(1e3 * mean * sum.displacement, 1), cell(180.0 / M_PI * mean * sum.angle, 2),
                 cell(1e3 * mean * sum.revisits, 0), cell(1e3 * mean * sum.ate, 0)});
      std::fputs((table.text() + "\n").c_str(), stderr);
    }
  opened.reset();
  urban_nav_store::removeStore(store_path);
  return urban_nav_core::secondsBetween(truth.front().stamp, truth.back().stamp);
}

}  // namespace urban_nav::bench

int main(int argc, char** argv) {
  urban_nav_core::testing::BenchTable table(
      {"session", "relaxed with", "constraints from planes", "accepted", "displacement of walls, mm", "angle, deg",
       "error of one pass relative to another, mm", "ATE, mm"},
      argc, argv);
  std::string output;
  unsigned trials = 3;
  bool by_icp = false;
  std::vector<std::string> bags;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "-o" && i + 1 < argc) output = argv[++i];
    else if (word == "--trials" && i + 1 < argc) trials = static_cast<unsigned>(std::atoi(argv[++i]));
    else if (word == "--icp") by_icp = true;
    else bags.push_back(word);
  }
  std::string lengths;
  for (const std::string& bag : bags) {
    const double seconds = urban_nav::bench::compare(bag, trials, by_icp, table);
    lengths += (lengths.empty() ? "" : ", ") + urban_nav_core::testing::cell(seconds, 0) + " s";
  }
  table.note("Sessions of " + lengths +
             "; displacement and angle without ground truth (Table 4 of the paper). Means over " +
             std::to_string(trials) + " random walks of the odometry, each 5 mm and 0.3 mrad per root of a second" +
             (by_icp ? "; closures measured by ICP of the scans." : "; closures are the truth with noise."));
  std::fputs(table.text().c_str(), stdout);
  if (!output.empty()) table.write(output);
  return 0;
}
