// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_input {

/// Messages of a recording that were received in [begin, end); end 0: to the end of the recording.
struct ReceiptRange {
  urban_nav_core::StampNs begin = 0, end = 0;
};

inline bool operator==(const ReceiptRange& a, const ReceiptRange& b) { return a.begin == b.begin && a.end == b.end; }

/// Files of one recording are less than this apart.
constexpr double kLongestSplit = 5.0;  // s

}  // namespace urban_nav_input
