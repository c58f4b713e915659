// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <Eigen/Cholesky>
#include <array>
#include <vector>

#include "observation.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "window/process_model.hpp"

namespace swf_vo {

/// Batch solution of the whole trajectory by Ceres, with an independent cost (points in `odom`, projection and process
/// error by automatic differentiation), as reference for the window.
struct BatchProblem {
  urban_nav_core::StereoCamera camera;
  std::vector<urban_nav_core::Pose> poses;     ///< initial values by frame, and results
  std::vector<ProcessInput> inputs;            ///< inputs[i] is from pose i - 1 to pose i
  urban_nav_core::Matrix6d first_information;  ///< of poses.front() at its initial value
  std::vector<Eigen::Vector3d> points;         ///< initial values by landmark, and results
  std::vector<char> known;                     ///< fixed landmarks; empty: none
  std::vector<Observation> observations;
  double huber = 0.0;
  int iterations = 100;
};

namespace batch {

// A pose as (t, rotation vector relative to the initial value).
struct Start {
  Eigen::Matrix3d R;

  template <typename T>
  Eigen::Matrix<T, 3, 3> rotation(const T* pose) const {
    Eigen::Matrix<T, 3, 3> turn;
    ceres::AngleAxisToRotationMatrix(pose + 3, turn.data());
    return turn * R.cast<T>();
  }
};

struct Sight {
  const urban_nav_core::StereoCamera& camera;
  Start start;
  Eigen::Vector3d z;
  Eigen::Matrix3d root;

  template <typename T>
  bool operator()(const T* pose, const T* point, T* residual) const {
    using Vector = Eigen::Matrix<T, 3, 1>;
    const Vector p =
        start.rotation(pose).transpose() * (Eigen::Map<const Vector>(point) - Eigen::Map<const Vector>(pose));
    const T fx(camera.left.fx), fy(camera.left.fy);
    const Vector predicted(fx * p.x() / p.z() + camera.left.cx, fy * p.y() / p.z() + camera.left.cy,
                           fx * (p.x() - camera.baseline) / p.z() + camera.left.cx);
    Eigen::Map<Vector>(residual).noalias() = root.cast<T>() * (z.cast<T>() - predicted);
    return true;
  }
};

struct Motion {
  Start last, next;
  urban_nav_core::Pose u;
  urban_nav_core::Matrix6d root;

  template <typename T>
  bool operator()(const T* a, const T* b, T* residual) const {
    using Vector = Eigen::Matrix<T, 3, 1>;
    const Eigen::Matrix<T, 3, 3> Ra = last.rotation(a), Rb = next.rotation(b);
    const Vector t = Ra.transpose() * (Eigen::Map<const Vector>(b) - Eigen::Map<const Vector>(a));
    const Eigen::Matrix<T, 3, 3> turn = Ra.transpose() * Rb * u.R().transpose().cast<T>();
    Eigen::Matrix<T, 6, 1> e;
    e.template head<3>() = t - u.t().cast<T>();
    ceres::RotationMatrixToAngleAxis(turn.data(), e.data() + 3);
    Eigen::Map<Eigen::Matrix<T, 6, 1>>(residual).noalias() = root.cast<T>() * e;
    return true;
  }
};

struct First {
  Eigen::Vector3d t;
  urban_nav_core::Matrix6d root;

  template <typename T>
  bool operator()(const T* pose, T* residual) const {
    Eigen::Matrix<T, 6, 1> e;
    for (int i = 0; i < 3; ++i) {
      e[i] = pose[i] - T(t[i]);
      e[i + 3] = pose[i + 3];
    }
    Eigen::Map<Eigen::Matrix<T, 6, 1>>(residual).noalias() = root.cast<T>() * e;
    return true;
  }
};

template <typename Matrix>
Matrix squareRoot(const Matrix& information) {
  return information.llt().matrixU();
}

}  // namespace batch

/// Returns false if Ceres did not converge.
inline bool solveBatch(BatchProblem& all) {
  std::vector<std::array<double, 6>> poses(all.poses.size());
  std::vector<batch::Start> starts;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const urban_nav_core::Pose& pose = all.poses[i];
    poses[i] = {pose.t().x(), pose.t().y(), pose.t().z(), 0.0, 0.0, 0.0};
    starts.push_back({pose.R()});
  }
  ceres::Problem problem;
  for (const Observation& observation : all.observations) {
    const std::size_t i = static_cast<std::size_t>(observation.frame),
                      m = static_cast<std::size_t>(observation.landmark);
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<batch::Sight, 3, 6, 3>(new batch::Sight{
                                 all.camera, starts[i], observation.z, batch::squareRoot(observation.information)}),
                             all.huber > 0.0 ? new ceres::HuberLoss(all.huber) : nullptr, poses[i].data(),
                             all.points[m].data());
    if (!all.known.empty() && all.known[m]) problem.SetParameterBlockConstant(all.points[m].data());
  }
  for (std::size_t i = 1; i < poses.size(); ++i)
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<batch::Motion, 6, 6, 6>(new batch::Motion{
            starts[i - 1], starts[i], all.inputs[i].T_from_to,
            batch::squareRoot<urban_nav_core::Matrix6d>(all.inputs[i].information + process_model::floor())}),
        nullptr, poses[i - 1].data(), poses[i].data());
  problem.AddResidualBlock(new ceres::AutoDiffCostFunction<batch::First, 6, 6>(
                               new batch::First{all.poses.front().t(), batch::squareRoot(all.first_information)}),
                           nullptr, poses.front().data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_SCHUR;
  options.max_num_iterations = all.iterations;
  options.function_tolerance = 1e-16;
  options.gradient_tolerance = 1e-14;
  options.parameter_tolerance = 1e-13;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Eigen::Matrix3d turn;
    ceres::AngleAxisToRotationMatrix(poses[i].data() + 3, turn.data());
    all.poses[i] = urban_nav_core::Pose(Eigen::Matrix3d(turn * starts[i].R),
                                        Eigen::Vector3d(poses[i][0], poses[i][1], poses[i][2]));
  }
  return summary.IsSolutionUsable();
}

}  // namespace swf_vo
