// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

#include "fabmap_node/parameters.hpp"

namespace fabmap_node {

/// Where a place lies along the drive of its session.
struct PlacePosition {
  std::size_t session = 0;
  double travelled = 0.0;  ///< m driven since the session began
};

/// Selects the recognitions that are worth the cost of a geometric check: likely enough, a limited number per metre
/// driven, and none between stretches that those before connect well. Two stretches that merely look alike fail
/// together: after some proposals between them, a further one must be clearly likelier than all before. Not
/// thread-safe.
class ClosureSelector {
 public:
  explicit ClosureSelector(const Parameters& parameters);

  /// Begins a session: nothing of the allowance per metre is left over.
  void beginSession();
  /// Returns whether a recognition is to be proposed, and counts it if so. Queries of a session in order of time.
  bool select(const PlacePosition& earlier, const PlacePosition& query, double probability);

 private:
  using Stretch = std::pair<std::size_t, std::int64_t>;
  using StretchPair = std::tuple<std::size_t, std::int64_t, std::size_t, std::int64_t>;

  /// Counts of the closures proposed between two stretches, or from one.
  struct Tally {
    double expected = 0.0;  ///< sum of their probabilities
    double count = 0.0, best_odds = 0.0;
  };

  bool isWorthOneMore(const Tally& before, double probability) const;
  static void add(double probability, Tally& proposals);

  double closure_probability_, per_metre_, enough_;
  double allowance_ = 0.0, travelled_ = 0.0;
  std::map<StretchPair, Tally> proposed_;
  std::map<Stretch, Tally> unlikely_;  // by the stretch of the query
};

}  // namespace fabmap_node
