// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "support/drawn.hpp"

namespace pose_graph::test {

/// Kinds of constraints that hold a drawn graph in place.
enum class Held { Nothing, WherePosesAre, WhereOdometryDrifted, ByPriors };
inline constexpr Held kHeld[] = {Held::Nothing, Held::WherePosesAre, Held::WhereOdometryDrifted, Held::ByPriors};

/// A walk of 12 to 30 poses around blocks with one to five closures; the initial guess is dead reckoning. Odometry is
/// stiffer than the closures, and fixed poses differ from it by its drift.
template <int D>
Problem<D> drawHeld(Dice& dice, Held held, int count) {
  const int n = 12 + static_cast<int>(dice.below(19));
  const double metres = 0.01 * (1.0 + 9.0 * dice.uniform()), radians = 0.3 * metres;
  std::vector<Rigid<D>> truth(1);
  for (int i = 1; i < n; ++i) {
    Tangent<D> step = drawTangent<D>(dice, 0.05, 0.1);
    step[0] += 1.0;
    if (i % (n / 4) == 0) step[kTangentSize<D> - 1] += 1.5;
    truth.push_back(truth.back() * moved(Rigid<D>(), step));
  }
  Problem<D> result;
  const auto measure = [&](int from, const Rigid<D>& T_from, int to, double scale) {
    Edge<D> edge{from,
                 to,
                 moved(T_from.inverse() * truth[static_cast<std::size_t>(to)],
                       Tangent<D>(scale * drawTangent<D>(dice, metres, radians))),
                 {}};
    Tangent<D> weight = Tangent<D>::Constant(1.0 / (scale * scale * radians * radians));
    weight.template head<D>().setConstant(1.0 / (scale * scale * metres * metres));
    edge.information = weight.asDiagonal();
    result.edges.push_back(edge);
  };
  for (int i = 1; i < n; ++i) measure(i - 1, truth[static_cast<std::size_t>(i) - 1], i, 1.0);
  result.poses = truth;
  for (std::size_t i = 1; i < truth.size(); ++i) result.poses[i] = result.poses[i - 1] * result.edges[i - 1].Z;
  for (int closure = 1 + static_cast<int>(dice.below(5)); closure > 0; --closure) {
    const int from = static_cast<int>(dice.below(static_cast<std::size_t>(n - 4)));
    const int to = from + 4 + static_cast<int>(dice.below(static_cast<std::size_t>(n - from - 4)));
    measure(from, truth[static_cast<std::size_t>(from)], to, 0.5 + dice.uniform());
  }
  std::vector<int> some;
  while (static_cast<int>(some.size()) < count) {
    const int pose = static_cast<int>(dice.below(static_cast<std::size_t>(n)));
    if (std::find(some.begin(), some.end(), pose) == some.end()) some.push_back(pose);
  }
  std::sort(some.begin(), some.end());
  if (held == Held::ByPriors) {
    result.poses.emplace_back();
    result.fixed = {n};
    for (const int pose : some) {
      measure(n, {}, pose, 3.0);
      result.edges.back().lever = drawTangent<D>(dice, 0.5, 0.0).template head<D>();
      result.edges.back().Z.t += result.edges.back().Z.R * result.edges.back().lever;
    }
  } else if (held != Held::Nothing) {
    result.fixed = some;
    for (const int pose : some)
      if (held == Held::WherePosesAre)
        result.poses[static_cast<std::size_t>(pose)] = truth[static_cast<std::size_t>(pose)];
  }
  return result;
}

}  // namespace pose_graph::test
