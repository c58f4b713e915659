// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace urban_nav_core {

/// While it lives, forEach and sumInOrder use at most so many threads in this process; 0: as many as the machine has.
/// Their results do not depend on it. This header and its source are the only places that know of TBB.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

namespace detail {
/// Calls work(part) for every part in 0...parts - 1, on several threads, each part whole on one of them. The first
/// exception, by the number of its part, is thrown again when all that was begun has ended.
void forEachPart(std::size_t parts, const std::function<void(std::size_t)>& work);
}  // namespace detail

/// Calls body(i) for i in 0...count - 1 in pieces of `grain` neighbours, pieces in any order and at once: body(i) may
/// write to what is i's alone. What it throws comes out, the one of the first piece where there are several.
template <typename Body>
void forEach(std::size_t count, std::size_t grain, const Body& body) {
  assert(grain > 0);
  const std::size_t parts = (count + grain - 1) / grain;
  detail::forEachPart(parts, [&](std::size_t part) {
    const std::size_t end = std::min(count, (part + 1) * grain);
    for (std::size_t i = part * grain; i < end; ++i) body(i);
  });
}

/// The sum of term(0)...term(count - 1), added to `zero`. Pieces of `grain` neighbours are summed from left to right,
/// then the pieces from left to right: the partition is part of the result, the number of threads is not.
template <typename Value, typename Term>
Value sumInOrder(std::size_t count, std::size_t grain, const Value& zero, const Term& term) {
  assert(grain > 0);
  const std::size_t parts = (count + grain - 1) / grain;
  std::vector<Value> sums(parts, zero);
  detail::forEachPart(parts, [&](std::size_t part) {
    const std::size_t end = std::min(count, (part + 1) * grain);
    for (std::size_t i = part * grain; i < end; ++i) sums[part] += term(i);
  });
  Value total = zero;
  for (const Value& sum : sums) total += sum;
  return total;
}

}  // namespace urban_nav_core
