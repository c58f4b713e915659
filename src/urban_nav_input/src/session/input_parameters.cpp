// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/session/input_parameters.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {

using urban_nav_core::Table;

InputParameters::InputParameters() { inputTable().setDefaults(*this); }

namespace {

using P = InputParameters;

constexpr urban_nav_core::Audience kRepair = urban_nav_core::Audience::Experts;  // suggested by doctor with its value

std::vector<urban_nav_core::Row<P>> pairRows() {
  return {
      {"right_delay",
       &P::right_delay,
       "ms",
       0.0,
       -1000.0,
       1000.0,
       {},
       "Delay of the stamps of the right images of a bag relative to left images of the same exposure; subtracted "
       "from the stamps.",
       "docs/files.md"},
      {"pairing_tolerance",
       &P::pairing_tolerance,
       "ms",
       5.0,
       0.1,
       1000.0,
       {},
       "Largest difference between the stamps of the two images of a pair; less than half of the interval between "
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
       "Length of one unit of the baseline in the calibration: 0.01 for centimetres, -1 for the wrong sign.",
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
       "Recordings that form a session. auto: those less than 5 s apart, unless they have images of one topic at the "
       "same time; apart: each recording; together: all of them.",
       "docs/files.md",
       {},
       kRepair}};
}

std::vector<urban_nav_core::Row<P>> pointsRows() {
  return {{"points_time",
           &P::points_time,
           "",
           "auto",
           false,
           false,
           {},
           "Times of the points of 3D LiDARs: FIELD,UNIT,REFERENCE with UNIT s, ms, us or ns and REFERENCE header "
           "(relative to the stamp of the header) or absolute; none: no times; auto: determined from the values.",
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
           "Whether the sweeps of 3D LiDARs are already motion-compensated; auto: only those of KITTI's velodyne/.",
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
           "Returns of 3D LiDARs nearer than this are from the robot itself and are ignored.",
           "docs/files.md",
           {},
           kRepair},
          urban_nav_ros::delayRow<P>("points0_delay", &P::points0_delay, "clouds of points0"),
          urban_nav_ros::delayRow<P>("points1_delay", &P::points1_delay, "clouds of points1")};
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
    std::vector<urban_nav_core::Row<P>> rows = urban_nav_ros::withSensorCorrections<P>(pairRows());
    for (auto& row : pointsRows()) rows.push_back(std::move(row));
    return Table<P>("input", urban_nav_core::withMotionInput<P>(std::move(rows)));
  }();
  return table;
}

void apply(const InputParameters& parameters, SourceOptions& options) {
  options.motion_input = parameters.motion_input;
  options.wheel_noise = parameters.wheel_noise;
  options.gyro_noise = parameters.gyro_noise;
  options.sensors = urban_nav_ros::toCorrections(parameters);
  options.points = toPointsOptions(parameters);
  const auto toNs = [](double ms) { return static_cast<urban_nav_core::StampNs>(std::llround(1e6 * ms)); };
  options.pairing = {toNs(parameters.right_delay), toNs(parameters.pairing_tolerance)};
  if (parameters.baseline_scale == 0.0)
    throw urban_nav_core::UserError("input.baseline_scale", "0", "a factor other than 0");
  options.baseline_scale = parameters.baseline_scale;
  options.sessions = parameters.sessions == "apart"      ? SessionRule::Apart
                     : parameters.sessions == "together" ? SessionRule::Together
                                                         : SessionRule::Auto;
}

}  // namespace urban_nav_input
