// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace pose_graph {

/// Returns a non-negative index as the containers of the standard library take it.
constexpr std::size_t sz(int i) { return static_cast<std::size_t>(i); }

}  // namespace pose_graph
