// SPDX-License-Identifier: BSD-3-Clause
#include "live/simulated_session.hpp"

#include "segway_drivers/transport/port.hpp"
#include "urban_nav_core/io/agreed_number.hpp"

namespace segway_drivers {

namespace {

constexpr TimeNs kSessionLead = 4'000'000'000;  // ns, for the other devices to start

}  // namespace

SimCameraOptions simulatedCameraOptions(const NodeletParameters& parameters, SimCameraOptions::Model model) {
  SimCameraOptions options;
  options.model = model;
  options.is_paced = !parameters.paced_by.empty();
  const std::string& file = parameters.session_begin;
  if (file.empty()) return options;
  if (parameters.session_held) options.begin = [file] { return urban_nav_core::findAgreedNumber(file); };
  else options.begin = [begin = urban_nav_core::agreeOnNumber(file, steadyTime() + kSessionLead)] { return begin; };
  return options;
}

}  // namespace segway_drivers
