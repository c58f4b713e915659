// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "urban_nav_core/camera/camera_info.hpp"
#include "urban_nav_sim/defect.hpp"
#include "urban_nav_sim/fault.hpp"
#include "urban_nav_sim/lidar_model.hpp"
#include "urban_nav_sim/light.hpp"
#include "urban_nav_sim/measurement.hpp"

namespace urban_nav_sim {

/// Options of a session. Equal options give equal bytes for any number of threads.
struct SessionOptions {
  std::string world = "quad", route = "loops";
  std::uint32_t seed = 1;
  int day = 1;               ///< 1, 2, ...
  Light light = Light::Day;  ///< seen by the cameras; truth, motion and the other sensors are the same in each
  double duration = 60.0;    ///< s
  std::set<Sensor> sensors{kDefaultSensors.begin(), kDefaultSensors.end()};
  LidarModel lidar;  ///< if lidar3d is among the sensors
  Defects defects;
  std::set<Sensor> views;  ///< cameras and lasers for which the true depth and class are also output (ViewTruth)
  std::vector<Fault> faults;
  std::string where = "--";  ///< prefix of option names in errors
};

/// Throws UserError for an unknown world or route, or a sensor without views, listing the valid ones. Same checks as
/// the constructor of Session, without its work.
void checkPlace(const SessionOptions& options);

/// A session of the simulated robot. Its constructor throws the errors of checkPlace(). Not thread-safe; uses as many
/// threads as urban_nav_core::ThreadLimit permits.
class Session {
 public:
  explicit Session(const SessionOptions& options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  struct Arrival {
    Measurement measurement;
    urban_nav_core::StampNs taken = 0;  ///< true time of measurement, independent of its stamp
  };
  /// Returns the next measurement, in the order of true times; nullopt at the end.
  std::optional<Arrival> next();
  /// Returns the true pose of the robot at a true time.
  urban_nav_core::Pose truth(urban_nav_core::StampNs taken) const;

  /// Returns the true stamp of t = 0.
  urban_nav_core::StampNs begin() const;
  double duration() const;
  /// Returns the number of stereo pairs, for progress.
  std::int64_t frames() const;

  /// Returns T_base_sensor by frame. Raw stereo images (defect Lens) have the frames of the mounted cameras.
  std::map<std::string, urban_nav_core::Pose> places() const;
  urban_nav_core::CameraInfo stereoInfo(Side side) const;
  urban_nav_core::CameraInfo ladybugInfo(int camera) const;  ///< 0 ... 4

  /// Writes trajectory.tum, revisits.csv, closures_true.csv, closures_false.csv (`false_closures` per cent of the true
  /// ones, if not zero), cloud.ply (docs/files.md) and clocks.csv (`sensor,offset_s,skew,jitter_s`: errors of stamps)
  /// into an existing folder. Independent of the selected sensors.
  void writeTruth(const std::string& folder, double false_closures) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Returns each world with its routes, a line per route, for --help.
std::string worldHelp();

}  // namespace urban_nav_sim
