// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/driver/driver_options.hpp"

namespace segway_drivers {

LmsDriver::Options toLmsOptions(const Parameters& parameters) {
  LmsDriver::Options options;
  options.stream.latency = 1e-3 * parameters.lms291_latency_ms;
  const auto mode = static_cast<std::uint8_t>(parameters.lms291_measuring_mode);
  if (const auto format = LmsRangeFormat::fromConfiguration(mode, 1)) options.stream.format = *format;
  options.configure = parameters.lms291_configure;
  return options;
}

MtiDriver::Options toMtiOptions(const Parameters& parameters) {
  MtiDriver::Options options;
  options.rate = parameters.xsens_mti_rate;
  options.stream.mode = static_cast<unsigned>(parameters.xsens_mti_mode);
  options.stream.settings = static_cast<unsigned>(parameters.xsens_mti_settings);
  options.stream.period = 1.0 / parameters.xsens_mti_rate;
  options.stream.latency = 1e-3 * parameters.xsens_mti_latency_ms;
  return options;
}

RmpDriver::Options toRmpOptions(const Parameters& parameters) {
  RmpDriver::Options options;
  options.latency = 1e-3 * parameters.segway_rmp_latency_ms;
  options.limits.velocity = parameters.segway_rmp_max_velocity;
  options.limits.turn_rate = parameters.segway_rmp_max_turn_rate;
  options.limits.acceleration = parameters.segway_rmp_acceleration;
  options.limits.angular_acceleration = parameters.segway_rmp_angular_acceleration;
  options.limits.timeout = parameters.segway_rmp_command_timeout;
  return options;
}

GpsDriver::Options toGpsOptions(const Parameters& parameters, const std::string& port) {
  GpsDriver::Options options;
  options.stream.uere = parameters.gps_uere;
  options.stream.latency = 1e-3 * parameters.gps_latency_ms;
  options.gpsd = port.find('/') == std::string::npos && port.find(':') != std::string::npos;
  return options;
}

}  // namespace segway_drivers
