// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace fabmap_node {

/// Two observations that geometry found to show one place.
struct ConfirmedPair {
  std::size_t a = 0, b = 0;  ///< numbers of observations, a < b
  double metres = 0.0;       ///< between their positions
};

/// Observations of one place on several occasions: its appearances. A place has the number of its first observation. It
/// takes in an observation that geometry confirms within 3 m of the first one, up to eight that differ most: of more,
/// the later one of the two most similar is forgotten, so memory is bounded by area. Not thread-safe; const
/// functions are.
class PlaceGroups {
 public:
  static constexpr std::size_t kMostAppearances = 8;
  static constexpr double kReach = 3.0;  ///< m from the first observation; right places are within 7.5 m

  /// Returns the similarity of two observations, 0 ... 1.
  using Similarity = std::function<double(std::size_t, std::size_t)>;

  /// Adds a pair. Returns the observation that it makes forgotten, or `kNone`. The order of calls matters if a place
  /// has more than eight appearances, or observations near two places.
  std::size_t confirm(const ConfirmedPair& pair, const Similarity& similarity);
  /// Removes a pair, and what followed from it.
  void withdraw(std::size_t a, std::size_t b, const Similarity& similarity);

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  /// Returns the appearances of the place of an observation, the first one first; empty if it is its only one.
  const std::vector<std::size_t>& appearances(std::size_t observation) const;
  bool isForgotten(std::size_t observation) const;
  bool empty() const { return groups_.empty(); }

 private:
  struct Group {
    std::vector<std::size_t> members;  // the first one first, then in order of confirmation
    std::vector<double> reach;         // of each, m from the first
  };
  struct Membership {
    std::size_t group = 0;
    bool is_forgotten = false;
    double reach = 0.0;  // m
  };
  std::size_t take(std::size_t group, std::size_t observation, double reach, const Similarity& similarity);
  void add(const ConfirmedPair& pair, const Similarity& similarity, std::size_t& forgotten);

  std::vector<ConfirmedPair> confirmed_;                 // in order of calls
  std::set<std::pair<std::size_t, std::size_t>> known_;  // their observations
  std::vector<Group> groups_;
  std::map<std::size_t, Membership> of_observation_;
  std::map<std::pair<std::size_t, std::size_t>, double> similarity_;  // of members
};

}  // namespace fabmap_node
