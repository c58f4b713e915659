// SPDX-License-Identifier: BSD-3-Clause
#include "semidefinite/lifted_poses.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "linear/index.hpp"
#include "manifold/rotation.hpp"
#include "semidefinite/quadratic_form.hpp"
#include "urban_nav_core/geometry/dense.hpp"

namespace pose_graph {

namespace {

constexpr int kSideBySide = 8;  // dimensions; as many as BlockCholesky::solveEight() has right-hand sides
// Noise on each number of the initial value: small enough to keep the rotations, and it excites all dimensions.
constexpr double kNoise = 0.3;
constexpr int kLiftedSteps = 60, kInner = 60;
constexpr double kEnoughOfCost = 1e-5;  // convergence: predicted decrease relative to the cost
constexpr double kForcing = 0.1;        // relative to the gradient: accuracy of the inner solution

using Numbers = std::vector<double>;  // X^T by places: D + 1 rows of kSideBySide numbers each

double dot(const Numbers& a, const Numbers& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

void add(Numbers& a, double factor, const Numbers& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += factor * b[i];
}

template <int D>
class Lifted {
  static constexpr int kB = D + 1;
  using Rows = Eigen::Matrix<double, D, kSideBySide, Eigen::RowMajor>;
  using All = Eigen::Matrix<double, kB, kSideBySide, Eigen::RowMajor>;

 public:
  Lifted(const QuadraticForm<D>& form, Numbers x)
      : form_(form), x_(std::move(x)), lambda_(form.symbolic.node.size()), preconditioner_(form.symbolic) {
    cost_ = renew();
  }

  /// Factors the preconditioner, with the mean curvature of the multipliers: f = sum tr(Lambda_i).
  bool prepare() {
    BlockMatrix<kB> A = form_.M;
    const double mean = cost_ / (D * static_cast<double>(A.diagonal.size()));
    for (auto& block : A.diagonal) block.template bottomRightCorner<D, D>().diagonal().array() += mean;
    form_.hold(A, 1.0);
    return std::isfinite(cost_) && preconditioner_.factor(A, form_.pattern);
  }

  double cost() const { return cost_; }
  const Numbers& x() const { return x_; }

  /// Makes one step. Returns false if no significant step is left.
  bool step() {
    double predicted = 0.0;
    const Numbers s = truncated(predicted);
    if (!(predicted > kEnoughOfCost * cost_)) return false;
    Numbers kept = x_;
    const double before = cost_;
    add(x_, 1.0, s);
    retract();
    const double after = renew();
    const double ratio = (before - after) / predicted;
    if (ratio < 0.25 || !std::isfinite(after)) radius_ *= 0.25;
    else if (ratio > 0.75 && at_rim_) radius_ *= 2.0;
    if (ratio > 0.05 && std::isfinite(after)) return true;
    x_.swap(kept);
    renew();
    return radius_ > 1e-12;
  }

 private:
  Eigen::Map<Rows> rows(Numbers& v, std::size_t k) const {
    return Eigen::Map<Rows>(v.data() + (k * kB + 1) * kSideBySide);
  }
  Eigen::Map<const Rows> rows(const Numbers& v, std::size_t k) const {
    return Eigen::Map<const Rows>(v.data() + (k * kB + 1) * kSideBySide);
  }

  void multiply(const Numbers& v, Numbers& made) const {
    made.resize(v.size());
    const auto part = [&](std::size_t k) { return Eigen::Map<const All>(v.data() + k * kB * kSideBySide); };
    const auto target = [&](std::size_t k) { return Eigen::Map<All>(made.data() + k * kB * kSideBySide); };
    for (std::size_t k = 0; k < lambda_.size(); ++k) target(k).noalias() = form_.M.diagonal[k] * part(k);
    for (std::size_t k = 0; k < lambda_.size(); ++k)
      for (int e = form_.pattern.first[k]; e < form_.pattern.first[k + 1]; ++e) {
        const std::size_t row = sz(form_.pattern.row[sz(e)]);
        target(row).noalias() += form_.M.lower[sz(e)] * part(k);
        target(k).noalias() += form_.M.lower[sz(e)].transpose() * part(row);
      }
  }

  /// Projects v onto the tangent space at x.
  void project(Numbers& v) const {
    for (std::size_t k = 0; k < lambda_.size(); ++k) {
      if (form_.holdsTranslation(static_cast<int>(k)))
        for (int c = 0; c < kSideBySide; ++c) v[k * kB * kSideBySide + sz(c)] = 0.0;
      if (form_.isFixed(static_cast<int>(k))) std::fill_n(v.data() + k * kB * kSideBySide, kB * kSideBySide, 0.0);
      const Eigen::Matrix<double, D, D> across = rows(v, k) * rows(x_, k).transpose();
      rows(v, k) -= (0.5 * (across + across.transpose())).eval() * rows(x_, k);
    }
  }

  double renew() {
    multiply(x_, gradient_);
    cost_ = dot(x_, gradient_);
    for (std::size_t k = 0; k < lambda_.size(); ++k) {
      const Eigen::Matrix<double, D, D> across = rows(gradient_, k) * rows(x_, k).transpose();
      lambda_[k] = 0.5 * (across + across.transpose());
    }
    project(gradient_);
    return cost_;
  }

  /// Computes half of the Hessian times v, as gradient_ is half of the gradient.
  void hessian(const Numbers& v, Numbers& made) const {
    multiply(v, made);
    for (std::size_t k = 0; k < lambda_.size(); ++k) rows(made, k) -= lambda_[k] * rows(v, k);
    project(made);
  }

  Numbers preconditioned(const Numbers& v) const {
    Numbers made = v;
    preconditioner_.solveEight(made.data());
    project(made);
    return made;
  }

  void retract() {
    for (std::size_t k = 0; k < lambda_.size(); ++k) {
      auto Y = rows(x_, k);
      for (int a = 0; a < D; ++a) {
        for (int b = 0; b < a; ++b) Y.row(a) -= Y.row(a).dot(Y.row(b)) * Y.row(b);
        Y.row(a).normalize();
      }
    }
  }

  /// Steihaug's truncated conjugate gradients, with lengths in the norm of the preconditioner.
  Numbers truncated(double& predicted) {
    Numbers s(x_.size(), 0.0), r = gradient_, z = preconditioned(r), d = z, Hd;
    for (double& value : d) value = -value;
    double rz = dot(r, z), ss = 0.0, sd = 0.0, dd = rz;
    if (radius_ <= 0.0) radius_ = std::sqrt(rz);
    const double enough = kForcing * kForcing * rz;
    at_rim_ = false;
    predicted = 0.0;
    for (int i = 0; i < kInner && rz > 0.0; ++i) {
      hessian(d, Hd);
      const double curvature = dot(d, Hd), step = rz / curvature;
      if (!(curvature > 0.0) || ss + 2.0 * step * sd + step * step * dd >= radius_ * radius_) {
        const double rim = (-sd + std::sqrt(sd * sd + dd * (radius_ * radius_ - ss))) / dd;
        predicted += 2.0 * rim * rz - rim * rim * curvature;
        add(s, rim, d);
        at_rim_ = true;
        break;
      }
      predicted += step * rz;
      add(s, step, d);
      add(r, step, Hd);
      ss += 2.0 * step * sd + step * step * dd;
      z = preconditioned(r);
      const double next = dot(r, z);
      if (next <= enough) break;
      const double beta = next / rz;
      for (std::size_t k = 0; k < d.size(); ++k) d[k] = beta * d[k] - z[k];
      sd = beta * (sd + step * dd);
      dd = next + beta * beta * dd;
      rz = next;
    }
    return s;
  }

  const QuadraticForm<D>& form_;
  Numbers x_, gradient_;
  std::vector<Eigen::Matrix<double, D, D>> lambda_;
  BlockCholesky<kB> preconditioner_;
  double cost_ = 0.0, radius_ = 0.0;
  bool at_rim_ = false;
};

template <int D>
Numbers lift(const QuadraticForm<D>& form, const std::vector<Rigid<D>>& poses) {
  std::mt19937_64 sequence;  // NOLINT(cert-msc51-cpp): the same numbers each time
  Numbers x(poses.size() * (D + 1) * kSideBySide, 0.0);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    double* at = x.data() + sz(form.symbolic.place[i]) * (D + 1) * kSideBySide;
    const double noise = form.isFixed(form.symbolic.place[i]) ? 0.0 : kNoise;
    for (int d = 0; d < D; ++d) at[d] = poses[i].t[d];
    for (int a = 0; a < D; ++a)
      for (int c = 0; c < kSideBySide; ++c) {
        const double uniform = 2.0 * std::ldexp(static_cast<double>(sequence() >> 11U), -53) - 1.0;
        at[(a + 1) * kSideBySide + c] = (c < D ? poses[i].R(c, a) : 0.0) + noise * uniform;
      }
    for (int a = 1; a <= D; ++a) {
      Eigen::Map<Eigen::Matrix<double, kSideBySide, 1>> row(at + a * kSideBySide);
      for (int b = 1; b < a; ++b) {
        const Eigen::Map<const Eigen::Matrix<double, kSideBySide, 1>> other(at + b * kSideBySide);
        row -= row.dot(other) * other;
      }
      row.normalize();
    }
  }
  return x;
}

/// Projects each component separately, as each has its own D dimensions. A component with fixed poses has theirs.
template <int D>
std::optional<std::vector<Rigid<D>>> projectedPoses(const QuadraticForm<D>& form, const Numbers& x,
                                                    const std::vector<Rigid<D>>& start, const std::vector<int>& fixed) {
  using Wide = Eigen::Matrix<double, kSideBySide, kSideBySide>;
  using Block = Eigen::Matrix<double, D + 1, kSideBySide, Eigen::RowMajor>;
  const auto block = [&](std::size_t i) {
    return Eigen::Map<const Block>(x.data() + sz(form.symbolic.place[i]) * (D + 1) * kSideBySide);
  };
  std::vector<Wide> sums(sz(form.unknowns.components), Wide::Zero());
  for (std::size_t i = 0; i < start.size(); ++i)
    sums[sz(form.unknowns.component[i])] +=
        block(i).template bottomRows<D>().transpose() * block(i).template bottomRows<D>();
  std::vector<Eigen::Matrix<double, kSideBySide, D>> kept(sums.size());
  for (std::size_t c = 0; c < sums.size(); ++c) {
    const auto eigen = urban_nav_core::symmetricEigen(sums[c]);
    if (!eigen) return std::nullopt;
    kept[c] = eigen->vectors.template rightCols<D>();
  }
  const int anchored = fixed.empty() ? -1 : form.unknowns.component[sz(fixed.front())];
  if (anchored >= 0) kept[sz(anchored)].setIdentity();
  const auto flat = [&](std::size_t i) -> Rotation<D> {
    return (block(i).template bottomRows<D>() * kept[sz(form.unknowns.component[i])]).transpose();
  };
  std::vector<int> hands(sums.size(), 0);
  for (std::size_t i = 0; i < start.size(); ++i)
    hands[sz(form.unknowns.component[i])] += flat(i).determinant() < 0.0 ? -1 : 1;
  for (std::size_t c = 0; c < hands.size(); ++c)
    if (hands[c] < 0 && static_cast<int>(c) != anchored) kept[c].col(0) *= -1.0;
  std::vector<Rigid<D>> made(start.size());
  std::vector<Rigid<D>> moved(sums.size());
  for (std::size_t i = 0; i < start.size(); ++i) {
    made[i].R = nearestRotation(flat(i));
    made[i].t = (block(i).row(0) * kept[sz(form.unknowns.component[i])]).transpose();
  }
  for (const int origin : form.unknowns.origin)
    moved[sz(form.unknowns.component[sz(origin)])] = start[sz(origin)] * made[sz(origin)].inverse();
  if (anchored >= 0) moved[sz(anchored)] = {};
  for (std::size_t i = 0; i < start.size(); ++i) {
    made[i] = moved[sz(form.unknowns.component[i])] * made[i];
    if (form.unknowns.of_pose[i] < 0) made[i] = start[i];
    if (!made[i].R.allFinite() || !made[i].t.allFinite()) return std::nullopt;
  }
  return made;
}

}  // namespace

template <int D>
std::optional<std::vector<Rigid<D>>> liftedPoses(const Problem<D>& problem, const std::vector<Rigid<D>>& start,
                                                 const std::vector<double>& weights) {
  const QuadraticForm<D> form(problem, weights);
  Lifted<D> lifted(form, lift<D>(form, start));
  if (!lifted.prepare()) return std::nullopt;
  for (int i = 0; i < kLiftedSteps && lifted.step(); ++i) {
  }
  return projectedPoses<D>(form, lifted.x(), start, problem.fixed);
}

template std::optional<std::vector<Rigid<2>>> liftedPoses(const Problem<2>&, const std::vector<Rigid<2>>&,
                                                          const std::vector<double>&);
template std::optional<std::vector<Rigid<3>>> liftedPoses(const Problem<3>&, const std::vector<Rigid<3>>&,
                                                          const std::vector<double>&);

}  // namespace pose_graph
