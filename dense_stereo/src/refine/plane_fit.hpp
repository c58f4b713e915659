// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace dense_stereo {

/// Sums over a window of pixels that each contribute one equation, gradient (disparity + a u + b v) + brightness =
/// value, with u and v relative to the centre.
template <typename F>
struct PlaneSums {
  F gg, ggu, ggv, gguu, gguv, ggvv;  ///< of gradient^2
  F g, gu, gv;                       ///< of gradient
  F count;
  F gq, gqu, gqv;  ///< of gradient times value
  F q;             ///< of value
};

template <typename F>
struct PlaneFit {
  F disparity;    ///< at the centre
  F slope_u;      ///< px per column
  F slope_v;      ///< px per row
  F information;  ///< inverse variance of the disparity, in units of that of a value
};

inline float larger(float a, float b) { return a > b ? a : b; }

/// Least squares for disparity, a, b and brightness. `disparity_prior`: weight of a measurement of `prior_disparity` at
/// the centre. `slope_prior`: weight of zero slopes in px^2, relative to the sum of squared gradients; it keeps windows
/// with texture along one line solvable.
template <typename F>
PlaneFit<F> fitPlane(const PlaneSums<F>& s, F prior_disparity, F disparity_prior, F slope_prior, F tiny) {
  const F n = larger(s.count, tiny);
  const F mean_g = s.g / n, mean_gu = s.gu / n, mean_gv = s.gv / n;  // brightness is eliminated first
  const F prior = s.gg * slope_prior + tiny;
  const F uu = s.gguu - s.gu * mean_gu + prior, vv = s.ggvv - s.gv * mean_gv + prior, uv = s.gguv - s.gu * mean_gv;
  const F cu = s.ggu - s.g * mean_gu, cv = s.ggv - s.g * mean_gv;
  const F determinant = larger(uu * vv - uv * uv, tiny);
  const F ku = (vv * cu - uv * cv) / determinant, kv = (uu * cv - uv * cu) / determinant;
  const F cc = s.gg - s.g * mean_g;
  const F mc = s.gq - s.q * mean_g, mu = s.gqu - s.q * mean_gu, mv = s.gqv - s.q * mean_gv;
  const F information = larger(cc - ku * cu - kv * cv, tiny);
  const F moment = mc - ku * mu - kv * mv;
  const F disparity = (moment + disparity_prior * prior_disparity) / (information + disparity_prior);
  const F ru = mu - cu * disparity, rv = mv - cv * disparity;
  return {disparity, (vv * ru - uv * rv) / determinant, (uu * rv - uv * ru) / determinant, information};
}

}  // namespace dense_stereo
