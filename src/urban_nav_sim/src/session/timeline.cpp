// SPDX-License-Identifier: BSD-3-Clause
#include "session/timeline.hpp"

#include <utility>

namespace urban_nav_sim {

void Timeline::add(const Schedule& schedule, std::function<std::vector<Measurement>(std::int64_t)> measure) {
  devices_.push_back({schedule, std::move(measure), schedule.count(duration_)});
}

std::optional<Timeline::Due> Timeline::next() {
  while (ready_.empty()) {
    Device* first = nullptr;
    for (Device& device : devices_)
      if (device.k < device.count && (first == nullptr || device.schedule.at(device.k) < first->schedule.at(first->k)))
        first = &device;
    if (first == nullptr) return std::nullopt;
    const double taken = first->schedule.at(first->k);
    for (Measurement& measurement : first->measure(first->k++)) ready_.push_back({std::move(measurement), taken});
  }
  Due due = std::move(ready_.front());
  ready_.pop_front();
  return due;
}

}  // namespace urban_nav_sim
