// SPDX-License-Identifier: BSD-3-Clause
#include "gravity/tilt_drift.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "gravity/gravity_fit.hpp"
#include "gravity/spans.hpp"

namespace pose_graph {

using Eigen::Vector3d;
using urban_nav_core::secondsBetween;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;

namespace {

// State: error of gravity and accelerometer bias (m/s2), lever arm (m), tilt about two axes across gravity (rad).
constexpr int kStates = 11, kFault = 3, kTilt = 9;
using State = Eigen::Matrix<double, kStates, 1>;
using StateMatrix = Eigen::Matrix<double, kStates, kStates>;
using MeasurementMatrix = Eigen::Matrix<double, 3, kStates>;

constexpr std::size_t kLeastTiltSpans = 5;
constexpr double kUnknown = 1e3;    // in units of force noise: an uninformative prior
constexpr double kTiltPrior = 6.0;  // weight of the prior of a variance, in observations
// m/s2 per square root of a second: a bias within 0.02 m/s2 over ten minutes (XSens MTi).
constexpr double kFaultWalk = 1e-3;
constexpr double kTiltHuber = 1.345;  // Huber 1964
constexpr double kShock = 6.0;        // in standard deviations: above the range of drift
constexpr double kMiddle = 0.888;     // median of the root mean square of three standard normal variables
constexpr int kTiltRounds = 3;        // iterations of the weights
constexpr double kMostTurn = 0.3;     // rad: small-angle approximation valid to 1.5 %

/// Measurement of a span for the filter.
struct Measurement {
  StampNs stamp = 0;
  double seconds = 0.0;  ///< since the previous one
  double growth = 0.0;   ///< increase of odometry's variance since the previous one, rad2
  Vector3d force;        ///< minus gravity, m/s2
  MeasurementMatrix H;
};

/// Variances of the random walks in units of the force noise, as logarithms: factor of odometry's variance, and bias
/// variance per second.
struct Walks {
  double tilt = 0.0, fault = 0.0;
};

struct FilterState {
  State x, x_predicted;
  StateMatrix P, P_predicted;
};

struct Filtered {
  std::vector<FilterState> states;
  std::vector<double> innovations;  ///< normalised by their standard deviation
  double noise2 = 1.0;              ///< variance of a force, (m/s2)^2
  double cost = 0.0;                ///< -2 log likelihood
};

/// Returns -2 log of the prior of a variance with the weight of kTiltPrior observations; `ratio`: relative to its
/// expected value.
double priorCost(double ratio) { return kTiltPrior * (std::log(ratio) + 1.0 / ratio); }

/// Covariances are in units of the force noise, which is estimated at the end.
Filtered filter(const std::vector<Measurement>& measurements, const std::vector<double>& weights, const Walks& walks,
                bool cost_alone) {
  Filtered made;
  const double tilt = std::exp(walks.tilt), fault = std::exp(walks.fault);
  State x = State::Zero();
  StateMatrix P = StateMatrix::Zero();
  P.diagonal().head<kTilt>().setConstant(kUnknown * kUnknown);
  double sum = 0.0, log_volume = 0.0;
  for (std::size_t k = 0; k < measurements.size(); ++k) {
    const Measurement& measurement = measurements[k];
    P.diagonal().segment<3>(kFault).array() += fault * measurement.seconds;
    P.diagonal().tail<2>().array() += tilt * measurement.growth;
    if (!cost_alone) made.states.push_back({x, x, P, P});
    const Eigen::Matrix<double, kStates, 3> PH = P * measurement.H.transpose();
    const Eigen::Matrix3d S = measurement.H * PH + Eigen::Matrix3d::Identity() / weights[k];
    const Eigen::LLT<Eigen::Matrix3d> llt(S);
    const Vector3d innovation = measurement.force - measurement.H * x, whitened = llt.matrixL().solve(innovation);
    x += PH * llt.solve(innovation);
    P -= PH * llt.solve(PH.transpose());
    P = (0.5 * (P + P.transpose())).eval();
    sum += whitened.squaredNorm();
    for (int i = 0; i < 3; ++i) log_volume += 2.0 * std::log(llt.matrixLLT()(i, i));
    if (cost_alone) continue;
    made.states.back().x = x;
    made.states.back().P = P;
    made.innovations.push_back(whitened.norm() / std::sqrt(3.0));
  }
  const double numbers = 3.0 * static_cast<double>(measurements.size());
  made.noise2 = std::max(sum / numbers, 1e-12);
  made.cost = log_volume + numbers * std::log(made.noise2) + priorCost(tilt * made.noise2) +
              priorCost(fault * made.noise2 / (kFaultWalk * kFaultWalk));
  if (!std::isfinite(made.cost)) made.cost = std::numeric_limits<double>::infinity();
  return made;
}

/// Returns the most likely walks: coordinate search with decreasing steps.
Walks likeliest(const std::vector<Measurement>& measurements, const std::vector<double>& weights, Walks best,
                double step) {
  const auto costAt = [&](const Walks& walks) { return filter(measurements, weights, walks, true).cost; };
  double best_cost = costAt(best);
  for (; step > 0.1; step *= 0.5)
    for (double Walks::*which : {&Walks::tilt, &Walks::fault})
      for (const double sign : {1.0, -1.0}) {
        bool better = false;
        for (int i = 0; i < 10; ++i) {
          Walks tried = best;
          tried.*which += sign * step;
          const double cost = costAt(tried);
          if (!(cost < best_cost)) break;
          best = tried;
          best_cost = cost;
          better = true;
        }
        if (better) break;
      }
  return best;
}

/// Weights down shocks, which would disturb all later states.
std::vector<double> measureCalm(const std::vector<Span>& spans, const GravityFit& fit) {
  std::vector<double> made;
  for (const Span& span : spans) {
    const double size = fit.residual(span).norm() / (kShock * fit.scatter);
    made.push_back(size <= 1.0 ? 1.0 : 1.0 / (size * size));
  }
  return made;
}

/// Returns Huber weights for innovations obtained with `weights`.
std::vector<double> weightsFor(std::vector<double> innovations, const std::vector<double>& weights) {
  // Normalised to full weight.
  for (std::size_t k = 0; k < weights.size(); ++k) innovations[k] /= std::sqrt(weights[k]);
  std::vector<double> sorted = innovations;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double usual = std::max(*middle / kMiddle, 1e-12);
  std::vector<double> made;
  for (const double innovation : innovations) made.push_back(1.0 / std::max(1.0, innovation / (kTiltHuber * usual)));
  return made;
}

/// Returns the smoothed states (Rauch, Tung and Striebel 1965).
std::vector<State> smoothed(const std::vector<FilterState>& states) {
  std::vector<State> made(states.size());
  made.back() = states.back().x;
  for (std::size_t k = states.size() - 1; k-- > 0;) {
    const StateMatrix gain = states[k + 1].P_predicted.ldlt().solve(states[k].P).transpose();
    made[k] = states[k].x + gain * (made[k + 1] - states[k + 1].x_predicted);
  }
  return made;
}

std::vector<Measurement> collectMeasurements(const std::vector<Span>& spans, const Trajectory& odometry,
                                             const std::vector<double>& variance, const Vector3d& gravity,
                                             const Eigen::Matrix<double, 3, 2>& across) {
  std::vector<Measurement> made;
  double before = 0.0;
  StampNs last = odometry.front().stamp;
  for (const Span& span : spans) {
    Measurement measurement;
    measurement.stamp = span.begin + (span.end - span.begin) / 2;
    measurement.seconds = secondsBetween(last, measurement.stamp);
    last = measurement.stamp;
    const double now = variance[odometry.nearest(measurement.stamp)];
    measurement.growth = now - before;
    before = now;
    measurement.force = span.force - gravity;
    measurement.H << Eigen::Matrix3d::Identity(), span.rotation, span.lever, urban_nav_core::skew(gravity) * across;
    made.push_back(measurement);
  }
  return made;
}

}  // namespace

std::vector<Tilt> tiltDrift(const Trajectory& odometry, const std::vector<double>& variance,
                            const std::vector<SpecificForce>& forces) {
  const Level level = estimateLevel(odometry, forces);
  if (!level.known()) return {};
  const std::vector<Span> spans = makeSpans(odometry, forces, odometry.front().pose);
  if (spans.size() < kLeastTiltSpans) return {};
  Eigen::Matrix<double, 3, 2> across;
  across.col(0) = level.up.unitOrthogonal();
  across.col(1) = level.up.cross(across.col(0));
  const std::vector<Measurement> measurements =
      collectMeasurements(spans, odometry, variance, level.gravity * level.up, across);
  const std::optional<GravityFit> fit = fitGravity(spans);
  if (!fit) return {};
  const std::vector<double> calm = measureCalm(spans, *fit);
  std::vector<double> weights = calm;
  // Initial values: force noise 0.01 m/s2, odometry as stated, bias as in the data sheet.
  Walks walks{std::log(1e4), std::log(1e4 * kFaultWalk * kFaultWalk)};
  Filtered filtered;
  for (int round = 0; round < kTiltRounds; ++round) {
    walks = likeliest(measurements, weights, walks, round == 0 ? 2.0 : 0.5);
    filtered = filter(measurements, weights, walks, false);
    if (!std::isfinite(filtered.cost)) return {};
    weights = weightsFor(filtered.innovations, weights);
    std::transform(weights.begin(), weights.end(), calm.begin(), weights.begin(), std::multiplies<double>());
  }
  std::vector<Tilt> made;
  const std::vector<State> states = smoothed(filtered.states);
  for (std::size_t k = 0; k < measurements.size(); ++k) {
    made.push_back({measurements[k].stamp, across * states[k].tail<2>()});
    if (!(made.back().turn.norm() < kMostTurn)) return {};
  }
  return made;
}

Vector3d tiltAt(const std::vector<Tilt>& tilts, StampNs first, StampNs stamp) {
  const auto after =
      std::lower_bound(tilts.begin(), tilts.end(), stamp, [](const Tilt& tilt, StampNs at) { return tilt.stamp < at; });
  if (tilts.empty() || stamp <= first) return Vector3d::Zero();
  if (after == tilts.end()) return tilts.back().turn;
  const Tilt before = after == tilts.begin() ? Tilt{first, Vector3d::Zero()} : *(after - 1);
  const double part = secondsBetween(before.stamp, stamp) / secondsBetween(before.stamp, after->stamp);
  return before.turn + part * (after->turn - before.turn);
}

}  // namespace pose_graph
