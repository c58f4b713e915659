// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "fabmap_node/model/chow_liu_tree.hpp"

namespace fabmap_node {

/// Inference methods of openFABMAP (Glover et al., ICRA 2012), for numeric comparison with that program.
enum class ReplayModel {
  ChowLiu,          ///< FAB-MAP, tree, mean-field new place
  Naive,            ///< ChowLiu without the tree
  ChowLiuPzgne001,  ///< ChowLiu with p(z = 1 | e = 0) = 0.01
  Fabmap2Sampled,   ///< FAB-MAP 2, new place: mean likelihood over all observations of the input
  ChowLiuMotion     ///< ChowLiu with a motion prior: new place 0.9, forward bias 0.5
};

/// Returns the names of the models in the order of the enumeration.
const std::vector<std::string>& replayModelNames();
/// Returns the model of a name. Throws UserError with the valid names.
ReplayModel replayModelFromName(const std::string& name);
/// Likelihood of one query at one place.
struct ReplayRow {
  static constexpr std::int64_t kNewPlace = -1;
  std::size_t query = 0;
  std::int64_t place = kNewPlace;
  double log_likelihood = 0.0;  ///< nats
  double probability = 0.0;     ///< over all rows of this query, which sum to 1
};

/// Processes the observations in order: each is compared with the new place and all earlier observations, then becomes
/// a place. Calls `row` for the new place first, then for the places in order.
/// Throws UserError if tree and observations differ in vocabulary size.
void replay(const WordSets& input, const ChowLiuTree& tree, ReplayModel model,
            const std::function<void(const ReplayRow&)>& row);

}  // namespace fabmap_node
