// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/robust.hpp"

namespace pose_graph {

/// A step of odometry that the other edges contradict, and what they say in its place.
template <int D>
struct Slip {
  int edge = 0;
  Rigid<D> T_from_to;
};

/// Steps of odometry that are likely false: all edges are relaxed under Cauchy's kernel, from where odometry puts the
/// poses, and a step that ends far outside its covariance, and much farther than others do, has slipped. Which of
/// several it was, where the same closures span them, is for their measurements to tell: the one that is like no other
/// step. Steps that no closure spans cannot be refuted.
template <int D>
std::vector<Slip<D>> findSlips(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                               const std::vector<Rigid<D>>& odometry);

extern template std::vector<Slip<2>> findSlips<2>(const Problem<2>&, const std::vector<EdgeRole>&,
                                                  const std::vector<Rigid<2>>&);
extern template std::vector<Slip<3>> findSlips<3>(const Problem<3>&, const std::vector<EdgeRole>&,
                                                  const std::vector<Rigid<3>>&);

}  // namespace pose_graph
