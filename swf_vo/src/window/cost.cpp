// SPDX-License-Identifier: BSD-3-Clause
#include "window/cost.hpp"

#include <cmath>

#include "window/reserve_with_headroom.hpp"

namespace swf_vo {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using urban_nav_core::boxMinus;
using urban_nav_core::Matrix6d;
using urban_nav_core::Vector6d;

namespace {

// Residual, in standard deviations, of a landmark behind the camera: otherwise a step that turns the camera away from
// all landmarks would have the lowest cost.
constexpr double kUnseen = 100.0;

// Columns of [w]x^T A = -[w]x A, for A of three rows.
Matrix3d minusCross(const Vector3d& w, const Matrix3d& A) {
  Matrix3d result;
  result.row(0) = w.z() * A.row(1) - w.y() * A.row(2);
  result.row(1) = w.x() * A.row(2) - w.z() * A.row(0);
  result.row(2) = w.y() * A.row(0) - w.x() * A.row(1);
  return result;
}

// Adds the pose block of J^T W J for J = [-rho H, H [w]x], with G = H^T W H, in 3x3 blocks.
void addPoseBlock(const SensorModel::Linearised& at, const Matrix3d& G, Matrix6d& block) {
  const Matrix3d T = minusCross(at.w, G);  // [w]x^T G
  block.topLeftCorner<3, 3>() += (at.rho * at.rho) * G;
  block.bottomLeftCorner<3, 3>() -= at.rho * T;
  block.topRightCorner<3, 3>() -= at.rho * T.transpose();
  block.bottomRightCorner<3, 3>() += minusCross(at.w, T.transpose());
}

// J^T a for the same J, with a = H^T W r.
Vector6d poseGradient(const SensorModel::Linearised& at, const Vector3d& a) {
  Vector6d g;
  g.head<3>() = -at.rho * a;
  g.tail<3>() = a.cross(at.w);
  return g;
}

Matrix63d crossBlock(const SensorModel::Linearised& at, const Matrix3d& K) {
  Matrix63d E;
  E.topRows<3>() = -at.rho * K;
  E.bottomRows<3>() = minusCross(at.w, K);
  return E;
}

// The disparity offset shifts points to the left in the right image: dz/doffset = (0, 0, -1).
Vector3d residual(const State& state, const Measurement& measurement, const Vector3d& z) {
  return {measurement.z.x() - z.x(), measurement.z.y() - z.y(), measurement.z.z() - z.z() + state.disparity_offset};
}

ProcessTerm weighted(const process_model::Residual& residual, const Matrix6d& information) {
  ProcessTerm term;
  const Matrix6d WL = information * residual.last, WN = information * residual.next;
  term.last = residual.last.transpose() * WL;
  term.cross = residual.next.transpose() * WL;
  term.next = residual.next.transpose() * WN;
  term.last_gradient = -WL.transpose() * residual.e;
  term.next_gradient = -WN.transpose() * residual.e;
  return term;
}

}  // namespace

double Cost::weigh(double squared, double& cost) const {
  if (huber_ <= 0.0 || squared <= huber_ * huber_) {
    cost += 0.5 * squared;
    return 1.0;
  }
  const double s = std::sqrt(squared);
  cost += huber_ * (s - 0.5 * huber_);
  return huber_ / s;
}

void Cost::relinearise(State& state, const Prior& prior) const {
  for (std::size_t j = 0; j < state.poses.size(); ++j) {
    PoseBlock& pose = state.poses[j];
    const bool touched = linearise_first_ && prior.frozen && j == 0;
    pose.linearised = touched ? prior.pose_centre : pose.estimate;
    pose.at_estimate = PoseMatrices(pose.estimate);
    pose.at_linearised = touched ? PoseMatrices(pose.linearised) : pose.at_estimate;
  }
  for (LandmarkBlock& landmark : state.landmarks) {
    if (!landmark.used) continue;
    const bool touched = linearise_first_ && landmark.prior >= 0;
    landmark.linearised = touched ? prior.landmark_centre[static_cast<std::size_t>(landmark.prior)] : landmark.estimate;
  }
}

template <bool with_matrices>
void Cost::accumulateProcess(State& state, NormalEquations& equations) const {
  for (std::size_t j = 1; j < state.poses.size(); ++j) {
    PoseBlock& next = state.poses[j];
    const PoseBlock& last = state.poses[j - 1];
    next.u_solved = true;
    process_model::Residual residual = process_model::residual(last.linearised, next.linearised, next.u.T_from_to);
    residual.e = process_model::error(last.estimate, next.estimate, next.u.T_from_to);
    const Matrix6d information = next.u.information + process_model::floor();
    const ProcessTerm term = weighted(residual, information);
    if (with_matrices) {
      equations.pose[j - 1] += term.last;
      equations.pose[j] += term.next;
      equations.next[j - 1] = term.cross;
    }
    equations.pose_gradient[j - 1] += term.last_gradient;
    equations.pose_gradient[j] += term.next_gradient;
    equations.cost += 0.5 * residual.e.dot(information * residual.e);
  }
}

namespace {

/// Sets the equations to zero; blocks of landmarks are assigned by the caller.
template <bool with_matrices>
void clear(NormalEquations& equations, std::size_t poses, std::size_t slots) {
  equations.pose_gradient.assign(poses, Vector6d::Zero());
  equations.landmark_gradient.resize(slots);
  equations.cost = 0.0;
  equations.border.gradient = 0.0;
  if (with_matrices) {
    equations.border.pose.assign(poses, Vector6d::Zero());
    equations.border.landmark.resize(slots);
    equations.border.information = 0.0;
    equations.pose.assign(poses, Matrix6d::Zero());
    equations.next.assign(poses, Matrix6d::Zero());
    equations.landmark.resize(slots);
    equations.first_cross.resize(slots);
    equations.cross.clear();
    reserveWithHeadroom(equations.cross, 2 * slots);
  }
}

}  // namespace

template <bool with_matrices>
void Cost::accumulate(State& state, NormalEquations& equations) const {
  const std::size_t slots = state.landmarks.size();
  clear<with_matrices>(equations, state.poses.size(), slots);
  SensorModel::Linearised at;
  Vector3d z;
  for (std::size_t slot = 0; slot < slots; ++slot) {
    LandmarkBlock& landmark = state.landmarks[slot];
    if (!landmark.used) continue;
    Matrix3d C = Matrix3d::Zero();
    Vector3d g = Vector3d::Zero(), b = Vector3d::Zero();
    if (with_matrices) equations.first_cross[slot] = static_cast<int>(equations.cross.size());
    for (Measurement& measurement : landmark.seen) {
      const std::size_t j = static_cast<std::size_t>(measurement.step - state.first_step);
      const PoseBlock& pose = state.poses[j];
      measurement.solved = true;
      if (!sensor_.predict(landmark.anchor, landmark.estimate, pose.at_estimate, z) ||
          !sensor_.linearise(landmark.anchor, landmark.linearised, pose.at_linearised, at)) {
        measurement.weight = 0.0;
        weigh(kUnseen * kUnseen, equations.cost);
        if (with_matrices && !landmark.known) equations.cross.push_back(Matrix63d::Zero());
        continue;
      }
      const Vector3d r = residual(state, measurement, z);
      const Vector3d Or = measurement.information * r;
      measurement.weight = weigh(r.dot(Or), equations.cost);
      const Vector3d Wr = measurement.weight * Or;
      equations.pose_gradient[j] += poseGradient(at, at.H.transpose() * Wr);
      g.noalias() += at.landmark.transpose() * Wr;
      equations.border.gradient -= Wr.z();
      if (with_matrices) {
        const Vector3d Wo = -measurement.weight * measurement.information.col(2);
        equations.border.pose[j] += poseGradient(at, at.H.transpose() * Wo);
        equations.border.information -= Wo.z();
        b.noalias() += at.landmark.transpose() * Wo;
        const Matrix3d HW = measurement.weight * (at.H.transpose() * measurement.information);
        addPoseBlock(at, HW * at.H, equations.pose[j]);
        if (landmark.known) continue;
        const Matrix3d K = HW * at.landmark;
        equations.cross.push_back(crossBlock(at, K));
        C.noalias() += at.landmark.transpose() * (measurement.weight * (measurement.information * at.landmark));
      }
    }
    equations.landmark_gradient[slot] = g;
    if (with_matrices) equations.landmark[slot] = C;
    if (with_matrices) equations.border.landmark[slot] = b;
  }
  accumulateProcess<with_matrices>(state, equations);
}

void Cost::build(State& state, NormalEquations& equations) const { accumulate<true>(state, equations); }
void Cost::buildGradient(State& state, NormalEquations& equations) const { accumulate<false>(state, equations); }

double Cost::value(const State& state) const {
  double cost = 0.0;
  Vector3d z;
  for (const LandmarkBlock& landmark : state.landmarks) {
    if (!landmark.used) continue;
    for (const Measurement& measurement : landmark.seen) {
      const PoseBlock& pose = state.poses[static_cast<std::size_t>(measurement.step - state.first_step)];
      if (!sensor_.predict(landmark.anchor, landmark.estimate, pose.at_estimate, z)) {
        weigh(kUnseen * kUnseen, cost);
        continue;
      }
      const Vector3d r = residual(state, measurement, z);
      weigh(r.dot(measurement.information * r), cost);
    }
  }
  for (std::size_t j = 1; j < state.poses.size(); ++j) {
    const Vector6d e =
        process_model::error(state.poses[j - 1].estimate, state.poses[j].estimate, state.poses[j].u.T_from_to);
    cost += 0.5 * e.dot((state.poses[j].u.information + process_model::floor()) * e);
  }
  return cost;
}

SensorTerm Cost::sensorTerm(const State& state, const LandmarkBlock& landmark, const Measurement& measurement,
                            const PoseBlock& pose) const {
  SensorTerm term{Matrix6d::Zero(), Matrix63d::Zero(), Matrix3d::Zero(), Vector6d::Zero(),
                  Vector6d::Zero(), Vector3d::Zero(),  Vector3d::Zero()};
  // The textbook variant uses the values of its update: the residual at the linearisation point, and the step from
  // there.
  const bool as_solved = !linearise_first_ && measurement.solved;
  const bool at_first = linearise_first_ || as_solved;
  const PoseMatrices now(pose.estimate);
  const PoseMatrices linearised = at_first ? PoseMatrices(pose.linearised) : now;
  const Vector3d& theta = at_first ? landmark.linearised : landmark.estimate;
  SensorModel::Linearised at;
  Vector3d z;
  const bool seen = as_solved ? sensor_.predict(landmark.anchor, theta, linearised, z)
                              : sensor_.predict(landmark.anchor, landmark.estimate, now, z);
  if (!seen || !sensor_.linearise(landmark.anchor, theta, linearised, at)) return term;
  Vector3d r = residual(state, measurement, z);
  double unused = 0.0;
  const double weight = weigh(r.dot(measurement.information * r), unused);
  if (as_solved) {
    r -= at.pose() * boxMinus(pose.estimate, pose.linearised);
    if (!landmark.known) r -= at.landmark * (landmark.estimate - landmark.linearised);
  }
  const Matrix3d W = weight * measurement.information;
  const Matrix3d HW = at.H.transpose() * W;
  addPoseBlock(at, HW * at.H, term.pose);
  term.pose_gradient = poseGradient(at, HW * r);
  term.pose_border = poseGradient(at, -HW.col(2));
  term.border_information = W(2, 2);
  term.border_gradient = -W.row(2).dot(r);
  if (landmark.known) return term;
  term.cross = crossBlock(at, HW * at.landmark);
  term.landmark = at.landmark.transpose() * W * at.landmark;
  term.landmark_gradient = at.landmark.transpose() * W * r;
  term.landmark_border = -at.landmark.transpose() * W.col(2);
  return term;
}

ProcessTerm Cost::processTerm(const PoseBlock& last, const PoseBlock& next) const {
  const bool as_solved = !linearise_first_ && next.u_solved;
  const bool at_first = linearise_first_ || as_solved;
  process_model::Residual residual = process_model::residual(
      at_first ? last.linearised : last.estimate, at_first ? next.linearised : next.estimate, next.u.T_from_to);
  if (as_solved) {
    residual.e += residual.last * boxMinus(last.estimate, last.linearised) +
                  residual.next * boxMinus(next.estimate, next.linearised);
  } else {
    residual.e = process_model::error(last.estimate, next.estimate, next.u.T_from_to);
  }
  return weighted(residual, next.u.information + process_model::floor());
}

}  // namespace swf_vo
