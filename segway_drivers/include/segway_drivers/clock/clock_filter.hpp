// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "segway_drivers/stream/bytes.hpp"

namespace segway_drivers {

/// Prior knowledge of a device clock.
struct ClockOptions {
  double period = 0.01;            ///< s, nominal spacing of the device times
  double tolerance = 200e-6;       ///< s/s, largest skew expected
  double hard_tolerance = 200e-6;  ///< s/s, largest skew accepted if shown by the data
  double max_skew_change = 2e-6;   ///< s/s, accepted change of the skew between estimates in service
  double window = 120.0;           ///< s of device time used for the estimate
  double settling = 0.5;           ///< s after a start of unknown offset without an estimate
};

/// Estimate for one device time.
struct ClockEstimate {
  std::optional<TimeNs> time;  ///< host time of the event plus the constant minimum delay, ns; empty while settling
  double sigma = 0.0;          ///< s, standard deviation beyond the minimum delay
  int epoch = 0;               ///< increases when the estimate restarts; times increase within an epoch
};

/// A device time and the excess of its arrival.
struct ClockPoint {
  double x = 0.0;  ///< device time since the origin, s
  double z = 0.0;  ///< arrival minus device time since the origin, s
};

/// Estimates the host time of device times from delayed arrivals: arrival = offset + (1 + skew) device time + minimum
/// delay + queueing, where queueing is random and non-negative. The line lies below all arrivals of the window and is
/// as high as possible over the mean of those that share its floor (lower convex hull; Moon, Skelly and Towsley,
/// INFOCOM 1999; Zhang, Liu and Xia, INFOCOM 2002): intervals with a raised minimum delay are excluded. The skew of a
/// settled line changes only slowly. An arrival clearly below the line contradicts it and begins a new epoch, as do
/// device times that step back and arrivals that remain late by several periods. If a contradiction lasts for less than
/// five measurements, the previous line is restored, in one more epoch. The minimum delay itself is not observable.
/// Deterministic. Not thread-safe.
class ClockFilter {
 public:
  explicit ClockFilter(const ClockOptions& options);

  /// Adds a device time, s, and its arrival, ns, in order of arrival. A repeated device time returns its estimate and
  /// is not used.
  ClockEstimate add(double device_s, TimeNs arrival);
  /// Returns the estimate for a device time on the current line, without adding it or slewing. Empty before the first
  /// estimate.
  ClockEstimate estimate(double device_s) const;
  /// Begins a new epoch with unknown offset, as after a restart of the device.
  void restart();

  int epoch() const { return epoch_; }
  /// Returns host time minus device time at the latest device time, s; 0 before the first.
  double offset() const;
  /// Host seconds per device second minus 1.
  double skew() const { return now_.skew; }
  double sigma() const { return now_.sigma; }
  /// Returns the mean delay beyond the minimum over the window, s.
  double meanExcess() const { return now_.mean_excess; }

 private:
  /// State of an epoch.
  struct Epoch {
    std::vector<ClockPoint> points;  // of the window, by device time
    std::size_t first = 0;           // first point in the window
    double begin_x = 0.0, declared_x = 0.0, last_x = 0.0, next_fit = 0.0;
    double line = 0.0, skew = 0.0;  // z = line + skew (x - begin_x)
    double prior_skew = 0.0, prior_sigma = 0.0, skew_sigma = 0.0, accepted_at = 0.0;
    double sigma = 0.0, mean_excess = 0.0, mean_x = 0.0;
    bool offset_known = false, skew_known = false;
    std::optional<double> spacing;  // s, in height, between low delays
    std::optional<ClockPoint> late_since;
    std::optional<double> published;  // host time since origin_y_ of the latest estimate of this epoch, s
    double published_x = 0.0;
  };

  void beginEpoch(const ClockPoint& point, bool offset_known, bool keep_latest);
  void contradict(const ClockPoint& point, bool offset_known, bool keep_latest);
  bool returnToEarlier(const ClockPoint& point, bool is_contradicted);
  double residual(const Epoch& epoch, const ClockPoint& point) const;
  bool isDisproved(double residual, double age) const;
  bool isPersistentlyLate(const ClockPoint& point, double residual);
  void addPoint(const ClockPoint& point);
  void fit();
  void acceptSkew(double slope, double slope_sigma, double age);
  void updateSigma(double x);
  TimeNs toStamp(double x);

  ClockOptions options_;
  Epoch now_;
  std::optional<Epoch> earlier_;  // before a contradiction of fewer than five measurements
  int since_contradiction_ = 0;
  double origin_x_ = 0.0;
  TimeNs origin_y_ = 0;
  bool started_ = false;
  int epoch_ = 0;
};

}  // namespace segway_drivers
