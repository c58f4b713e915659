// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace urban_nav_core {

/// Evenly subsamples a sequence of unknown length to at most `most` items: every first, second, fourth ... one. Two
/// sequences of equal length keep the same indices. Not thread-safe.
template <typename Item>
class EvenThinning {
 public:
  explicit EvenThinning(std::size_t most) : most_(most) {}

  void add(const Item& item) {
    if (seen_++ % step_ != 0) return;
    items_.push_back(item);
    if (items_.size() <= most_) return;
    for (std::size_t i = 0; 2 * i < items_.size(); ++i) items_[i] = items_[2 * i];
    items_.resize((items_.size() + 1) / 2);
    step_ *= 2;
  }
  const std::vector<Item>& items() const { return items_; }

 private:
  const std::size_t most_;
  std::vector<Item> items_;  // every step_-th
  std::size_t step_ = 1, seen_ = 0;
};

}  // namespace urban_nav_core
