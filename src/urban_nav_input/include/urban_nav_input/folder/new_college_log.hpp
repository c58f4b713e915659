// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_input/folder/alog.hpp"

namespace urban_nav_input {

/// Content of the New College log, in REP-103 axes and SI units (Smith, Baldwin, Churchill, Paul, Newman, IJRR 2009;
/// conventions determined from the log). Stamps are the `time=` of the values, Unix time.
enum class Side { Left, Right };

/// A scan of one of the two vertical lasers. Angles are those of the frame laser_left or laser_right: x along beam 90
/// deg, z forward.
struct NewCollegeScan {
  urban_nav_core::StampNs stamp = 0;
  Side side = Side::Left;
  std::int64_t id = 0;              ///< incremented per scan: a gap is a lost scan
  urban_nav_core::PlanarScan scan;  ///< ranges <= 0 of the log become 0; intensities are the reflectances
};

/// Wheel odometry with the tilt of the vehicle.
struct NewCollegeOdometry {
  urban_nav_core::StampNs stamp = 0;
  urban_nav_core::Pose
      T_odom_base;          ///< x, y, yaw from ODOMETRY_POSE; roll and pitch from the RAW row of the same stamp
  double speed = 0.0;       ///< m/s, forward
  double yaw_rate = 0.0;    ///< rad/s, from neighbouring headings, since that of the log is invalid
  double pitch_rate = 0.0;  ///< rad/s
};

/// The images of one panorama: base names, by camera.
struct NewCollegePanorama {
  urban_nav_core::StampNs stamp = 0;
  std::vector<std::string> files;
};

using NewCollegeEvent = std::variant<NewCollegeScan, NewCollegeOdometry, NewCollegePanorama>;
urban_nav_core::StampNs toStamp(const NewCollegeEvent& event);
/// Numbers of events of a New College log, and of its gaps.
struct NewCollegeCounts {
  std::int64_t scans_left = 0, scans_right = 0;
  std::int64_t scans_lost = 0;  ///< gaps in the ids
  std::int64_t odometry = 0;
  std::int64_t odometry_without_tilt = 0;  ///< no RAW row of the same stamp: roll and pitch are 0
  std::int64_t panoramas = 0;
  std::int64_t out_of_order = 0;               ///< more than two seconds late: left out
  std::map<std::string, std::int64_t> unused;  ///< rows of other variables, by name
};

/// Reads a log in order of stamps, through a window of two seconds, in bounded memory.
class NewCollegeLog {
 public:
  /// Throws UserError if the file cannot be opened.
  explicit NewCollegeLog(const std::string& path);

  /// Returns the next event; nullopt at the end. Throws UserError with file and line for a damaged or truncated row of
  /// a known variable. Counts rows of other variables.
  std::optional<NewCollegeEvent> next();
  const NewCollegeCounts& counts() const { return counts_; }

 private:
  /// RAW_ODOMETRY_POSE, which waits for the ODOMETRY_POSE of its stamp; in the log's frame, rad and rad/s.
  struct Tilt {
    double pitch = 0.0, roll = 0.0, pitch_rate = 0.0;
  };
  using Waiting = std::multimap<urban_nav_core::StampNs, NewCollegeEvent>;

  void take(const AlogRow& row);
  void put(NewCollegeEvent event);
  NewCollegeScan scan(const AlogRow& row, Side side);
  NewCollegeEvent release(Waiting::iterator at);
  void complete(NewCollegeOdometry& odometry);
  double yawRate(const NewCollegeOdometry& odometry) const;
  /// Returns the time of the value, which must be near the time of logging.
  urban_nav_core::StampNs computeTime(const AlogRow& row, const AlogFields& fields) const;

  std::string path_;
  AlogReader reader_;
  NewCollegeCounts counts_;
  Waiting waiting_;
  std::map<urban_nav_core::StampNs, Tilt> tilts_;
  std::optional<urban_nav_core::StampNs> newest_, released_;
  std::optional<NewCollegeOdometry> last_odometry_;
  std::map<Side, std::int64_t> last_id_;
  bool ended_ = false;
};

}  // namespace urban_nav_input
