// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace urban_nav_input {

/// Topics that a driver publishes for a role of `map`.
struct PresetRole {
  /// As in --topic; `points`: every topic that fits, as points0, points1, ... in the order of their names.
  const char* role = "";
  /// Ends of topic names, the preferred one first: whole parts between slashes, in any namespace. A `*` at the end
  /// is the rest of a part. The first one with the driver's default namespace is in the launch files.
  std::vector<const char*> names;
  bool is_required = true;
};

/// Transform between two frames of a device.
struct PresetTransform {
  const char *parent = "", *child = "";
  double x = 0.0, y = 0.0, z = 0.0;                   ///< m
  double qx = 0.0, qy = 0.0, qz = 0.0, qw = 1.0;
};

/// Roles, units and frames of the ROS driver of a device.
struct DriverPreset {
  const char* name = "";    ///< as in --preset
  const char* driver = "";  ///< package, and devices
  const char* source = "";  ///< of the table
  std::vector<PresetRole> roles;
  /// A recording must have at least one of these roles; empty: no such condition.
  std::vector<const char*> any_of = {};
  /// Parameters of stage input whose values follow from the driver's units, by name.
  std::map<std::string, double> units = {};
  /// Frame that counts as base_link in recordings without a frame base_link.
  const char* base_frame = "";
  std::vector<PresetTransform> transforms = {};  ///< used if a recording has no transform to the child
};

/// Returns all presets in the order of their names.
const std::vector<DriverPreset>& driverPresets();
/// Returns the names of all presets.
std::vector<std::string> driverPresetNames();
/// Returns a preset by its name. Throws UserError with the known names for another one.
const DriverPreset& findDriverPreset(const std::string& name);

/// Returns whether a topic ends like a name of PresetRole; a suffix "/compressed" of the topic is ignored.
bool hasPresetName(const std::string& topic, std::string_view name);

/// Returns the transforms of a preset for SourceOptions::transforms, which the transforms of a recording override.
std::vector<std::string> presetTransforms(const DriverPreset& preset);

}  // namespace urban_nav_input
