// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/parallel/for_each.hpp"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <exception>
#include <mutex>
#include <optional>

namespace urban_nav_core {
namespace detail {

void forEachPart(std::size_t parts, const std::function<void(std::size_t)>& work) {
  std::mutex mutex;
  std::optional<std::pair<std::size_t, std::exception_ptr>> first;  // guarded by mutex
  const auto guarded = [&](std::size_t part) {
    try {
      work(part);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!first || part < first->first) first.emplace(part, std::current_exception());
    }
  };
  // TBB would rethrow whichever exception was thrown first in time.
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, parts, 1),
                    [&guarded](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t part = range.begin(); part != range.end(); ++part) guarded(part);
                    });
  if (first) std::rethrow_exception(first->second);
}

}  // namespace detail

struct ThreadLimit::Control {
  explicit Control(std::size_t threads) : limit(tbb::global_control::max_allowed_parallelism, threads) {}
  tbb::global_control limit;
};

ThreadLimit::ThreadLimit(int threads)
    : control_(threads > 0 ? std::make_unique<Control>(static_cast<std::size_t>(threads)) : nullptr) {}
ThreadLimit::~ThreadLimit() = default;

}  // namespace urban_nav_core
