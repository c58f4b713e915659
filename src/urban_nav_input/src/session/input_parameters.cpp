// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/session/input_parameters.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "urban_nav_core/inertial/axis_map.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {

using urban_nav_core::Table;

InputParameters::InputParameters() { inputTable().setDefaults(*this); }

namespace {

using P = InputParameters;

constexpr urban_nav_core::Audience kRepair = urban_nav_core::Audience::Experts;  // doctor states it with its value
constexpr double kLongestDelay = 1e13;                                           // ms: of a clock that was never set

urban_nav_core::Row<P> delayRow(const char* name, double P::*member, const std::string& what) {
  return {name,
          member,
          "ms",
          0.0,
          -kLongestDelay,
          kLongestDelay,
          {},
          "How much later " + what + " are stamped than they were measured; it is taken from their stamps.",
          "docs/files.md",
          {},
          kRepair};
}

urban_nav_core::Row<P> scaleRow(const char* name, double P::*member, const char* unit, const std::string& sentence) {
  return {name, member, unit, 1.0, 1e-6, 1e6, {}, sentence, "docs/files.md", {}, kRepair};
}

std::vector<urban_nav_core::Row<P>> pairRows() {
  return {
      {"right_delay",
       &P::right_delay,
       "ms",
       0.0,
       -1000.0,
       1000.0,
       {},
       "how much later the right images of a bag are stamped than the left ones, though they are exposed "
       "together; it is taken from their stamps",
       "docs/files.md"},
      {"pairing_tolerance",
       &P::pairing_tolerance,
       "ms",
       5.0,
       0.1,
       1000.0,
       {},
       "Largest difference between the stamps of the two images of a pair: less than half of the interval between "
       "images.",
       "docs/files.md",
       {},
       kRepair},
      {"baseline_scale",
       &P::baseline_scale,
       "m",
       1.0,
       -1e6,
       1e6,
       {},
       "Baseline of 1 in the calibration: 0.01 where it states centimetres, -1 where it has the wrong sign.",
       "docs/files.md",
       {},
       kRepair},
      {"sessions",
       &P::sessions,
       "",
       "auto",
       false,
       false,
       {"auto", "apart", "together"},
       "Which recordings form a session: auto: those less than 5 s apart, unless they hold images of one topic at the "
       "same time; apart: each one; together: all of them.",
       "docs/files.md",
       {},
       kRepair}};
}

std::vector<urban_nav_core::Row<P>> sensorRows() {
  return {
      {"accelerometer_axes",
       &P::accelerometer_axes,
       "",
       "x,y,z",
       false,
       false,
       {},
       "Which axis of the messages of the IMU is x, y and z of its accelerometer: -x,-y,-z for the sign of NED, y,z,x "
       "for exchanged axes.",
       "docs/files.md"},
      scaleRow("accelerometer_scale", &P::accelerometer_scale, "m/s2",
               "Specific force of 1 in the messages of the IMU: 9.80665 where they state it in g."),
      scaleRow("gyroscope_scale", &P::gyroscope_scale, "rad/s",
               "Rate of 1 in the messages of the IMU: 0.0174532925 where they state deg/s."),
      {"wheels_scale",
       &P::wheels_scale,
       "m",
       1.0,
       -1e6,
       1e6,
       {},
       "Distance of 1 in the positions of wheel odometry: 0.001 where they state millimetres, -1 where forward is "
       "negative.",
       "docs/files.md",
       {},
       kRepair},
      delayRow("imu_delay", &P::imu_delay, "messages of the IMU"),
      delayRow("wheels_delay", &P::wheels_delay, "messages of wheel odometry"),
      delayRow("gps_delay", &P::gps_delay, "fixes of the GPS receiver")};
}

urban_nav_core::Row<P> timeScaleRow(const char* name, double P::*member, const std::string& laser) {
  return {name,
          member,
          "s",
          1.0,
          0.0,
          1e6,
          {},
          "time_increment of 1 in the messages of " + laser +
              ": 0.001 where they state milliseconds; 0: all beams have the stamp of their scan.",
          "docs/files.md",
          {},
          kRepair};
}

std::vector<urban_nav_core::Row<P>> laserRows() {
  return {delayRow("laser_left_delay", &P::laser_left_delay, "scans of laser_left"),
          delayRow("laser_right_delay", &P::laser_right_delay, "scans of laser_right"),
          scaleRow("laser_left_range_scale", &P::laser_left_range_scale, "m",
                   "Range of 1 in the messages of laser_left: 0.001 where they state millimetres."),
          scaleRow("laser_right_range_scale", &P::laser_right_range_scale, "m",
                   "Range of 1 in the messages of laser_right: 0.001 where they state millimetres."),
          scaleRow("laser_left_angle_scale", &P::laser_left_angle_scale, "rad",
                   "Angle of 1 in the messages of laser_left: 0.0174532925 where they state degrees."),
          scaleRow("laser_right_angle_scale", &P::laser_right_angle_scale, "rad",
                   "Angle of 1 in the messages of laser_right: 0.0174532925 where they state degrees."),
          timeScaleRow("laser_left_time_scale", &P::laser_left_time_scale, "laser_left"),
          timeScaleRow("laser_right_time_scale", &P::laser_right_time_scale, "laser_right")};
}

std::vector<urban_nav_core::Row<P>> pointsRows() {
  return {
      {"points_time",
       &P::points_time,
       "",
       "auto",
       false,
       false,
       {},
       "Times of the points of 3D LiDARs: FIELD,UNIT,REFERENCE with UNIT s, ms, us or ns and REFERENCE header (the "
       "value is added to the stamp of the header) or absolute (it is the stamp); none: clouds have none; auto: found "
       "from the values.",
       "docs/files.md",
       {},
       kRepair},
      {"points_deskewed",
       &P::points_deskewed,
       "",
       "auto",
       false,
       false,
       {"auto", "yes", "no"},
       "Whether the sweeps of 3D LiDARs are free of the motion within a sweep already; auto: those of KITTI's "
       "velodyne/ are.",
       "docs/files.md",
       {},
       kRepair},
      {"points_near",
       &P::points_near,
       "m",
       0.5,
       0.0,
       10.0,
       {},
       "Returns of 3D LiDARs nearer than this are of the robot itself, and are left out.",
       "docs/files.md",
       {},
       kRepair},
      delayRow("points0_delay", &P::points0_delay, "clouds of points0"),
      delayRow("points1_delay", &P::points1_delay, "clouds of points1")};
}

PointsOptions toPointsOptions(const P& parameters) {
  PointsOptions options;
  if (parameters.points_time != "auto") {
    options.times = urban_nav_core::parsePointTimes(parameters.points_time);
    if (!options.times)
      throw urban_nav_core::UserError("input.points_time", "\"" + parameters.points_time + "\"",
                                      "auto, none, or FIELD,UNIT,REFERENCE with UNIT s, ms, us or ns and REFERENCE "
                                      "header or absolute, such as time,s,header");
  }
  if (parameters.points_deskewed != "auto") options.deskewed = parameters.points_deskewed == "yes";
  options.near = parameters.points_near;
  options.delays = {{parameters.points0_delay, parameters.points1_delay}};
  return options;
}

}  // namespace

const Table<InputParameters>& inputTable() {
  static const Table<P> table = [] {
    std::vector<urban_nav_core::Row<P>> rows = pairRows();
    for (auto& more : {sensorRows(), laserRows(), pointsRows()}) rows.insert(rows.end(), more.begin(), more.end());
    return Table<P>("input", urban_nav_core::withMotionInput<P>(std::move(rows)));
  }();
  return table;
}

void apply(const InputParameters& parameters, SourceOptions& options) {
  options.motion_input = parameters.motion_input;
  options.wheel_noise = parameters.wheel_noise;
  options.gyro_noise = parameters.gyro_noise;
  const auto axes = urban_nav_core::parseAxisMap(parameters.accelerometer_axes);
  if (!axes)
    throw urban_nav_core::UserError("input.accelerometer_axes", "\"" + parameters.accelerometer_axes + "\"",
                                    "x, y and z in any order, each with or without a minus, such as -x,-y,-z");
  options.accelerometer = {*axes, parameters.accelerometer_scale};
  options.imu_delay = parameters.imu_delay;
  options.points = toPointsOptions(parameters);
  options.wheels_delay = parameters.wheels_delay;
  options.gps_delay = parameters.gps_delay;
  if (parameters.wheels_scale == 0.0)
    throw urban_nav_core::UserError("input.wheels_scale", "0", "a factor that leaves a distance");
  options.motion = {parameters.wheels_scale, parameters.gyroscope_scale};
  const auto toNs = [](double ms) { return static_cast<urban_nav_core::StampNs>(std::llround(1e6 * ms)); };
  options.pairing = {toNs(parameters.right_delay), toNs(parameters.pairing_tolerance)};
  if (parameters.baseline_scale == 0.0)
    throw urban_nav_core::UserError("input.baseline_scale", "0", "a factor that leaves a baseline");
  options.baseline_scale = parameters.baseline_scale;
  options.sessions = parameters.sessions == "apart"      ? SessionRule::Apart
                     : parameters.sessions == "together" ? SessionRule::Together
                                                         : SessionRule::Auto;
  options.lasers = {{{parameters.laser_left_range_scale, parameters.laser_left_angle_scale,
                      toNs(parameters.laser_left_delay), parameters.laser_left_time_scale},
                     {parameters.laser_right_range_scale, parameters.laser_right_angle_scale,
                      toNs(parameters.laser_right_delay), parameters.laser_right_time_scale}}};
}

}  // namespace urban_nav_input
