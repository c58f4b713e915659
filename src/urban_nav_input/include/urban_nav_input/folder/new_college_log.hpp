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

/// What the New College log holds, in REP-103 axes and SI units (Smith, Baldwin, Churchill, Paul, Newman, IJRR 2009;
/// the conventions were read off the log itself). Stamps are the values' own `time=`, Unix time.
enum class Side { Left, Right };

/// A turn of one of the two vertical lasers. Angles are those of the frame laser_left or laser_right: x along beam 90
/// deg, z forward.
struct NewCollegeScan {
  urban_nav_core::StampNs stamp = 0;
  Side side = Side::Left;
  std::int64_t id = 0;              ///< counts on by one per turn: a gap is a lost scan
  urban_nav_core::PlanarScan scan;  ///< ranges <= 0 of the log are 0 here; reflectances are the intensities
};

/// Wheel odometry with the tilt of the vehicle.
struct NewCollegeOdometry {
  urban_nav_core::StampNs stamp = 0;
  urban_nav_core::Pose
      T_odom_base;          ///< x, y, yaw from ODOMETRY_POSE; roll and pitch from the RAW row of the same stamp
  double speed = 0.0;       ///< m/s, forward
  double yaw_rate = 0.0;    ///< rad/s, from neighbouring headings: the log's own is spoilt
  double pitch_rate = 0.0;  ///< rad/s
};

/// The pictures of one panorama: base names, by camera.
struct NewCollegePanorama {
  urban_nav_core::StampNs stamp = 0;
  std::vector<std::string> files;
};

using NewCollegeEvent = std::variant<NewCollegeScan, NewCollegeOdometry, NewCollegePanorama>;
urban_nav_core::StampNs toStamp(const NewCollegeEvent& event);

struct NewCollegeCounts {
  std::int64_t scans_left = 0, scans_right = 0;
  std::int64_t scans_lost = 0;  ///< gaps in the ids
  std::int64_t odometry = 0;
  std::int64_t odometry_without_tilt = 0;  ///< no RAW row of the same stamp: roll and pitch are 0
  std::int64_t panoramas = 0;
  std::int64_t out_of_order = 0;               ///< came more than two seconds late: left out
  std::map<std::string, std::int64_t> unused;  ///< rows of other variables, by name
};

/// Reads a log in order of stamps, through a window of two seconds, in bounded memory.
class NewCollegeLog {
 public:
  /// Throws UserError where the file cannot be opened.
  explicit NewCollegeLog(const std::string& path);

  /// The next event; empty at the end. Throws UserError with file and line for a row of a known variable that is
  /// damaged, also where the file was cut off within one. Rows of other variables are
  /// counted.
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
  /// The value's own time, which must be near the one at which it was logged.
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
