// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/robust.hpp"

namespace pose_graph {

/// Returns the fixed poses of a problem without those that lie where trusted edges lead from another one, to a
/// hundredth of the deviation that the last edge states. Such a pose was fixed where odometry had put it: that its
/// residuals are zero is no evidence of how large the errors of odometry are.
template <int D>
std::vector<int> withoutCopiedPoses(const Problem<D>& problem, const std::vector<EdgeRole>& roles);

extern template std::vector<int> withoutCopiedPoses<2>(const Problem<2>&, const std::vector<EdgeRole>&);
extern template std::vector<int> withoutCopiedPoses<3>(const Problem<3>&, const std::vector<EdgeRole>&);

}  // namespace pose_graph
