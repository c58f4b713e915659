// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/measurement.hpp"

namespace urban_nav_sim {

namespace {

template <typename Any>
urban_nav_core::StampNs stamp(const Any& measurement) {
  return measurement.stamp;
}
urban_nav_core::StampNs stamp(const LaserMeasurement& measurement) { return measurement.scan.stamp; }

}  // namespace

urban_nav_core::StampNs toStamp(const Measurement& measurement) {
  return std::visit([](const auto& any) { return stamp(any); }, measurement);
}

}  // namespace urban_nav_sim
