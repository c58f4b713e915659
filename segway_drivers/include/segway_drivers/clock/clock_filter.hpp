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

/// A device time and the excess of its arrival.
struct ClockPoint {
  double x = 0.0;  ///< device time since the origin, s
  double z = 0.0;  ///< arrival less device time since the origin, s
};

/// Estimates the host time of device times from late arrivals: arrival = offset + (1 + skew) device time + least delay
/// + queueing, where queueing is random and never negative. The line lies below all arrivals of the window and is as
/// high as possible over the mean of those that share its floor (lower convex hull; Moon, Skelly and Towsley, INFOCOM
/// 1999; Zhang, Liu and Xia, INFOCOM 2002): stretches with a raised least delay do not count. The skew of a settled
/// line changes slowly only. An arrival clearly below the line disproves the line and begins a new epoch, and so do
/// device times that step back and arrivals that stay late by several periods. If a contradiction lasts for less than
/// five measurements, the line before it returns, in one more epoch. The least delay itself cannot be observed.
/// Deterministic. Not thread-safe.
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
  double skew() const { return now_.skew; }
  double sigma() const { return now_.sigma; }
  /// Mean delay beyond the least one over the window, s.
  double meanExcess() const { return now_.mean_excess; }

 private:
  /// What an epoch knows.
  struct Epoch {
    std::vector<ClockPoint> points;  // of the window, by device time
    std::size_t first = 0;           // of points that is in the window
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
  std::optional<Epoch> earlier_;  // before a contradiction that has lasted for less than five measurements
  int since_contradiction_ = 0;
  double origin_x_ = 0.0;
  TimeNs origin_y_ = 0;
  bool started_ = false;
  int epoch_ = 0;
};

}  // namespace segway_drivers
