// SPDX-License-Identifier: BSD-3-Clause
#include "places.hpp"

#include <algorithm>
#include <cmath>

#include "distribution.hpp"

namespace urban_nav_sim::bench {

Neighbour findNeighbour(const Place& a, const Place& b) {
  const double apart = (a.position - b.position).norm();
  const bool turned = std::abs(std::remainder(a.heading - b.heading, 2.0 * M_PI)) > kSameHeading;
  if (turned || apart > kElsewhere) return Neighbour::Elsewhere;
  return apart <= kSamePlace ? Neighbour::Same : Neighbour::Near;
}

std::vector<double> wordWeights(const std::vector<Counts>& pictures) {
  std::vector<double> worth(pictures.empty() ? 0 : pictures.front().size(), 0.0);
  for (std::size_t word = 0; word < worth.size(); ++word) {
    const auto with = std::count_if(pictures.begin(), pictures.end(), [&](const Counts& c) { return c[word] > 0; });
    if (with > 0) worth[word] = std::log(static_cast<double>(pictures.size()) / static_cast<double>(with));
  }
  return worth;
}

double likeness(const Counts& a, const Counts& b, const std::vector<double>& worth) {
  double together = 0.0, a2 = 0.0, b2 = 0.0;
  for (std::size_t word = 0; word < worth.size(); ++word) {
    const double x = a[word] * worth[word], y = b[word] * worth[word];
    together += x * y, a2 += x * x, b2 += y * y;
  }
  return a2 > 0.0 && b2 > 0.0 ? together / std::sqrt(a2 * b2) : 0.0;
}

Recognition recognise(const std::vector<Place>& motion, const std::vector<double>& worth, double apart) {
  Recognition result;
  Values own, elsewhere;  // likenesses: of revisits to their places, of new places to what they are most like
  for (const Place& place : motion) {
    double best_same = -1.0, best_other = -1.0;
    for (const Place& before : motion) {
      if (before.along > place.along - apart) continue;
      const Neighbour neighbour = findNeighbour(place, before);
      if (neighbour == Neighbour::Near) continue;
      double& best = neighbour == Neighbour::Same ? best_same : best_other;
      best = std::max(best, likeness(place.words, before.words, worth));
    }
    if (best_same >= 0.0) {
      ++result.revisits;
      if (best_other > best_same) ++result.mistaken;
      own.push_back(best_same);
    } else if (best_other >= 0.0) {
      ++result.new_places;
      elsewhere.push_back(best_other);
    }
  }
  if (own.empty()) return result;
  const double usual = quantile(own, 0.5);
  result.taken_for_known =
      static_cast<int>(std::count_if(elsewhere.begin(), elsewhere.end(), [&](double l) { return l > usual; }));
  return result;
}

Neighbour nearestIn(const std::vector<Place>& map, const Place& place, const std::vector<double>& worth) {
  Neighbour nearest = Neighbour::Elsewhere;
  double best = -1.0;
  for (const Place& known : map) {
    if ((known.position - place.position).norm() < kSameSpot) continue;
    const double alike = likeness(place.words, known.words, worth);
    if (alike > best) best = alike, nearest = findNeighbour(place, known);
  }
  return nearest;
}

double shareLost(const Counts& before, const Counts& after) {
  int seen = 0, lost = 0;
  for (std::size_t word = 0; word < before.size(); ++word) {
    if (before[word] == 0) continue;
    ++seen;
    if (after[word] == 0) ++lost;
  }
  return seen > 0 ? static_cast<double>(lost) / seen : 0.0;
}

}  // namespace urban_nav_sim::bench
