// SPDX-License-Identifier: BSD-3-Clause
#include "start/chordal_start.hpp"

#include "linear/index.hpp"

namespace pose_graph {

namespace {

// In the plane a rotation commutes with a quarter turn, so one column determines it.
template <int D>
constexpr int kColumns = D == 2 ? 1 : 3;

template <int D>
Rotation<D> fromTransposedColumns(const Eigen::Matrix<double, D, kColumns<D>>& Y) {
  if constexpr (D == 2) {
    Eigen::Matrix2d M;  // R^T = [c, s; -s, c], of which Y is the first column
    M << Y(0), Y(1), -Y(1), Y(0);
    return nearestRotation(M);
  } else {
    return nearestRotation(Eigen::Matrix3d(Y.transpose()));
  }
}

}  // namespace

template <int D>
std::optional<std::vector<Rotation<D>>> chordalRotations(const NormalEquations<D>& equations,
                                                         const std::vector<Rigid<D>>& poses,
                                                         const std::vector<double>& weights) {
  constexpr int kC = kColumns<D>;
  const Symbolic& symbolic = equations.symbolic();
  const std::size_t n = symbolic.node.size();
  BlockMatrix<D> A;
  A.setZero(equations.pattern());
  // Unknowns: Y_i = R_i^T. Column c of all unknowns, one column after the other.
  std::vector<double> x(n * D * kC, 0.0);
  const auto part = [&](int place, int c) {
    return Eigen::Map<Eigen::Matrix<double, D, 1>>(x.data() + (sz(c) * n + sz(place)) * D);
  };
  for (std::size_t e = 0; e < equations.terms().size(); ++e) {
    const EdgeTerm<D>& term = equations.terms()[e];
    const auto& place = equations.edgePlaces()[e];
    const double w = term.kappa * (weights.empty() ? 1.0 : weights[e]);
    if (place.from >= 0) A.diagonal[sz(place.from)].diagonal().array() += w;
    if (place.to >= 0) A.diagonal[sz(place.to)].diagonal().array() += w;
    if (place.from >= 0 && place.to >= 0) {
      auto& block = A.lower[sz(place.slot.index)];
      if (place.slot.turned) block -= w * term.R_Z.transpose();
      else block -= w * term.R_Z;
    } else if (place.to >= 0) {
      const Rotation<D> Y = poses[sz(term.from)].R.transpose();
      for (int c = 0; c < kC; ++c) part(place.to, c) += w * (term.R_Z.transpose() * Y.col(c));
    } else if (place.from >= 0) {
      const Rotation<D> Y = poses[sz(term.to)].R.transpose();
      for (int c = 0; c < kC; ++c) part(place.from, c) += w * (term.R_Z * Y.col(c));
    }
  }
  BlockCholesky<D> cholesky(symbolic);
  if (!cholesky.factor(A, equations.pattern())) return std::nullopt;
  cholesky.solve(x.data(), kC);
  std::vector<Rotation<D>> rotations(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) rotations[i] = poses[i].R;
  for (std::size_t u = 0; u < n; ++u) {
    Eigen::Matrix<double, D, kC> Y;
    for (int c = 0; c < kC; ++c) Y.col(c) = part(symbolic.place[u], c);
    rotations[sz(equations.unknowns().pose[u])] = fromTransposedColumns<D>(Y);
  }
  return rotations;
}

template <int D>
std::optional<std::vector<Rigid<D>>> translationsFor(const NormalEquations<D>& equations,
                                                     const std::vector<Rotation<D>>& rotations,
                                                     const std::vector<Rigid<D>>& poses,
                                                     const std::vector<double>& weights) {
  const Symbolic& symbolic = equations.symbolic();
  const std::size_t n = symbolic.node.size();
  BlockMatrix<D> A;
  A.setZero(equations.pattern());
  std::vector<double> x(n * D, 0.0);
  const auto part = [&](int place) { return Eigen::Map<Eigen::Matrix<double, D, 1>>(x.data() + sz(place) * D); };
  for (std::size_t e = 0; e < equations.terms().size(); ++e) {
    const EdgeTerm<D>& term = equations.terms()[e];
    const auto& place = equations.edgePlaces()[e];
    const Rotation<D> T = rotations[sz(term.from)] * term.R_Z;
    const Rotation<D> W =
        (weights.empty() ? 1.0 : weights[e]) * (T * term.information.template topLeftCorner<D, D>() * T.transpose());
    Eigen::Matrix<double, D, 1> step = T * term.t_Z;  // t_to - t_from as measured
    if (term.has_lever) step -= rotations[sz(term.to)] * term.lever;
    const Eigen::Matrix<double, D, 1> b = W * step;
    if (place.from >= 0) {
      A.diagonal[sz(place.from)] += W;
      part(place.from) -= b;
      if (place.to < 0) part(place.from) += W * poses[sz(term.to)].t;
    }
    if (place.to >= 0) {
      A.diagonal[sz(place.to)] += W;
      part(place.to) += b;
      if (place.from < 0) part(place.to) += W * poses[sz(term.from)].t;
    }
    if (place.from >= 0 && place.to >= 0) A.lower[sz(place.slot.index)] -= W;
  }
  BlockCholesky<D> cholesky(symbolic);
  if (!cholesky.factor(A, equations.pattern())) return std::nullopt;
  cholesky.solve(x.data());
  std::vector<Rigid<D>> made = poses;
  for (std::size_t i = 0; i < made.size(); ++i) made[i].R = rotations[i];
  for (std::size_t u = 0; u < n; ++u) made[sz(equations.unknowns().pose[u])].t = part(symbolic.place[u]);
  return made;
}

template std::optional<std::vector<Rotation<2>>> chordalRotations<2>(const NormalEquations<2>&,
                                                                     const std::vector<Rigid<2>>&,
                                                                     const std::vector<double>&);
template std::optional<std::vector<Rotation<3>>> chordalRotations<3>(const NormalEquations<3>&,
                                                                     const std::vector<Rigid<3>>&,
                                                                     const std::vector<double>&);
template std::optional<std::vector<Rigid<2>>> translationsFor<2>(const NormalEquations<2>&,
                                                                 const std::vector<Rotation<2>>&,
                                                                 const std::vector<Rigid<2>>&,
                                                                 const std::vector<double>&);
template std::optional<std::vector<Rigid<3>>> translationsFor<3>(const NormalEquations<3>&,
                                                                 const std::vector<Rotation<3>>&,
                                                                 const std::vector<Rigid<3>>&,
                                                                 const std::vector<double>&);

}  // namespace pose_graph
