// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace urban_nav_sim::bench {

/// Number of occurrences of each visual word in a picture.
using Counts = std::vector<int>;

/// A picture and its pose on a motion.
struct Place {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m
  double heading = 0.0;                                ///< rad
  double along = 0.0;                                  ///< m driven so far
  Counts words;
};

/// Largest distance and angle of two pictures of the same place; beyond kElsewhere they are of different places,
/// between both they are not counted.
constexpr double kSamePlace = 5.0, kElsewhere = 10.0;  ///< m
constexpr double kSameHeading = 0.8;                   ///< rad
enum class Neighbour { Same, Near, Elsewhere };
Neighbour findNeighbour(const Place& a, const Place& b);

/// Returns the inverse document frequency of each word (Sivic and Zisserman 2003); 0 for a word in no picture.
std::vector<double> wordWeights(const std::vector<Counts>& pictures);

/// Returns the cosine similarity, 0 ... 1, of the weighted counts; 0 if one has only words of weight 0.
double likeness(const Counts& a, const Counts& b, const std::vector<double>& worth);

/// Statistics of nearest neighbours among the places at least `apart` m of driving earlier.
struct Recognition {
  int revisits = 0;         ///< places visited before
  int mistaken = 0;         ///< ... whose nearest neighbour is elsewhere
  int new_places = 0;       ///< the others
  int taken_for_known = 0;  ///< ... more similar to another place than the median revisit to its place
};
Recognition recognise(const std::vector<Place>& motion, const std::vector<double>& worth, double apart);

/// Classifies the most similar picture of a map. Excludes pictures within kSameSpot, which another motion rarely has.
constexpr double kSameSpot = 1.0;  ///< m
Neighbour nearestIn(const std::vector<Place>& map, const Place& place, const std::vector<double>& worth);

/// Returns the share of the words of one picture that is not in another; 0 without words.
double shareLost(const Counts& before, const Counts& after);

}  // namespace urban_nav_sim::bench
