// SPDX-License-Identifier: BSD-3-Clause
#include "robust/information_scale.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pose_graph {

namespace {

constexpr std::size_t kLoops = 500;  // looked at: the factor of so many is good to some hundredths
constexpr int kScaleSteps = 20;
// False closures that were found in a row err alike, and nearly agree: loops whose deviations are at least five times
// those of true ones are taken for theirs.
constexpr double kLoose = 25.0;
constexpr double kLeastScaleShare = 1e-3;
constexpr double kScalePrior = 1.0;  // loops of unit variance
constexpr double kToDoubt = 30.0;    // so many true ones it takes to say that information boasts

// A mixture of loops of true closures, of false ones that agree with each other more or less, and of others.
struct Mixture {
  double factor = 1.0, loose = kLoose;  // of the variances of the first two kinds
  double shares[3] = {0.5, 0.25, 0.25};
  double true_loops = 0.0;
  double log_likelihood = -std::numeric_limits<double>::infinity();
};

// `rows`: whether false ones may agree with each other; else all of them are anywhere.
Mixture mixtureFrom(const std::vector<ClosureLoop>& loops, int dof, double factor, bool rows) {
  Mixture made;
  if (!rows) made.shares[1] = 0.0;
  made.factor = factor;
  made.loose = kLoose * factor;
  for (int i = 0; i < kScaleSteps; ++i) {
    double squares[2] = {kScalePrior * dof, kScalePrior * dof * made.loose},
           numbers[2] = {kScalePrior * dof, kScalePrior * dof};
    double sum[3] = {0.0, 0.0, 0.0};
    made.log_likelihood = 0.0;
    for (const ClosureLoop& loop : loops) {
      const double factors[2] = {made.factor, made.loose};
      double logs[3], most = logs[2] = std::log(made.shares[2]) + loop.log_false;
      for (int k = 0; k < 2; ++k) {
        logs[k] =
            std::log(made.shares[k]) + loop.log_true - 0.5 * dof * std::log(factors[k]) - 0.5 * loop.chi2 / factors[k];
        most = std::max(most, logs[k]);
      }
      double total = 0.0;
      for (double& log : logs) total += log = std::exp(log - most);
      made.log_likelihood += most + std::log(total);
      for (int k = 0; k < 3; ++k) sum[k] += logs[k] / total;
      for (int k = 0; k < 2; ++k) {
        squares[k] += logs[k] / total * loop.chi2;
        numbers[k] += logs[k] / total * dof;
      }
    }
    made.true_loops = sum[0];
    made.factor = squares[0] / numbers[0];
    made.loose = std::max(squares[1] / numbers[1], kLoose * made.factor);
    for (int k = 0; k < 3; ++k)
      if (made.shares[k] > 0.0) made.shares[k] = std::max(kLeastScaleShare, sum[k] / static_cast<double>(loops.size()));
  }
  return made;
}

// From where it begins decides where it ends: from few that fit well, from the middle one, and from what is stated.
Mixture likeliest(const std::vector<ClosureLoop>& loops, int dof, bool rows) {
  std::vector<double> chi2;
  for (const ClosureLoop& loop : loops) chi2.push_back(loop.chi2);
  std::sort(chi2.begin(), chi2.end());
  Mixture best;
  for (const double begin : {chi2[chi2.size() / 4] / dof, chi2[chi2.size() / 2] / dof, 1.0}) {
    const Mixture one = mixtureFrom(loops, dof, std::max(begin, 1e-12), rows);
    if (one.log_likelihood > best.log_likelihood) best = one;
  }
  return best;
}

}  // namespace

template <int D>
InformationScale informationScale(const ClosureLoops<D>& closures) {
  constexpr int kDof = kTangentSize<D>;
  std::vector<ClosureLoop> loops;
  const std::size_t step = 1 + closures.size() / kLoops;
  for (std::size_t a = 0; a < closures.size(); a += step)
    closures.partners(a, 1, [&](std::size_t b) {
      const ClosureLoop loop = closures.loop(a, b);
      if (std::isfinite(loop.chi2) && std::isfinite(loop.log_true)) loops.push_back(loop);
    });
  if (loops.empty()) return {};
  const Mixture plain = likeliest(loops, kDof, false);
  InformationScale made{plain.factor, plain.true_loops, plain.shares[0]};
  // Where false closures that agree with each other outnumber the true ones, theirs is the likelier spread: that
  // information boasts must be so beside them too.
  if (made.factor > 1.0)
    made.factor = plain.true_loops < kToDoubt ? 1.0 : std::max(1.0, likeliest(loops, kDof, true).factor);
  return made;
}

template InformationScale informationScale<2>(const ClosureLoops<2>&);
template InformationScale informationScale<3>(const ClosureLoops<3>&);

}  // namespace pose_graph
