// SPDX-License-Identifier: BSD-3-Clause
#include "topics/trust/closure_differences.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <map>
#include <optional>

#include "urban_nav_core/geometry/covariance_frames.hpp"

namespace urban_nav {

using urban_nav_core::ConsideredConstant;
using urban_nav_core::Matrix6d;
using urban_nav_core::MetricClosure;
using urban_nav_core::OdometryChain;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Vector6d;
using urban_nav_trust::ClosureDifference;

namespace {

constexpr double kFreeInformation = 1e-9;  // relative to the best direction; below it there is no information

/// Errors of the constants of the rig along a path.
struct SharedErrors {
  Vector6d unknown = Vector6d::Zero();  ///< per unit error of the constant
  Vector6d unused = Vector6d::Zero();   ///< since steps used another value than the final estimate
};

/// Returns the covariance of T_a_b due to errors of the constants common to all steps between the two stamps. The
/// uncertainty of a constant is that of the newest step of the session.
Matrix6d constantCovariance(const SessionOdometry& run, StampNs a, StampNs b) {
  std::map<std::string, ConsideredConstant> known;
  for (const ConsideredConstant& constant : run.settled.back().from_previous.constants) known[constant.name] = constant;
  std::map<std::string, SharedErrors> errors;
  Pose T_a_step;
  Matrix6d covariance = Matrix6d::Zero();
  for (const SmoothedFrame& frame : run.settled) {
    const urban_nav_core::RelativePose& step = frame.from_previous;
    if (step.to <= a || step.to > b || step.from == step.to) continue;
    const Matrix6d to_a = urban_nav_core::adjoint(T_a_step) * urban_nav_core::leftFromBox(step.T_from_to);
    for (const ConsideredConstant& constant : step.constants) {
      const auto now = known.find(constant.name);
      if (now == known.end()) continue;
      const Vector6d moved = to_a * constant.sensitivity;
      errors[constant.name].unknown += moved;
      errors[constant.name].unused += (constant.used - now->second.mean) * moved;
    }
    T_a_step = T_a_step * step.T_from_to;
  }
  const Matrix6d to_box = urban_nav_core::boxFromLeft(T_a_step);
  for (const auto& [name, error] : errors) {
    const Vector6d unknown = known[name].sigma * to_box * error.unknown, unused = to_box * error.unused;
    covariance += unknown * unknown.transpose() + unused * unused.transpose();
  }
  return covariance;
}

/// Compares a measured T_a_b with that of odometry between the same stamps; nullopt without one of both.
std::optional<ClosureDifference> compare(StampNs a, StampNs b, const urban_nav_core::Constraint& measured,
                                         const SessionOdometry& run, const OdometryChain& chain) {
  const std::optional<urban_nav_core::PoseWithCovariance> T_a_b = chain.between(a, b);
  const Eigen::SelfAdjointEigenSolver<Matrix6d> information(measured.information);
  const double largest = information.eigenvalues().maxCoeff();
  if (!T_a_b || !(largest > 0.0)) return std::nullopt;
  const Eigen::Index free = (information.eigenvalues().array() <= kFreeInformation * largest).count(), known = 6 - free;
  const Eigen::MatrixXd axes = information.eigenvectors().rightCols(known);
  const auto [first, last] = std::minmax(a, b);
  Matrix6d constants = constantCovariance(run, first, last);
  if (b < a) {  // T_b_a is the inverse
    const Matrix6d turned =
        urban_nav_core::boxFromRight(T_a_b->pose) * urban_nav_core::leftFromBox(T_a_b->pose.inverse());
    constants = urban_nav_core::transformCovariance(turned, constants);
  }
  ClosureDifference compared;
  compared.interval = {first, last};
  compared.difference = axes.transpose() * boxMinus(measured.T_a_b, T_a_b->pose);
  compared.odometry = axes.transpose() * (T_a_b->covariance + constants) * axes;
  compared.closure = information.eigenvalues().tail(known).cwiseInverse().asDiagonal();
  compared.distance_m = distanceBetween(measured.T_a_b, T_a_b->pose);
  compared.angle_rad = angleBetween(measured.T_a_b, T_a_b->pose);
  return compared;
}

}  // namespace

std::vector<ClosureDifference> closureDifferences(const std::string& session, const SessionOdometry& odometry,
                                                  const std::vector<MetricClosure>& closures,
                                                  const std::vector<ClosureAssessment>& assessments) {
  std::vector<ClosureDifference> differences;
  if (odometry.settled.size() < 2 || assessments.size() != closures.size()) return differences;
  const OdometryChain chain = odometryChain(odometry);
  for (std::size_t i = 0; i < closures.size(); ++i) {
    const MetricClosure& closure = closures[i];
    if (assessments[i].verdict != urban_nav_core::ClosureVerdict::Accepted || closure.a.session != session ||
        closure.b.session != session || closure.method == urban_nav_core::ClosureMethod::None)
      continue;
    std::optional<ClosureDifference> each =
        compare(closure.a.stamp, closure.b.stamp, closure.measured, odometry, chain);
    if (!each) continue;
    each->by_laser = closure.method == urban_nav_core::ClosureMethod::Icp;
    differences.push_back(std::move(*each));
  }
  return differences;
}

std::vector<ClosureDifference> planeDifferences(urban_nav_store::Store& store,
                                                const urban_nav_store::SessionId& session,
                                                const SessionOdometry& odometry) {
  std::vector<ClosureDifference> differences;
  if (odometry.settled.size() < 2) return differences;
  const OdometryChain chain = odometryChain(odometry);
  store.graph().forEachEdge(session, [&](const urban_nav_store::Edge& edge) {
    if (edge.kind != urban_nav_store::EdgeKind::Plane || edge.a.session != session || edge.b.session != session) return;
    std::optional<ClosureDifference> each = compare(edge.a.stamp, edge.b.stamp, edge.measured, odometry, chain);
    if (!each) return;
    each->by_laser = true;
    differences.push_back(std::move(*each));
  });
  return differences;
}

}  // namespace urban_nav
