// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "fabmap_node/model/chow_liu_tree.hpp"

namespace fabmap_node {

/// Inference as openFABMAP does it (Glover et al., ICRA 2012), for comparison of the arithmetic with that program.
enum class ReplayModel {
  ChowLiu,          ///< FAB-MAP, tree, mean-field new place
  Naive,            ///< the same without the tree
  ChowLiuPzgne001,  ///< as ChowLiu with p(z = 1 | e = 0) = 0.01
  Fabmap2Sampled,   ///< FAB-MAP 2, new place: mean likelihood over all observations of the input
  ChowLiuMotion     ///< as ChowLiu with a prior of motion: new place 0.9, forward bias 0.5
};

/// Names of the models in the order of the enumeration.
const std::vector<std::string>& replayModelNames();
/// Throws UserError with the allowed names.
ReplayModel replayModelFromName(const std::string& name);

struct ReplayRow {
  static constexpr std::int64_t kNewPlace = -1;
  std::size_t query = 0;
  std::int64_t place = kNewPlace;
  double log_likelihood = 0.0;  ///< nats
  double probability = 0.0;     ///< over all rows of this query: sums to 1
};

/// Presents the observations in order: each is compared with the new place and all earlier observations, then becomes
/// a place. Calls `row` for the new place first, then for the places in order.
/// Throws UserError if tree and observations differ in vocabulary size.
void replay(const WordSets& input, const ChowLiuTree& tree, ReplayModel model,
            const std::function<void(const ReplayRow&)>& row);

}  // namespace fabmap_node
