// SPDX-License-Identifier: BSD-3-Clause
#include "fixes/use_fixes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "graph/odometry_variance.hpp"
#include "urban_nav_core/geometry/level_motion.hpp"

namespace pose_graph {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double kCauchyWidth = 2.4;    // standard deviations: 95 % efficiency for normal errors
constexpr double kNarrowerFixes = 0.7;  // per round, from the width that keeps all fixes
constexpr int kMostRounds = 60;         // sufficient for an error of 1e8 standard deviations
constexpr int kFinalRounds = 4;         // with the narrowest kernel
constexpr double kMedianChi2 = 2.366;   // median of chi-square with three degrees of freedom
constexpr double kRejected = 3.37;      // standard deviations: 99 % for three degrees of freedom

std::size_t poseIndex(int number) { return static_cast<std::size_t>(number); }

/// The graph with one more pose per part, its datum frame, and the fixes as edges.
class FixGraph {
 public:
  FixGraph(const Problem<3>& problem, const std::vector<double>& weights, const std::vector<FixedPart>& parts,
           const std::vector<Rigid<3>>& poses)
      : parts_(parts), first_edge_(problem.edges.size()), frames_(poses.size()) {
    graph_ = problem;
    graph_.poses = poses;
    weights_ = weights;
    for (const FixedPart& part : parts_) {
      graph_.poses.push_back(firstFrame(part, poses));
      addUpEdge(part);
      for (const PlacedFix& fix : part.fixes) addFixEdge(fix);
    }
  }

  /// Returns the errors of all fixes at the present poses, in stated standard deviations.
  std::vector<double> errors() const {
    std::vector<double> made;
    forEachFix([&](std::size_t, const Rigid<3>& frame, const PlacedFix& fix) {
      const Rigid<3>& pose = graph_.poses[poseIndex(fix.pose)];
      const Vector3d seen = frame.R.transpose() * (pose.t + pose.R * fix.lever - frame.t);
      made.push_back((seen - fix.measured).cwiseQuotient(fix.sigma).norm());
    });
    return made;
  }

  /// Weights the fixes by their errors, and scales their standard deviations by `sigma_factor`.
  void weigh(const std::vector<double>& errors, double width, double sigma_factor) {
    std::size_t i = 0;
    forEachFix([&](std::size_t edge, const Rigid<3>&, const PlacedFix& fix) {
      const double relative = errors[i++] / width;
      const double weight = fix.share / (sigma_factor * sigma_factor * (1.0 + relative * relative));
      graph_.edges[edge].information.topLeftCorner<3, 3>() =
          Matrix3d((weight / fix.sigma.array().square()).matrix().asDiagonal());
    });
  }

  void relax(const SolveOptions& options) { take(solve(graph_, options, weights_)); }

  /// Returns the factor applied to the variances of the chains.
  double enlargeVariance(std::size_t chains, const SolveOptions& options) {
    Solution<3> solution;
    solution.poses = graph_.poses;
    const double factor =
        takeOdometryVariance(graph_, chains, weights_, options, solution, std::numeric_limits<double>::infinity());
    take(std::move(solution));
    return factor;
  }

  std::vector<Rigid<3>> poses() const {
    return {graph_.poses.begin(), graph_.poses.begin() + static_cast<std::ptrdiff_t>(frames_)};
  }
  const Problem<3>& graph() const { return graph_; }

 private:
  template <typename Visit>
  void forEachFix(Visit visit) const {
    std::size_t edge = first_edge_, part_number = 0;
    for (const FixedPart& part : parts_) {
      const Rigid<3>& frame = graph_.poses[frames_ + part_number++];
      ++edge;  // the edge of the vertical
      for (const PlacedFix& fix : part.fixes) visit(edge++, frame, fix);
    }
  }

  void take(Solution<3> solution) { graph_.poses = std::move(solution.poses); }

  /// Returns the pose of the datum frame that fits the fixes at these poses.
  static Rigid<3> firstFrame(const FixedPart& part, const std::vector<Rigid<3>>& poses) {
    const Rigid<3>& first = poses[poseIndex(part.first_pose)];
    const Matrix3d R_level_map =
        Eigen::Quaterniond::FromTwoVectors(first.R * part.up, Vector3d::UnitZ()).toRotationMatrix();
    std::vector<Vector3d> level, measured;
    std::vector<double> weights;
    for (const PlacedFix& fix : part.fixes) {
      const Rigid<3>& pose = poses[poseIndex(fix.pose)];
      level.emplace_back(R_level_map * (pose.t + pose.R * fix.lever));
      measured.push_back(fix.measured);
      weights.push_back(fix.share / fix.sigma.squaredNorm());
    }
    const urban_nav_core::Pose T_local_level = urban_nav_core::fitLevelMotion(level, measured, weights).pose();
    const Rigid<3> T_local_map{T_local_level.q().toRotationMatrix() * R_level_map, T_local_level.t()};
    return T_local_map.inverse();
  }

  /// Adds an edge that keeps the vertical of the part's first pose, with its uncertainty.
  void addUpEdge(const FixedPart& part) {
    const Rigid<3>& frame = graph_.poses.back();
    Edge<3> edge;
    edge.from = static_cast<int>(graph_.poses.size()) - 1;
    edge.to = part.first_pose;
    edge.Z.R = frame.R.transpose() * graph_.poses[poseIndex(part.first_pose)].R;
    edge.information.setZero();
    edge.information.bottomRightCorner<3, 3>() =
        (Matrix3d::Identity() - part.up * part.up.transpose()) / (part.up_sigma * part.up_sigma);
    graph_.edges.push_back(edge);
    weights_.push_back(1.0);
  }

  void addFixEdge(const PlacedFix& fix) {
    Edge<3> edge;
    edge.from = static_cast<int>(graph_.poses.size()) - 1;
    edge.to = fix.pose;
    edge.Z.t = fix.measured;
    edge.lever = fix.lever;
    edge.information.setZero();  // set by weigh()
    graph_.edges.push_back(edge);
    weights_.push_back(1.0);
  }

  const std::vector<FixedPart>& parts_;
  const std::size_t first_edge_, frames_;  // numbers of the first added edge and pose
  Problem<3> graph_;
  std::vector<double> weights_;
};

double findMedian(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

FixUse useFixes(Problem<3>& problem, std::size_t chains, const std::vector<double>& weights,
                const std::vector<FixedPart>& parts, const SolveOptions& options, Solution<3>& solution,
                double& odometry_variance) {
  FixUse use;
  if (parts.empty()) return use;
  SolveOptions from_here = options;
  from_here.start = Start::Vertices;
  FixGraph graph(problem, weights, parts, solution.poses);
  std::vector<double> errors = graph.errors();
  double width = std::max(kCauchyWidth, *std::max_element(errors.begin(), errors.end()));
  int final_rounds = 0;
  for (int round = 0; round < kMostRounds && final_rounds < kFinalRounds; ++round) {
    graph.weigh(errors, width * use.sigma_factor, use.sigma_factor);
    graph.relax(from_here);
    const bool is_final = width <= kCauchyWidth;
    if (is_final) {
      odometry_variance *= graph.enlargeVariance(chains, from_here);
      ++final_rounds;
    }
    errors = graph.errors();
    if (is_final) use.sigma_factor = std::max(1.0, findMedian(errors) / std::sqrt(kMedianChi2));
    width = std::max(kCauchyWidth, kNarrowerFixes * width);
  }
  for (const double error : errors) ++(error > kRejected * use.sigma_factor ? use.rejected : use.used);
  std::vector<Rigid<3>> poses = graph.poses();
  for (std::size_t i = 0; i < poses.size(); ++i)
    use.moved = std::max(use.moved, (poses[i].t - solution.poses[i].t).norm());
  for (std::size_t e = 0; e < chains; ++e) problem.edges[e].information = graph.graph().edges[e].information;
  solution.poses = std::move(poses);
  solution.cost = cost(problem, solution.poses, options.objective, weights);
  return use;
}

}  // namespace pose_graph
