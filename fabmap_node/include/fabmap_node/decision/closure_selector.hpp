// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

#include "fabmap_node/parameters.hpp"

namespace fabmap_node {

/// Position of a place along the path of its session.
struct PlacePosition {
  std::size_t session = 0;
  double travelled = 0.0;  ///< m since the beginning of the session
};

/// Selects the recognitions for geometric verification: sufficiently probable, a limited number per metre of path, and
/// none between parts of the path that earlier closures connect well. Closures between two parts that only have a
/// similar appearance fail together: after some proposals between them, a further one must be clearly more probable
/// than all before. Not thread-safe.
class ClosureSelector {
 public:
  explicit ClosureSelector(const Parameters& parameters);

  /// Begins a session and resets the budget per metre.
  void beginSession();
  /// Returns whether a recognition is proposed, and counts it if so. Queries of a session must be in order of time.
  bool select(const PlacePosition& earlier, const PlacePosition& query, double probability);

 private:
  using Stretch = std::pair<std::size_t, std::int64_t>;
  using StretchPair = std::tuple<std::size_t, std::int64_t, std::size_t, std::int64_t>;

  /// Closures proposed between two parts of the path, or from one.
  struct Tally {
    double expected = 0.0;  ///< sum of their probabilities
    double count = 0.0, best_odds = 0.0;
  };

  bool isWorthOneMore(const Tally& before, double probability) const;
  static void add(double probability, Tally& proposals);

  double closure_probability_, per_metre_, enough_;
  double allowance_ = 0.0, travelled_ = 0.0;
  std::map<StretchPair, Tally> proposed_;
  std::map<Stretch, Tally> unlikely_;  // by the query's part of the path
};

}  // namespace fabmap_node
