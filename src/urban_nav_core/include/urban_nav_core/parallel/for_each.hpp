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

/// Limits forEach() and sumInOrder() in this process to a number of threads during its lifetime; 0: all of the machine.
/// Results do not depend on it. Only this header and its source depend on TBB.
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
/// Calls work(part) for every part in 0...parts - 1, on several threads, each part on one of them. After all started
/// parts have ended, rethrows the exception of the part with the lowest number.
void forEachPart(std::size_t parts, const std::function<void(std::size_t)>& work);
}  // namespace detail

/// Calls body(i) for i in 0...count - 1, in blocks of `grain` consecutive indices, which run concurrently and in any
/// order: body(i) may write only to data of i. Rethrows the exception of the first block with one.
template <typename Body>
void forEach(std::size_t count, std::size_t grain, const Body& body) {
  assert(grain > 0);
  const std::size_t parts = (count + grain - 1) / grain;
  detail::forEachPart(parts, [&](std::size_t part) {
    const std::size_t end = std::min(count, (part + 1) * grain);
    for (std::size_t i = part * grain; i < end; ++i) body(i);
  });
}

/// Returns `zero` plus the sum of term(0)...term(count - 1). Blocks of `grain` consecutive terms are summed from left
/// to right, then the blocks from left to right: the result depends on `grain`, not on the number of threads.
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
