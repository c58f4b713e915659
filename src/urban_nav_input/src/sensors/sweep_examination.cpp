// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/sensors/sweep_examination.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/trajectory/statistics.hpp"

namespace urban_nav_input {

using urban_nav_core::formatNumber;
using urban_nav_core::PointTimesFault;
using urban_nav_core::ReadSweep;
using urban_nav_core::Sweep;

namespace {

constexpr std::size_t kFewBeams = 1000;  // per sweep; fewer do not constrain a pose in all directions
constexpr double kFewSweeps = 0.05;      // share of sweeps: above it, a finding
constexpr double kManyInvalid = 0.9;     // share of points; organised clouds outdoors have up to 70 % invalid points
constexpr double kManyNear = 0.1;        // share of valid points
constexpr double kSweepGap = 1.7;        // median intervals without a sweep
constexpr double kOverlap = 0.2;         // of the duration of a sweep
constexpr double kFewRings = 0.9;        // of the rings

std::string inPercent(double share) { return formatNumber(100.0 * share, 3) + " %"; }

double computeMedian(const std::vector<float>& values) {
  return urban_nav_core::quantile(std::vector<double>(values.begin(), values.end()), 0.5);
}

/// `is_rounded`: the field has been converted to single precision.
Finding constantFinding(const std::string& field, const std::string& consequence, bool is_rounded) {
  if (!is_rounded)
    return {FindingKind::SweepTimes, field + " has the same time for all points of a cloud" + consequence,
            "let the driver write the time of each point"};
  return {FindingKind::SweepTimes,
          field +
              " was converted to single precision, in which all points of a sweep have the same time; the times "
              "within a sweep follow from the rotation of the LiDAR, with the stamp of the header in their middle",
          "let the driver write the field as it was measured, as float64 or relative to the header"};
}

}  // namespace

std::string SweepExamination::share(std::int64_t count) const {
  return std::to_string(count) + " of " + std::to_string(sweeps_) + " sweeps";
}

void SweepExamination::addFault(const std::string& fault) {
  ++sweeps_;
  if (unreadable_++ == 0) fault_ = fault;
}

void SweepExamination::add(const ReadSweep& read, bool is_late) {
  if (!read.fault.empty()) {
    addFault(read.fault);
    return;
  }
  ++sweeps_;
  truncated_ += read.missing > 0;
  const Sweep& sweep = read.sweep;
  const auto points = static_cast<float>(std::max<std::size_t>(1, read.points));
  const auto measured = static_cast<float>(std::max<std::size_t>(1, read.points - read.invalid));
  invalid_.push_back(static_cast<float>(read.invalid) / points);
  near_shares_.push_back(static_cast<float>(read.near) / measured);
  counts_.push_back(static_cast<float>(sweep.beams.size()));
  if (read.invalid == read.points) {
    ++empty_;
    return;
  }
  few_ += sweep.beams.size() < kFewBeams;
  constant_ += read.times == ReadSweep::Times::Constant;
  decreasing_ += read.times == ReadSweep::Times::Decreasing;
  too_long_ += read.times == ReadSweep::Times::Span;
  moved_ += read.clock != 0.0 && convention_.fault != PointTimesFault::Clock;
  if (convention_.are_rings_known)
    incomplete_ += static_cast<double>(read.rings) < kFewRings * static_cast<double>(convention_.ring_count);
  if (is_late) ++late_;
  else examineOrder(sweep);
}

void SweepExamination::examineOrder(const Sweep& sweep) {
  const auto half = static_cast<std::int64_t>(0.5e9 * sweep.duration);
  const bool is_timed = sweep.times == Sweep::Times::Measured;
  const std::int64_t begin = is_timed && !sweep.beams.empty() ? sweep.beams.front().stamp : sweep.reference - half;
  if (last_reference_ != 0) {
    intervals_.push_back(urban_nav_core::secondsBetween(last_reference_, sweep.reference));
    begins_.push_back(last_reference_);
    const double overlap = urban_nav_core::secondsBetween(begin, last_end_);
    if (is_timed && overlap > kOverlap * sweep.duration) {
      ++overlaps_;
      overlap_s_ = std::max(overlap_s_, overlap);
    }
  }
  last_reference_ = sweep.reference;
  last_end_ = is_timed && !sweep.beams.empty() ? sweep.beams.back().stamp : sweep.reference + half;
}

void SweepExamination::unitFinding(std::vector<Finding>& findings) const {
  const std::string stated = urban_nav_core::printPointTimes(convention_.times);
  if (too_long_ + constant_ == 0) {
    findings.push_back({FindingKind::SweepTimes,
                        topic_ + ": the values of field " + convention_.suspect + " fit a sweep in the unit " +
                            toString(convention_.times.unit) + ", not in s as usual for this field; read as " + stated,
                        "no action needed; the option sets the unit that was found",
                        false,
                        {"--set", "input.points_time=" + stated}});
    return;
  }
  findings.push_back({FindingKind::SweepTimes,
                      topic_ + ": by input.points_time = " + stated + " the times of a sweep span " +
                          (too_long_ > 0 ? "more than 1 s" : "nothing") +
                          ": the unit is wrong, and sweeps are not deskewed",
                      "--set input.points_time=auto determines the unit from the values",
                      false,
                      {"--set", "input.points_time=auto"}});
}

void SweepExamination::timesFindings(std::vector<Finding>& findings) const {
  const std::string consequence = "; sweeps are not deskewed, and their covariance contains the resulting error";
  const std::string field = topic_ + ": field " + convention_.suspect;
  const auto append = [&](FindingKind kind, const std::string& text, const std::string& remedy) {
    findings.push_back({kind, text, remedy});
  };
  switch (convention_.fault) {
    case PointTimesFault::None: break;
    case PointTimesFault::Absent:
      append(
          FindingKind::SweepTimes, topic_ + ": clouds without times of the points" + consequence,
          "let the driver write the time of each point; --set input.points_time=FIELD,UNIT,REFERENCE names the field "
          "that holds it");
      break;
    case PointTimesFault::Constant:
      findings.push_back(constantFinding(field, consequence, convention_.times.areKnown()));
      break;
    case PointTimesFault::Decreasing:
      append(FindingKind::SweepTimes,
             field + " decreases from the first point of a cloud to the last: times and the order of points disagree" +
                 consequence,
             "check the sign of the times in the driver; --set input.points_time=" + convention_.suspect +
                 ",UNIT,REFERENCE uses them as they are");
      break;
    case PointTimesFault::Unit: unitFinding(findings); break;
    case PointTimesFault::Clock:
      append(FindingKind::ClockApart,
             field + " is " + formatNumber(std::abs(convention_.clock), 6) + " s " +
                 (convention_.clock > 0.0 ? "later" : "earlier") +
                 " than the stamps of the headers: a different clock; the stamps of the headers are used",
             "synchronise the LiDAR's clock (PTP, with UTC), or let the driver stamp headers by it");
      break;
  }
  if (convention_.fault == PointTimesFault::Unit) return;
  if (constant_ > 0 && convention_.times.areKnown())
    append(FindingKind::SweepTimes,
           topic_ + ": " + share(constant_) +
               " have the same time for all points, and are "
               "not deskewed",
           "no action needed if they are few; check the driver otherwise");
  if (decreasing_ > 0 && convention_.times.areKnown())
    append(FindingKind::SweepTimes,
           topic_ + ": the times of " + share(decreasing_) + " decrease from point to point, and are not used",
           "check the sign of the times in the driver");
  if (too_long_ > 0)
    append(FindingKind::SweepTimes,
           topic_ + ": the times of " + share(too_long_) + " span more than 1 s, and are not used",
           "check the driver, and its packets on the network");
  if (moved_ > 0)
    append(FindingKind::ClockApart,
           topic_ + ": the times of the points of " + share(moved_) +
               " are more than 1 s from the stamps of their headers; the stamps of the headers are used",
           "synchronise the LiDAR's clock (PTP) before recording");
}

void SweepExamination::orderFindings(std::vector<Finding>& findings) const {
  if (late_ > 0)
    findings.push_back({FindingKind::SweepOverlap,
                        topic_ + ": " + share(late_) + " are not later than the previous sweep and are not used",
                        "record the topic once; check the clock of the LiDAR"});
  if (overlaps_ > 0)
    findings.push_back({FindingKind::SweepOverlap,
                        topic_ + ": " + share(overlaps_) + " begin before the end of the previous sweep, by up to " +
                            formatNumber(overlap_s_, 3) + " s: they overlap",
                        "check whether two sensors publish on this topic, and the unit and the reference of the times "
                        "(--set input.points_time=FIELD,UNIT,REFERENCE)"});
  if (intervals_.size() < 3) return;
  const double usual = urban_nav_core::quantile(intervals_, 0.5);
  std::int64_t gaps = 0, lost = 0;
  std::size_t longest = 0;
  for (std::size_t i = 0; i < intervals_.size(); ++i) {
    if (!(intervals_[i] > kSweepGap * usual)) continue;
    ++gaps;
    lost += std::llround(intervals_[i] / usual) - 1;
    if (gaps == 1 || intervals_[i] > intervals_[longest]) longest = i;
  }
  if (gaps == 0) return;
  findings.push_back({FindingKind::SweepGap,
                      topic_ + ": " + std::to_string(gaps) + (gaps == 1 ? " gap" : " gaps") + " between sweeps, some " +
                          std::to_string(lost) + " sweeps lost, the longest gap " +
                          formatNumber(intervals_[longest], 3) + " s after " +
                          urban_nav_core::printStamp(begins_[longest]) + " (median interval " + formatNumber(usual, 3) +
                          " s)",
                      "check the network and the buffers of driver and recorder; over a gap the motion is predicted"});
}

void SweepExamination::ringFindings(std::vector<Finding>& findings) const {
  if (!convention_.are_rings_sorted)
    findings.push_back({FindingKind::RingOrder,
                        topic_ + ": the numbers in field " + convention_.ring_field +
                            " do not follow the elevation of the rings: they follow the firing order, and are "
                            "renumbered by elevation",
                        "no action needed; other programs need a driver that numbers rings by elevation"});
  if (!convention_.absent_rings.empty()) {
    std::string numbers;
    constexpr std::size_t kMostNamed = 8;
    for (std::size_t i = 0; i < convention_.absent_rings.size() && i < kMostNamed; ++i)
      numbers += (i == 0 ? "" : ", ") + std::to_string(convention_.absent_rings[i]);
    findings.push_back({FindingKind::RingOrder,
                        topic_ + ": " + std::to_string(convention_.absent_rings.size()) + " of " +
                            std::to_string(convention_.ring_count) + " rings have no points: " + numbers +
                            (convention_.absent_rings.size() > kMostNamed ? " ..." : ""),
                        "no action needed if the driver leaves them out; otherwise lasers have failed or their "
                        "packets are lost"});
  }
  const bool are_many = static_cast<double>(incomplete_) > kFewSweeps * static_cast<double>(sweeps_);
  if (are_many && 2 * incomplete_ < sweeps_)
    findings.push_back({FindingKind::RingOrder,
                        topic_ + ": " + share(incomplete_) + " lack more than a tenth of the rings",
                        "check the network: packets of the LiDAR are lost"});
}

void SweepExamination::pointFindings(std::vector<Finding>& findings) const {
  if (unreadable_ > 0)
    findings.push_back({FindingKind::PointsInvalid, topic_ + ": " + share(unreadable_) + " cannot be read: " + fault_,
                        "check the driver; the clouds need fields x, y and z with one number each"});
  if (truncated_ > 0)
    findings.push_back({FindingKind::PointsInvalid,
                        topic_ + ": " + share(truncated_) + " have fewer points than declared",
                        "check the driver, and whether the recording is damaged"});
  if (empty_ > 0) {
    Finding finding{FindingKind::PointsInvalid,
                    topic_ + ": " + share(empty_) + " have no valid points: all are NaN or at the origin",
                    "check the driver and whether the LiDAR is covered"};
    findings.push_back(finding);
  }
  if (counts_.empty() || empty_ == sweeps_) return;
  if (const double invalid = computeMedian(invalid_); invalid > kManyInvalid && empty_ * 2 < sweeps_)
    findings.push_back(
        {FindingKind::PointsInvalid,
         topic_ + ": " + inPercent(invalid) + " of the points of a sweep are not finite or at the origin",
         "check the driver and whether the LiDAR is covered"});
  if (static_cast<double>(few_) > kFewSweeps * static_cast<double>(sweeps_))
    findings.push_back({FindingKind::PointsFew,
                        topic_ + ": " + share(few_) + " have few points: fewer than " + std::to_string(kFewBeams) +
                            ", the median of all is " + formatNumber(computeMedian(counts_), 6) + " points",
                        "publish whole sweeps, not single packets, and do not thin them before recording"});
  if (const double near = computeMedian(near_shares_); near > kManyNear)
    findings.push_back({FindingKind::PointsNear,
                        topic_ + ": " + inPercent(near) + " of the returns are within " + formatNumber(near_, 3) +
                            " m of the LiDAR: it is covered, or hits the robot itself; they are not used",
                        "mount the LiDAR higher or mask these directions in the driver; --set input.points_near=M "
                        "sets another limit, m"});
}

std::vector<Finding> SweepExamination::findings() const {
  std::vector<Finding> findings;
  if (sweeps_ == 0) return findings;
  if (convention_.clouds > 0) timesFindings(findings);
  orderFindings(findings);
  ringFindings(findings);
  pointFindings(findings);
  return findings;
}

void SweepExamination::archive(urban_nav_core::Archive& archive) {
  archive(convention_, sweeps_, late_, unreadable_, truncated_, empty_, few_, fault_, constant_, decreasing_, too_long_,
          moved_, incomplete_, overlaps_, overlap_s_, intervals_, begins_, invalid_, near_shares_, counts_,
          last_reference_, last_end_);
  archive.require(intervals_.size() == begins_.size(), "intervals without their begin");
}

}  // namespace urban_nav_input
