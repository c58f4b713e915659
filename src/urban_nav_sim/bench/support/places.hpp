// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace urban_nav_sim::bench {

/// How often each visual word is in a picture.
using Counts = std::vector<int>;

/// A picture, and where on a motion it was taken.
struct Place {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m
  double heading = 0.0;                                ///< rad
  double along = 0.0;                                  ///< m driven so far
  Counts words;
};

/// Two pictures are of one place if they were taken at most so far apart, in about the same direction; beyond
/// kElsewhere they are not, and what lies between counts as neither.
constexpr double kSamePlace = 5.0, kElsewhere = 10.0;  ///< m
constexpr double kSameHeading = 0.8;                   ///< rad
enum class Neighbour { Same, Near, Elsewhere };
Neighbour findNeighbour(const Place& a, const Place& b);

/// Of each word the logarithm of the share of pictures that have it, negated (Sivic and Zisserman 2003). A word in none
/// is worth nothing.
std::vector<double> wordWeights(const std::vector<Counts>& pictures);

/// 0 ... 1: cosine between the counts, each times the worth of its word. 0 if one has no word of worth.
double likeness(const Counts& a, const Counts& b, const std::vector<double>& worth);

/// What a nearest neighbour among the places that lie at least `apart` m of driving back says of a motion.
struct Recognition {
  int revisits = 0;    ///< places at which the robot has been before
  int mistaken = 0;    ///< ... whose nearest neighbour is elsewhere
  int new_places = 0;  ///< the others
  int taken_for_known =
      0;  ///< ... more like a place elsewhere than the middle one of the revisits is like its own place
};
Recognition recognise(const std::vector<Place>& motion, const std::vector<double>& worth, double apart);

/// Where the most alike picture of a map is from. Pictures from within kSameSpot are left out: another motion seldom
/// has them.
constexpr double kSameSpot = 1.0;  ///< m
Neighbour nearestIn(const std::vector<Place>& map, const Place& place, const std::vector<double>& worth);

/// Of the words in one picture the share that is not in another. 0 if there are none.
double shareLost(const Counts& before, const Counts& after);

}  // namespace urban_nav_sim::bench
