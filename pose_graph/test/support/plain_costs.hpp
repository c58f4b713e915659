// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "pose_graph/problem.hpp"

namespace pose_graph::test {

/// An edge's cost as r^T W r from the definitions (data sets' README, "Costs"), independent of the solver.
struct PlainResidual {
  Eigen::VectorXd r;
  Eigen::MatrixXd W;
  double cost() const { return r.dot(W * r); }
};

template <int D>
PlainResidual plainChordal(const Edge<D>& edge, const Rigid<D>& from, const Rigid<D>& to) {
  const double tau = D / edge.information.template topLeftCorner<D, D>().inverse().eval().trace();
  double kappa = edge.information(kTangentSize<D> - 1, kTangentSize<D> - 1);
  if constexpr (D == 3) {
    const Eigen::Matrix3d of_quaternion = 4.0 * edge.information.template bottomRightCorner<3, 3>();
    kappa = 3.0 / (2.0 * of_quaternion.inverse().trace());
  }
  // In the axes of Z's child, as e is: lengths are unchanged, and so is the cost under a common motion of both poses.
  const Eigen::Matrix<double, D, D> child = (from.R * edge.Z.R).transpose();
  const Eigen::Matrix<double, D, D> turn = child * (to.R - from.R * edge.Z.R);
  PlainResidual made;
  made.r.resize(D * D + D);
  made.r << Eigen::Map<const Eigen::Matrix<double, D * D, 1>>(turn.data()),
      child * (to.t + to.R * edge.lever - from.t - from.R * edge.Z.t);
  made.W = Eigen::MatrixXd::Zero(D * D + D, D * D + D);
  made.W.diagonal().head(D * D).setConstant(kappa);
  made.W.diagonal().tail(D).setConstant(tau);
  return made;
}

template <int D>
PlainResidual plainResidual(Objective objective, const Edge<D>& edge, const Rigid<D>& from, const Rigid<D>& to) {
  if (objective == Objective::Chordal) return plainChordal(edge, from, to);
  const Rigid<D> E = edge.Z.inverse() * (from.inverse() * Rigid<D>{to.R, to.t + to.R * edge.lever});
  PlainResidual made;
  made.r.resize(kTangentSize<D>);
  made.W = edge.information;
  if constexpr (D == 2) {
    made.r << E.t, std::atan2(E.R(1, 0), E.R(0, 0));
  } else {
    const Eigen::AngleAxisd turn(E.R);
    if (objective == Objective::Geodesic) {
      made.r << E.t, turn.angle() * turn.axis();
    } else {
      made.r << E.t, std::sin(0.5 * turn.angle()) * turn.axis();  // angle in [0, pi]: w >= 0
      made.W.bottomRows<3>() *= 2.0;
      made.W.rightCols<3>() *= 2.0;
    }
  }
  return made;
}

constexpr Objective kObjectives[] = {Objective::Geodesic, Objective::Chordal, Objective::G2o};

}  // namespace pose_graph::test
