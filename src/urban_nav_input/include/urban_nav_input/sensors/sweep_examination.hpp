// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/laser/cloud/sweep_reader.hpp"
#include "urban_nav_input/examination/finding.hpp"

namespace urban_nav_input {

/// Counts defects of the sweeps of one 3D LiDAR. Not thread-safe.
class SweepExamination {
 public:
  /// `topic`: name for the user, or the folder of the files. `near`: m, nearer returns were ignored.
  SweepExamination(std::string topic, urban_nav_core::CloudConvention convention, double near)
      : topic_(std::move(topic)), convention_(std::move(convention)), near_(near) {}

  /// Adds a cloud in the order of reading. `is_late`: dropped because its reference is not later than the previous
  /// one.
  void add(const urban_nav_core::ReadSweep& sweep, bool is_late);
  /// Adds a file that cannot be read, with the reason.
  void addFault(const std::string& fault);
  std::vector<Finding> findings() const;
  void archive(urban_nav_core::Archive& archive);

 private:
  void examineOrder(const urban_nav_core::Sweep& sweep);
  std::string share(std::int64_t count) const;
  void timesFindings(std::vector<Finding>& findings) const;
  void unitFinding(std::vector<Finding>& findings) const;
  void orderFindings(std::vector<Finding>& findings) const;
  void ringFindings(std::vector<Finding>& findings) const;
  void pointFindings(std::vector<Finding>& findings) const;

  std::string topic_;
  urban_nav_core::CloudConvention convention_;
  double near_;
  std::int64_t sweeps_ = 0, late_ = 0;
  std::int64_t unreadable_ = 0, truncated_ = 0, empty_ = 0, few_ = 0;
  std::string fault_;                                          // first reason of an unreadable sweep
  std::int64_t constant_ = 0, decreasing_ = 0, too_long_ = 0;  // clouds with unusable times
  std::int64_t moved_ = 0;       // clouds moved to the clock of the headers, if not all are
  std::int64_t incomplete_ = 0;  // lack more than a tenth of the rings
  std::int64_t overlaps_ = 0;
  double overlap_s_ = 0.0;                             // the longest
  std::vector<double> intervals_;                      // s, between references
  std::vector<std::int64_t> begins_;                   // references at the begin of each interval, ns
  std::vector<float> invalid_, near_shares_, counts_;  // by sweep: shares of its points, number of its beams
  std::int64_t last_reference_ = 0, last_end_ = 0;
};

}  // namespace urban_nav_input
