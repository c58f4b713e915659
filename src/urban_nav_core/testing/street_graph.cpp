// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/street_graph.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "urban_nav_core/testing/dice.hpp"

namespace urban_nav_core::testing {

namespace {

using Eigen::Vector2d;

constexpr double kHillsApart = 150.0;  // m

constexpr std::array<std::array<int, 2>, 4> kDirections = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

Vector2d along(std::size_t direction) {
  return {static_cast<double>(kDirections[direction][0]), static_cast<double>(kDirections[direction][1])};
}
Vector2d turnLeft(const Vector2d& v) { return {-v.y(), v.x()}; }

/// Piece of the path: straight, or a quarter of a circle to the left (turn 1) or right (turn -1).
struct Piece {
  Vector2d start = Vector2d::Zero(), forward = Vector2d::UnitX();
  double length = 0.0;
  int turn = 0;
  std::size_t street = 0;  // of straight pieces between crossings
  bool betweenCrossings = false;
  bool upwards = true;  // in the direction of the street's distance
};

std::pair<Vector2d, Vector2d> placeAndHeading(const Piece& piece, double s) {
  if (piece.turn == 0) return {piece.start + s * piece.forward, piece.forward};
  const double radius = 2.0 * piece.length / M_PI, angle = s / radius;
  const Vector2d inward = static_cast<double>(piece.turn) * turnLeft(piece.forward);
  return {piece.start + radius * (std::sin(angle) * piece.forward + (1.0 - std::cos(angle)) * inward),
          std::cos(angle) * piece.forward + std::sin(angle) * inward};
}

/// Path through the town, piece by piece.
class Walk {
 public:
  Walk(int side, const StreetOptions& options, Dice& dice) : side_(side), options_(options), dice_(dice) {}

  std::size_t streets() const { return 2 * static_cast<std::size_t>(side_ * side_); }

  Piece next() {
    const double radius = options_.turn_radius_m;
    const Vector2d forward = along(direction_), lane = -options_.lane_m * turnLeft(forward);
    const Vector2d crossing = options_.block_m * Vector2d(x_, y_);
    Piece piece;
    piece.forward = forward;
    if (!atCrossing_) {  // along the street that leads away from the crossing
      piece.start = crossing + radius * forward + lane;
      piece.length = options_.block_m - 2.0 * radius;
      piece.betweenCrossings = true;
      const int toX = x_ + kDirections[direction_][0], toY = y_ + kDirections[direction_][1];
      piece.street = 2 * static_cast<std::size_t>(std::min(y_, toY) * side_ + std::min(x_, toX)) + direction_ % 2;
      piece.upwards = direction_ < 2;
      x_ = toX, y_ = toY;
    } else {
      piece.start = crossing - radius * forward + lane;
      const std::size_t way = choose();
      piece.turn = way == direction_ ? 0 : way == (direction_ + 1) % 4 ? 1 : -1;
      piece.length = piece.turn == 0 ? 2.0 * radius : 0.5 * M_PI * (radius + piece.turn * options_.lane_m);
      direction_ = way;
    }
    atCrossing_ = !atCrossing_;
    return piece;
  }

 private:
  /// Any direction except back.
  std::size_t choose() {
    while (true) {
      const std::size_t way = (direction_ + 3 + dice_.below(3)) % 4;
      const int x = x_ + kDirections[way][0], y = y_ + kDirections[way][1];
      if (x >= 0 && y >= 0 && x < side_ && y < side_) return way;
    }
  }

  int side_, x_ = 0, y_ = 0;
  std::size_t direction_ = 0;
  bool atCrossing_ = false;
  StreetOptions options_;
  Dice& dice_;
};

Pose onTheHills(const Vector2d& place, const Vector2d& heading, double height) {
  const double rate = 2.0 * M_PI / kHillsApart;
  const Vector2d slope(height * rate * std::cos(rate * place.x()), -height * rate * std::sin(rate * place.y()));
  const Vector3d forward = Vector3d(heading.x(), heading.y(), slope.dot(heading)).normalized();
  const Vector3d up = Vector3d(-slope.x(), -slope.y(), 1.0).normalized();
  Matrix3d R;
  R << forward, up.cross(forward), up;
  const double z = height * (std::sin(rate * place.x()) + std::cos(rate * place.y()));
  return {Quaterniond(R), Vector3d(place.x(), place.y(), z)};
}

using Pair = std::pair<std::size_t, std::size_t>;

/// Returns `count` of them, uniformly over subsets, in order of the later pose.
std::vector<Pair> pickSome(std::vector<Pair> pairs, std::size_t count, Dice& dice) {
  if (pairs.size() < count)
    throw std::invalid_argument("only " + std::to_string(pairs.size()) + " places are seen again, not " +
                                std::to_string(count));
  for (std::size_t i = 0; i < count; ++i) std::swap(pairs[i], pairs[i + dice.below(pairs.size() - i)]);
  pairs.resize(count);
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& l, const Pair& r) { return std::tie(l.second, l.first) < std::tie(r.second, r.first); });
  return pairs;
}

}  // namespace

GraphNoise streetNoise() {
  GraphNoise noise;
  noise.chain << 1e-3, 5e-4, 5e-4, 3e-4, 3e-4, 3e-4;
  noise.closure << Vector3d::Constant(0.05), Vector3d::Constant(0.01);
  return noise;
}

SimulatedGraph streetGraph(std::size_t poses, std::size_t closures, const GraphNoise& noise, std::uint64_t seed,
                           const StreetOptions& options) {
  Dice dice(seed);
  const double streets = static_cast<double>(poses) * options.step_m / (options.block_m * options.visits);
  const int side = std::max(3, static_cast<int>(std::ceil(0.5 + std::sqrt(0.25 + 0.5 * streets))));
  Walk walk(side, options, dice);

  SimulatedGraph graph;
  graph.truth.reserve(poses);
  const std::size_t metres = static_cast<std::size_t>(std::ceil(options.block_m));
  std::vector<std::vector<std::size_t>> visits(walk.streets() * metres);
  std::vector<Pair> again;
  double left = 0.0;  // m into the next piece
  while (graph.truth.size() < poses) {
    const Piece piece = walk.next();
    std::size_t lastMetre = metres;
    double s = left;
    for (; s < piece.length && graph.truth.size() < poses; s += options.step_m) {
      const auto [place, heading] = placeAndHeading(piece, s);
      const std::size_t here = graph.truth.size();
      graph.truth.push_back(onTheHills(place, heading, options.hill_m));
      if (!piece.betweenCrossings) continue;
      const std::size_t metre = static_cast<std::size_t>(piece.upwards ? s : piece.length - s);
      if (metre == lastMetre) continue;
      lastMetre = metre;
      std::vector<std::size_t>& visit = visits[piece.street * metres + metre];
      if (!visit.empty()) again.emplace_back(visit[dice.below(visit.size())], here);
      visit.push_back(here);
    }
    left = s - piece.length;
  }

  const std::vector<Pair> chosen = pickSome(std::move(again), closures, dice);
  graph.edges.reserve(poses + closures);
  for (std::size_t i = 0; i + 1 < poses; ++i) measure(graph, i, i + 1, GraphEdgeKind::Chain, noise, dice);
  for (const auto& [a, b] : chosen) measure(graph, a, b, GraphEdgeKind::Closure, noise, dice);
  return graph;
}

}  // namespace urban_nav_core::testing
