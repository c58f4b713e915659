// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "convert/bag_writer.hpp"
#include "simulate/calibration_errors.hpp"
#include "urban_nav_sim/ros/measurement_messages.hpp"

namespace urban_nav {

/// The bag of a simulated session, or BAG_STEM_0.bag, BAG_STEM_1.bag, ... of equal length, as `rosbag record --split`
/// names them: each appears when it is complete, the last (or only) one with commit(). Each begins with the static
/// transforms. `session` must outlive the object. Throws the errors of BagWriter.
class SessionBags {
 public:
  /// `part`: s of the session in a bag; 0: all of it.
  SessionBags(std::string path, double part, const urban_nav_sim::Session& session, CalibrationErrors errors);

  /// `taken`: time of receipt by a recorder, which must not decrease; independent of the stamp in the header.
  void write(const urban_nav_sim::Measurement& measurement, urban_nav_core::StampNs taken);
  void commit();

  /// After commit(): bags in order, and number of messages by topic in all of them.
  const std::vector<std::string>& paths() const { return paths_; }
  const std::map<std::string, std::int64_t>& counts() const { return counts_; }
  /// Returns a file of a longer session written here before, which could be taken for the next part; empty: none.
  std::string leftover() const;

 private:
  std::string makePath(std::size_t number) const;
  void begin();
  void end();

  std::string path_;
  urban_nav_core::StampNs part_;  // ns; 0: no parts
  const urban_nav_sim::Session& session_;
  const CalibrationErrors errors_;
  urban_nav_sim::MeasurementMessages messages_;
  std::vector<std::string> paths_;
  std::optional<BagWriter> bag_;
  std::map<std::string, std::int64_t> counts_;
};

}  // namespace urban_nav
