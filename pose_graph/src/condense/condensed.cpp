// SPDX-License-Identifier: BSD-3-Clause
#include "condense/condensed.hpp"

#include <Eigen/LU>

#include "manifold/rotation.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace pose_graph {

namespace {

std::size_t sz(int i) { return static_cast<std::size_t>(i); }

template <int D>
using Turn = Eigen::Matrix<double, D, rotation_size<D>>;

// A twist w about the origin moves a pose at t by (rho, phi) = (w_rho + phi x t, w_phi), and back.
template <int D>
Tangent<D> boxFromTwist(const Tangent<D>& w, const Eigen::Matrix<double, D, 1>& t) {
  Tangent<D> x = w;
  x.template head<D>() += turned(t) * w.template tail<rotation_size<D>>();
  return x;
}
template <int D>
Tangent<D> twistFromBox(const Tangent<D>& x, const Eigen::Matrix<double, D, 1>& t) {
  Tangent<D> w = x;
  w.template head<D>() -= turned(t) * x.template tail<rotation_size<D>>();
  return w;
}
// The covariance of what is shifted by v turns: J P J^T with J = [I, sign turned(t); 0, I].
template <int D>
TangentMatrix<D> shifted(TangentMatrix<D> P, const Eigen::Matrix<double, D, 1>& t, double sign) {
  constexpr int r = rotation_size<D>;
  const Turn<D> turn = sign * turned(t);
  P.template topRows<D>() += turn * P.template bottomRows<r>();
  P.template leftCols<D>() += P.template rightCols<r>() * turn.transpose();
  return P;
}
// Both blocks seen from axes that are turned by A.
template <int D>
TangentMatrix<D> turnedBy(const Rotation<D>& A, const TangentMatrix<D>& P) {
  TangentMatrix<D> made;
  if constexpr (D == 2) {
    made.template topLeftCorner<2, 2>() = A * P.template topLeftCorner<2, 2>() * A.transpose();
    made.template topRightCorner<2, 1>() = A * P.template topRightCorner<2, 1>();
    made.template bottomLeftCorner<1, 2>() = made.template topRightCorner<2, 1>().transpose();
    made(2, 2) = P(2, 2);
  } else {
    made.template topLeftCorner<3, 3>() = A * P.template topLeftCorner<3, 3>() * A.transpose();
    made.template topRightCorner<3, 3>() = A * P.template topRightCorner<3, 3>() * A.transpose();
    made.template bottomLeftCorner<3, 3>() = made.template topRightCorner<3, 3>().transpose();
    made.template bottomRightCorner<3, 3>() = A * P.template bottomRightCorner<3, 3>() * A.transpose();
  }
  return made;
}
template <int D>
Tangent<D> turnedBy(const Rotation<D>& A, const Tangent<D>& x) {
  Tangent<D> made = x;
  made.template head<D>() = A * x.template head<D>();
  if constexpr (D == 3) made.template tail<3>() = A * x.template tail<3>();
  return made;
}

// [R, t] as boxPlus of `base` would have it: (t - t_base, Log(R R_base^T)).
template <int D>
Tangent<D> boxBetween(const Rigid<D>& T, const Rigid<D>& base) {
  Tangent<D> x;
  x.template head<D>() = T.t - base.t;
  x.template tail<rotation_size<D>>() = logRotation(Rotation<D>(T.R * base.R.transpose()));
  return x;
}

template <int D>
TangentMatrix<D> inverseOf(const TangentMatrix<D>& M) {
  return Eigen::LLT<TangentMatrix<D>>(M).solve(TangentMatrix<D>::Identity());
}

// A chain may hold edges whose information, scaled to ones on its diagonal, is far from singular.
constexpr double kLeastPivot = 1e-10;

/// The inverse of an edge's information, or none where that is near singular once it is scaled to ones on its diagonal.
template <int D>
bool invert(const TangentMatrix<D>& information, TangentMatrix<D>& inverse) {
  const Tangent<D> diagonal = information.diagonal();
  if (!(diagonal.minCoeff() > 0.0)) return false;
  const Tangent<D> scale = diagonal.cwiseSqrt().cwiseInverse();
  const Eigen::LLT<TangentMatrix<D>> factor(TangentMatrix<D>(scale.asDiagonal() * information * scale.asDiagonal()));
  if (factor.info() != Eigen::Success || !(factor.matrixLLT().diagonal().cwiseAbs2().minCoeff() > kLeastPivot))
    return false;
  inverse = scale.asDiagonal() * factor.solve(TangentMatrix<D>(scale.asDiagonal()));
  return inverse.allFinite();
}

constexpr std::size_t kGrain = 16;  // chains to a thread at a time

}  // namespace

template <int D>
Condensed<D>::Condensed(const Problem<D>& problem, const std::vector<double>& weights) : problem_(&problem) {
  std::vector<char> invertible(problem.edges.size());
  std::vector<TangentMatrix<D>> inverses(problem.edges.size());
  for (std::size_t e = 0; e < invertible.size(); ++e)
    invertible[e] = (weights.empty() || weights[e] == 1.0) && invert<D>(problem.edges[e].information, inverses[e]);
  chains_ = findChains(problem, invertible);
  core_of_.assign(problem.poses.size(), -1);
  for (std::size_t c = 0; c < chains_.core.size(); ++c) core_of_[sz(chains_.core[c])] = static_cast<int>(c);
  covariance_.reserve(chains_.links.size());
  for (const Link& link : chains_.links) covariance_.push_back(inverses[sz(link.edge)]);
  at_.resize(chains_.links.size());
  link_sums_.resize(chains_.links.size());
  chain_sums_.resize(chains_.size());
  chain_costs_.assign(chains_.size(), 0.0);
  layByOdometry();
}

template <int D>
Rigid<D> Condensed<D>::measured(const Link& link) const {
  const Rigid<D>& Z = problem_->edges[sz(link.edge)].Z;
  return link.against ? Z.inverse() : Z;
}

template <int D>
void Condensed<D>::layByOdometry() {
  for (std::size_t s = 0; s < chains_.size(); ++s) {
    Rigid<D> at;
    for (std::size_t l = sz(chains_.first[s]); l < sz(chains_.first[s + 1]); ++l) {
      at = at * measured(chains_.links[l]);
      at.R = renormalised<D>(at.R);
      at_[l] = at;
    }
  }
}

template <int D>
void Condensed<D>::layBy(const std::vector<Rigid<D>>& poses) {
  for (std::size_t s = 0; s < chains_.size(); ++s) {
    const Rigid<D> T_begin_map = poses[sz(chains_.begin[s])].inverse();
    for (std::size_t l = sz(chains_.first[s]); l < sz(chains_.first[s + 1]); ++l)
      at_[l] = T_begin_map * poses[sz(chains_.links[l].pose)];
  }
}

template <int D>
typename Condensed<D>::Sum Condensed<D>::linkSum(std::size_t l, const Rigid<D>& before, const Rigid<D>& after,
                                                 double* cost) const {
  constexpr int r = rotation_size<D>;
  const Link& link = chains_.links[l];
  const Edge<D>& edge = problem_->edges[sz(link.edge)];
  const Rigid<D>&from = link.against ? after : before, &to = link.against ? before : after;
  const Rotation<D> A = from.R * edge.Z.R;
  Tangent<D> e;
  e.template head<D>() = A.transpose() * (to.t - from.t) - edge.Z.R.transpose() * edge.Z.t;
  e.template tail<r>() = logRotation(Rotation<D>(A.transpose() * to.R));
  *cost += e.dot(edge.information * e);
  // e changes by (A^T rho, J_l^-1 A^T phi) when `to` moves by (rho, phi), and J_l(e) e = e.
  TangentMatrix<D> P = covariance_[l];
  if constexpr (D == 3) {
    if (e.template tail<3>().squaredNorm() > 0.0) {
      const Eigen::Matrix3d J = urban_nav_core::leftJacobianSo3(e.template tail<3>());
      P.template bottomRows<3>() = (J * P.template bottomRows<3>()).eval();
      P.template rightCols<3>() = (P.template rightCols<3>() * J.transpose()).eval();
    }
  }
  Sum sum;
  sum.covariance = shifted<D>(turnedBy<D>(A, P), to.t, -1.0);
  sum.shift = twistFromBox<D>(turnedBy<D>(A, Tangent<D>(-e)), to.t);
  if (link.against) sum.shift = -sum.shift;  // the twist of what comes behind against what comes before
  return sum;
}

template <int D>
double Condensed<D>::relinearise() {
  urban_nav_core::forEach(chains_.size(), kGrain, [&](std::size_t s) {
    Sum total;
    double cost = 0.0;
    Rigid<D> before;
    for (std::size_t l = sz(chains_.first[s]); l < sz(chains_.first[s + 1]); ++l) {
      link_sums_[l] = linkSum(l, before, at_[l], &cost);
      total.shift += link_sums_[l].shift;
      total.covariance += link_sums_[l].covariance;
      before = at_[l];
    }
    chain_sums_[s] = total;
    chain_costs_[s] = cost;
  });
  double cost = 0.0;
  for (const double one : chain_costs_) cost += one;
  return cost;
}

template <int D>
Problem<D> Condensed<D>::core(const std::vector<Rigid<D>>& poses) const {
  Problem<D> made;
  for (const int pose : chains_.core) made.poses.push_back(poses[sz(pose)]);
  for (const int e : chains_.core_edges) {
    Edge<D> edge = problem_->edges[sz(e)];
    edge.from = core_of_[sz(edge.from)];
    edge.to = core_of_[sz(edge.to)];
    made.edges.push_back(edge);
  }
  for (std::size_t s = 0; s < chains_.size(); ++s) {
    Edge<D> edge;
    edge.from = core_of_[sz(chains_.begin[s])];
    edge.to = core_of_[sz(chains_.end(s))];
    made.edges.push_back(edge);
  }
  renew(made);
  return made;
}

template <int D>
void Condensed<D>::renew(Problem<D>& core) const {
  for (std::size_t s = 0; s < chains_.size(); ++s) {
    const Rigid<D>& end = at_[sz(chains_.first[s + 1]) - 1];
    Edge<D>& edge = core.edges[chains_.core_edges.size() + s];
    const Tangent<D> shift = boxFromTwist<D>(chain_sums_[s].shift, end.t);
    edge.Z = moved<D>(end, shift);
    TangentMatrix<D> P =
        turnedBy<D>(Rotation<D>(edge.Z.R.transpose()), shifted<D>(chain_sums_[s].covariance, end.t, 1.0));
    // The error of the edge at `end` is -shift, and its derivative there has J_l^-1: with it in the covariance too, the edge has
    // the chain's gradient and second derivative there, and so the same optimum.
    if constexpr (D == 3) {
      const Eigen::Vector3d e_r = -(end.R.transpose() * shift.template tail<3>());
      const Eigen::Matrix3d J = urban_nav_core::leftJacobianInverseSo3(e_r);
      P.template bottomRows<3>() = (J * P.template bottomRows<3>()).eval();
      P.template rightCols<3>() = (P.template rightCols<3>() * J.transpose()).eval();
    }
    edge.information = inverseOf<D>(P);
    edge.information = (0.5 * (edge.information + edge.information.transpose())).eval();
  }
}

template <int D>
void Condensed<D>::expand(const std::vector<Rigid<D>>& core_poses) {
  urban_nav_core::forEach(chains_.size(), kGrain, [&](std::size_t s) {
    const Rigid<D> wanted =
        core_poses[sz(core_of_[sz(chains_.begin[s])])].inverse() * core_poses[sz(core_of_[sz(chains_.end(s))])];
    const std::size_t last = sz(chains_.first[s + 1]) - 1;
    const Tangent<D> move = twistFromBox<D>(boxBetween<D>(wanted, at_[last]), at_[last].t);
    const Tangent<D> lambda =
        Eigen::LLT<TangentMatrix<D>>(chain_sums_[s].covariance).solve(move - chain_sums_[s].shift);
    // Each link turns by its share, and takes along what comes behind it.
    Rigid<D> before, old_before;
    for (std::size_t l = sz(chains_.first[s]); l <= last; ++l) {
      const Tangent<D> y = link_sums_[l].shift + link_sums_[l].covariance * lambda;
      const Rigid<D> step = old_before.inverse() * moved<D>(at_[l], boxFromTwist<D>(y, at_[l].t));
      old_before = at_[l];
      before = before * step;
      before.R = renormalised<D>(before.R);
      at_[l] = before;
    }
  });
}

template <int D>
double Condensed<D>::mismatch(const std::vector<Rigid<D>>& core_poses) const {
  double total = 0.0;
  for (std::size_t s = 0; s < chains_.size(); ++s) {
    const Rigid<D> wanted =
        core_poses[sz(core_of_[sz(chains_.begin[s])])].inverse() * core_poses[sz(core_of_[sz(chains_.end(s))])];
    const Rigid<D>& end = at_[sz(chains_.first[s + 1]) - 1];
    const Tangent<D> away = twistFromBox<D>(boxBetween<D>(wanted, end), end.t);
    total += away.dot(Eigen::LLT<TangentMatrix<D>>(chain_sums_[s].covariance).solve(away));
  }
  return total;
}

template <int D>
std::vector<Rigid<D>> Condensed<D>::assemble(const std::vector<Rigid<D>>& core_poses) const {
  std::vector<Rigid<D>> poses = problem_->poses;
  for (std::size_t c = 0; c < core_poses.size(); ++c) poses[sz(chains_.core[c])] = core_poses[c];
  for (std::size_t s = 0; s < chains_.size(); ++s) {
    const Rigid<D>& begin = poses[sz(chains_.begin[s])];
    for (std::size_t l = sz(chains_.first[s]); l + 1 < sz(chains_.first[s + 1]); ++l)
      poses[sz(chains_.links[l].pose)] = begin * at_[l];
  }
  for (const Chains::Twig& twig : chains_.twigs) poses[sz(twig.link.pose)] = poses[sz(twig.from)] * measured(twig.link);
  return poses;
}

template class Condensed<2>;
template class Condensed<3>;

}  // namespace pose_graph
