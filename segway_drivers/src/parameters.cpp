// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/parameters.hpp"

#include <cstdint>

namespace segway_drivers {

using urban_nav_core::Table;

Parameters::Parameters() { table().setDefaults(*this); }

// clang-format would give each of the columns a line.
// clang-format off
const Table<Parameters>& table() {
  using P = Parameters;
  static const Table<Parameters> rows(
      "segway_drivers",
      {
          {"lms291.latency_ms", &P::lms291_latency_ms, "ms", 4.33, 0.0, 1000.0, {},
           "Delay from the first beam to the first byte: 3.33 ms of measurement, and about 1 ms that no filter can "
           "observe; calibrate by turning on the spot.",
           "SICK telegram timing"},
          {"lms291.measuring_mode", &P::lms291_measuring_mode, "", 5, 0, 63, {},
           "Measuring mode for decoding if the device cannot be queried: 0-2 mean 13 bits of range, 3-4 14, 5-6 15, "
           "15 16.",
           "New College log: 15 bits, mm"},
          {"lms291.configure", &P::lms291_configure, "", false, false, false, {},
           "Whether to rewrite a configuration whose range words cannot be decoded or are not in mm; otherwise such a "
           "laser is refused.",
           "flash memory wears"},
          {"xsens_mti.latency_ms", &P::xsens_mti_latency_ms, "ms", 2.5, 0.0, 1000.0, {},
           "Delay from the measurement to the first byte: 2.5 ms with orientation, 0.31 ms without.",
           "XSens MTi data sheet"},
          {"xsens_mti.mode", &P::xsens_mti_mode, "", 6, 0, 65535, {},
           "Output mode of MTData if the device cannot be queried: bit 0 temperature, 1 calibrated data, 2 "
           "orientation, 11 status, 14 raw.",
           "XSens MT low-level communication"},
          {"xsens_mti.settings", &P::xsens_mti_settings, "", 1, 0, 65535, {},
           "Output settings of MTData if the device cannot be queried: bits 0-1 sample counter, 2-3 kind of "
           "orientation, 4-6 suppressed data, 8-9 number format.",
           "XSens MT low-level communication"},
          {"xsens_mti.rate", &P::xsens_mti_rate, "Hz", 100, 1, 400, {},
           "Measurement rate set by the driver.", "paper, section 1.2"},
          {"segway_rmp.latency_ms", &P::segway_rmp_latency_ms, "ms", 0.0, 0.0, 1000.0, {},
           "Delay from the measurement to the first byte of a cycle.", "unknown"},
          {"segway_rmp.max_velocity", &P::segway_rmp_max_velocity, "m/s", 1.5, 0.0, 3.54, {},
           "Largest commanded velocity; commands beyond ten times this value are ignored.", "RMP200: 3.54 m/s"},
          {"segway_rmp.max_turn_rate", &P::segway_rmp_max_turn_rate, "rad/s", 1.5, 0.0, 2.29, {},
           "Largest commanded turn rate; commands beyond ten times this value are ignored.", "RMP200: 131 deg/s"},
          {"segway_rmp.acceleration", &P::segway_rmp_acceleration, "m/s^2", 1.0, 0.01, 10.0, {},
           "Largest acceleration from the commanded velocity; braking is immediate.", "safe for a standing load"},
          {"segway_rmp.angular_acceleration", &P::segway_rmp_angular_acceleration, "rad/s^2", 2.0, 0.01, 20.0, {},
           "Largest angular acceleration from the commanded turn rate; braking is immediate.",
           "safe for a standing load"},
          {"segway_rmp.command_timeout", &P::segway_rmp_command_timeout, "s", 0.5, 0.05, 5.0, {},
           "Age at which a velocity command counts as zero, by a steady clock in the sending thread.",
           "segway_rmp: motor_timeout"},
          {"gps.latency_ms", &P::gps_latency_ms, "ms", 0.0, 0.0, 2000.0, {},
           "Delay from the instant of a fix to its first byte; 100 to 600 ms for old receivers.", "unknown"},
          {"gps.uere", &P::gps_uere, "m", 4.5, 0.1, 100.0, {},
           "User equivalent range error, multiplied with the dilution of precision if the receiver reports no errors.",
           "GPS standard positioning service"},
          {"bumblebee2.latency_ms", &P::bumblebee2_latency_ms, "ms", 0.0, 0.0, 1000.0, {},
           "Delay from the middle of the exposure to the embedded time.", "unknown"},
          {"bumblebee2.pattern", &P::bumblebee2_pattern, "", "auto", false, false,
           {"auto", "RGGB", "GBRG", "GRBG", "BGGR", "YYYY"},
           "Mosaic of each imager; YYYY is a monochrome camera; auto: as reported by the camera, BGGR for recorded "
           "frames.",
           "register 0x1040"},
          {"bumblebee2.rectify", &P::bumblebee2_rectify, "", "none", false, false, {"none", "factory"},
           "Whether images are rectified by the factory's surfaces.", "Triclops calibration"},
          {"bumblebee2.calibration", &P::bumblebee2_calibration, "", "", false, false, {},
           "File of the factory calibration, for rectify: factory.", "register 0x2000"},
          {"bumblebee2.camera_info", &P::bumblebee2_camera_info, "", "", false, false, {},
           "LEFT.yaml,RIGHT.yaml: camera_info that is published with raw images, for rectify: none.",
           "camera1394stereo: camera_info_url"},
          {"bumblebee2.swap_images", &P::bumblebee2_swap_images, "", false, false, false, {},
           "Whether even bytes belong to the left imager; false fits register 0x1048 = 0x80000000.", "register 0x1048"},
          {"ladybug2.latency_ms", &P::ladybug2_latency_ms, "ms", 0.0, 0.0, 1000.0, {},
           "Delay from the middle of the exposure to the embedded time.", "unknown"},
          {"ladybug2.rate", &P::ladybug2_rate, "Hz", 3.0, 0.1, 30.0, {},
           "Maximum rate of published frames; the camera itself runs faster, for a current exposure control.",
           "paper, section 1.2: 2 to 3 Hz"},
          {"ladybug2.quality", &P::ladybug2_quality, "", 60, 1, 100, {},
           "Initial JPEG quality of the automatic control.", "register 0x1E80"},
          {"ladybug2.camera_order", &P::ladybug2_camera_order, "", "forward", false, false, {"forward", "backward"},
           "Whether the directory of a frame lists cameras 0-5 or 5-0: cover one lens to check.", "programs disagree"},
          {"ladybug2.pattern", &P::ladybug2_pattern, "", "auto", false, false, {"auto", "RGGB", "GBRG", "GRBG", "BGGR"},
           "Mosaic of each imager; auto: from the frame, BGGR if that is not readable.", "register 0x1040"},
      });
  return rows;
}
// clang-format on

}  // namespace segway_drivers
