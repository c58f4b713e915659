// SPDX-License-Identifier: BSD-3-Clause
#include "proprioception/random_walk.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace urban_nav_sim {
namespace {

// x(k + 1) = keep x(k) + push n(k)
std::vector<Eigen::Vector3d> drawNodes(double start_sigma, double keep, double push, double duration,
                                       const Noise& noise) {
  const auto count = static_cast<std::size_t>(std::ceil(std::max(duration, 0.0))) + 2;
  std::vector<Eigen::Vector3d> nodes{start_sigma * noise.normal3(0)};
  nodes.reserve(count);
  for (std::size_t k = 1; k < count; ++k) nodes.push_back(keep * nodes.back() + push * noise.normal3(k));
  return nodes;
}

}  // namespace

RandomWalk::RandomWalk(std::vector<Eigen::Vector3d> nodes) : nodes_(std::move(nodes)) {}

RandomWalk RandomWalk::free(double start_sigma, double walk, double duration, const Noise& noise) {
  return RandomWalk(drawNodes(start_sigma, 1.0, walk, duration, noise));
}

RandomWalk RandomWalk::drawnBack(double sigma, double time_constant, double duration, const Noise& noise) {
  const double keep = std::exp(-1.0 / time_constant);
  return RandomWalk(drawNodes(sigma, keep, sigma * std::sqrt(1.0 - keep * keep), duration, noise));
}

Eigen::Vector3d RandomWalk::at(double t) const {
  const double place = std::clamp(t, 0.0, static_cast<double>(nodes_.size() - 1));
  const auto node = std::min(static_cast<std::size_t>(place), nodes_.size() - 2);
  const double f = place - static_cast<double>(node);
  return (1.0 - f) * nodes_[node] + f * nodes_[node + 1];
}

}  // namespace urban_nav_sim
