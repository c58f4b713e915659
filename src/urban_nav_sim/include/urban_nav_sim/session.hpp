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
#include "urban_nav_sim/measurement.hpp"

namespace urban_nav_sim {

/// What is driven. Equal options give equal bytes, whatever the number of threads.
struct SessionOptions {
  std::string world = "quad", route = "loops";
  std::uint32_t seed = 1;
  int day = 1;             ///< 1, 2, ...
  double duration = 60.0;  ///< s
  std::set<Sensor> sensors{kDefaultSensors.begin(), kDefaultSensors.end()};
  LidarModel lidar;  ///< if lidar3d is among the sensors
  Defects defects;
  std::set<Sensor> views;  ///< of these cameras and lasers, what each pixel and beam truly met too (ViewTruth)
  std::vector<Fault> faults;
  std::string where = "--";  ///< what stands before the name of an option in an error
};

/// Throws UserError where there is no such world or route, or no view of a sensor, naming those there are: what the
/// constructor of Session does first, without the work.
void checkPlace(const SessionOptions& options);

/// A session of the simulated robot. Its constructor throws as checkPlace does. Not thread-safe; works on as many
/// threads as urban_nav_core::ThreadLimit allows.
class Session {
 public:
  explicit Session(const SessionOptions& options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  struct Arrival {
    Measurement measurement;
    urban_nav_core::StampNs taken = 0;  ///< when it was truly taken, whatever its stamp says
  };
  /// The next one, in the order in which they were taken; empty at the end.
  std::optional<Arrival> next();
  /// Where the robot truly was at a time that is not a fault's.
  urban_nav_core::Pose truth(urban_nav_core::StampNs taken) const;

  /// True stamp of t = 0.
  urban_nav_core::StampNs begin() const;
  double duration() const;
  /// Stereo pairs, to show how far it is.
  std::int64_t frames() const;

  /// T_base_sensor by frame. Raw stereo images (defect Lens) have the frames of the cameras as they are mounted.
  std::map<std::string, urban_nav_core::Pose> places() const;
  urban_nav_core::CameraInfo stereoInfo(Side side) const;
  urban_nav_core::CameraInfo ladybugInfo(int camera) const;  ///< 0 ... 4

  /// trajectory.tum, revisits.csv, closures_true.csv, closures_false.csv (if `false_closures` is not zero: their per
  /// cent of the true ones), cloud.ply (docs/files.md), clocks.csv (`sensor,offset_s,skew,jitter_s`: by how much stamps
  /// are off) into a folder that exists. What sensors there are does not matter.
  void writeTruth(const std::string& folder, double false_closures) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// For --help: each world with its routes, a line a route.
std::string worldHelp();

}  // namespace urban_nav_sim
