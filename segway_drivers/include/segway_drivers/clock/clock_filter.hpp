// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "segway_drivers/stream/bytes.hpp"

namespace segway_drivers {

/// What is known about a device clock in advance.
struct ClockOptions {
  double period = 0.01;            ///< s, nominal spacing of the device times
  double tolerance = 200e-6;       ///< s/s, largest skew expected
  double hard_tolerance = 200e-6;  ///< s/s, largest skew accepted once the data show it
  double max_skew_change = 2e-6;   ///< s/s, accepted change of the skew between estimates in service
  double window = 120.0;           ///< s of device time used for the estimate
  double settling = 0.5;           ///< s after a start of unknown offset without an estimate
};

/// Estimate for one device time.
struct ClockEstimate {
  std::optional<TimeNs> time;  ///< host time of the event plus the constant least delay, ns; empty while settling
  double sigma = 0.0;          ///< s, standard deviation beyond the least delay
  int epoch = 0;               ///< increases when the estimate began again; times increase within an epoch
};

/// Estimates the host time of device times from late arrivals: arrival = offset + (1 + skew) device time + least delay
/// + queueing, where queueing is random and never negative. The line lies below all arrivals of the window and is as
/// high as possible over their mean (lower convex hull; Moon, Skelly and Towsley, INFOCOM 1999; Zhang, Liu and Xia,
/// INFOCOM 2002). The skew of a settled line changes slowly only, so that a temporary rise of the least delay does not
/// tilt it. An arrival clearly below the line disproves the line and begins a new epoch, and so do device times that
/// step back and arrivals that stay late by several periods. The least delay itself cannot be observed. Deterministic.
/// Not thread-safe.
class ClockFilter {
 public:
  explicit ClockFilter(const ClockOptions& options);

  /// Adds a device time, s, and its arrival, ns, in order of arrival. A repeated device time gives its estimate and is
  /// not used.
  ClockEstimate add(double device_s, TimeNs arrival);
  /// Estimate for a device time on the present line, without adding it; not slewed. Empty before the first estimate.
  ClockEstimate estimate(double device_s) const;
  /// Begins a new epoch in which the offset is unknown, as after a restart of the device.
  void restart();

  int epoch() const { return epoch_; }
  /// Host time minus device time at the latest device time, s; 0 before the first.
  double offset() const;
  /// Host seconds per device second minus 1.
  double skew() const { return skew_; }
  double sigma() const { return sigma_; }
  /// Mean delay beyond the least one over the window, s.
  double meanExcess() const { return mean_excess_; }

 private:
  struct Point {
    double x = 0.0, z = 0.0;  // device time and arrival minus device time since the origin, s
  };

  void begin(const Point& point, bool offset_known, bool keep_latest);
  bool isDisproved(double residual, double age) const;
  bool isPersistentlyLate(const Point& point, double residual);
  void addPoint(const Point& point);
  void fit();
  double hullSlope(double mean_x);
  void updateSigma(double x);
  TimeNs toStamp(double x);

  ClockOptions options_;
  std::vector<Point> points_;  // of the window, by device time
  std::size_t first_ = 0;      // of points_ that is in the window
  std::vector<Point> hull_;
  double sum_x_ = 0.0, sum_z_ = 0.0;  // of the points in the window, x since begin_x_
  double origin_x_ = 0.0;
  TimeNs origin_y_ = 0;
  double begin_x_ = 0.0, declared_x_ = 0.0, last_x_ = 0.0, next_fit_ = 0.0;
  double line_ = 0.0, skew_ = 0.0;  // z = line_ + skew_ (x - begin_x_)
  double prior_skew_ = 0.0, prior_sigma_ = 0.0, skew_sigma_ = 0.0, accepted_at_ = 0.0;
  double sigma_ = 0.0, mean_excess_ = 0.0;
  bool started_ = false, offset_known_ = false, skew_known_ = false;
  std::optional<Point> late_since_;
  int epoch_ = 0;
  std::optional<double> published_;  // host time since origin_y_ of the latest estimate of this epoch, s
  double published_x_ = 0.0;
};

}  // namespace segway_drivers
