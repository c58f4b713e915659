// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "proprioception/schedule.hpp"
#include "urban_nav_sim/measurement.hpp"

namespace urban_nav_sim {

/// Takes the measurements of devices in the order in which they are due. Not thread-safe.
class Timeline {
 public:
  explicit Timeline(double duration) : duration_(duration) {}

  /// `measure` returns the measurements of the k-th time, none or several. Of devices due at the same time the one
  /// added first is called first.
  void add(const Schedule& schedule, std::function<std::vector<Measurement>(std::int64_t k)> measure);

  struct Due {
    Measurement measurement;
    double taken = 0.0;  ///< s of the session
  };
  /// Empty when the session is over.
  std::optional<Due> next();

 private:
  struct Device {
    Schedule schedule;
    std::function<std::vector<Measurement>(std::int64_t)> measure;
    std::int64_t count, k = 0;
  };

  double duration_;
  std::vector<Device> devices_;
  std::deque<Due> ready_;
};

}  // namespace urban_nav_sim
