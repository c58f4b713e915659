// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/examination/pair_check.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/trajectory/statistics.hpp"
#include "urban_nav_ros/image_features.hpp"

namespace urban_nav_input {

using urban_nav_core::ImageView;
using urban_nav_core::StampNs;
using urban_nav_ros::extractFeatures;
using urban_nav_ros::ImageFeatures;
using urban_nav_ros::matchFeatures;

namespace {

constexpr int kFewFeatures = 100;                                 // per image; fewer are not matched
constexpr int kFewMatches = 15;                                   // on neighbouring rows, for a pair of the same scene
constexpr double kMaxRowError = 20.0, kSameRow = 1.5;             // px
constexpr double kOffsetTolerance = 0.8, kCornerTolerance = 1.6;  // px: above, stereo along rows loses features
constexpr double kConsistentRows = 4.0, kLeastConsistent = 0.3;   // px; share of matches
constexpr double kMaxScatter = 1.3;                               // px, root mean square
constexpr int kMinPairs = 3;

int countOnRow(const ImageFeatures& left, const ImageFeatures& right) {
  int count = 0;
  for (const cv::DMatch& found : matchFeatures(left, right)) {
    const float dv = right.points[static_cast<std::size_t>(found.trainIdx)].pt.y -
                     left.points[static_cast<std::size_t>(found.queryIdx)].pt.y;
    count += std::abs(dv) < kSameRow;
  }
  return count;
}

double medianValue(const std::vector<double>& values) { return urban_nav_core::quantile(values, 0.5); }

/// Returns the topics of the two cameras, exchanged, as options; each calibration stays with its side.
std::vector<std::string> exchangeOptions(const SourceInfo& info) {
  std::vector<std::string> options;
  for (const auto& [role, topic] : info.topics) {
    const std::string other = role == "left" ? "right" : role == "right" ? "left" : role;
    options.insert(options.end(), {"--topic", other + ":=" + topic});
  }
  return options;
}

std::string printed(double value) { return urban_nav_core::formatNumber(value, 3); }
std::string percent(double share) { return printed(100.0 * share) + " %"; }

}  // namespace

PairCheck::Grey PairCheck::measureGrey(const ImageView& image) {
  Grey grey;
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u) {
      const std::uint8_t value = image.at(u, v);
      grey.mean += value;
      grey.bright += value > 251;
    }
  const double pixels = static_cast<double>(image.width) * image.height;
  return {grey.mean / pixels, grey.bright / pixels};
}

void PairCheck::add(const ImageView& left, const ImageView& right, const ImageView& right_before,
                    const ImageView& right_after) {
  if (left.empty() || right.empty()) return;
  ++pairs_;
  half_width_ = 0.5 * left.width, half_height_ = 0.5 * left.height;
  left_.push_back(measureGrey(left));
  right_.push_back(measureGrey(right));
  const ImageFeatures on_left = extractFeatures(left), on_right = extractFeatures(right);
  if (static_cast<int>(std::min(on_left.points.size(), on_right.points.size())) < kFewFeatures) return;
  ++textured_;
  std::vector<Match> found;
  std::vector<double> rows;
  for (const cv::DMatch& match_of_two : matchFeatures(on_left, on_right)) {
    const cv::Point2f a = on_left.points[static_cast<std::size_t>(match_of_two.queryIdx)].pt;
    const cv::Point2f b = on_right.points[static_cast<std::size_t>(match_of_two.trainIdx)].pt;
    found.push_back({a.x - half_width_, a.y - half_height_, a.x - b.x, b.y - a.y});
    rows.push_back(b.y - a.y);
  }
  // Matches of the same scene have similar row errors, wrong matches have random ones.
  const double row = rows.empty() ? 0.0 : medianValue(rows);
  const auto alike =
      std::count_if(rows.begin(), rows.end(), [row](double dv) { return std::abs(dv - row) < kConsistentRows; });
  if (alike < kFewMatches || static_cast<double>(alike) < kLeastConsistent * static_cast<double>(rows.size())) {
    ++unmatched_;
  } else {
    for (const Match& pair : found)
      if (std::abs(pair.dv) < kMaxRowError && std::abs(pair.du) < half_width_) matches_.push_back(pair);
  }
  if (right_before.empty() || right_after.empty()) return;
  const auto now = std::count_if(rows.begin(), rows.end(), [](double dv) { return std::abs(dv) < kSameRow; });
  const int before = countOnRow(on_left, extractFeatures(right_before)),
            after = countOnRow(on_left, extractFeatures(right_after));
  constexpr double kClearly = 1.3;
  ++compared_;
  before_wins_ += before > kFewMatches && before > kClearly * static_cast<double>(now) && before > after;
  after_wins_ += after > kFewMatches && after > kClearly * static_cast<double>(now) && after > before;
}

std::vector<Finding> PairCheck::findings(const SourceInfo& info, StampNs interval) const {
  std::vector<Finding> findings;
  if (pairs_ < kMinPairs) return findings;
  greyFindings(findings);
  orderFindings(info, interval, findings);
  rowsFindings(info, findings);
  return findings;
}

void PairCheck::orderFindings(const SourceInfo& info, StampNs interval, std::vector<Finding>& findings) const {
  if (textured_ < kMinPairs) return;
  const int wins = std::max(before_wins_, after_wins_);
  if (compared_ >= kMinPairs && 2 * wins > compared_) {
    const bool is_late = after_wins_ > before_wins_;
    Finding finding{FindingKind::Pairs,
                    "in " + std::to_string(wins) + " of " + std::to_string(compared_) +
                        " pairs the left image matches the right image of the pair " + (is_late ? "after" : "before") +
                        " better than its partner: the right images are stamped one interval " +
                        (is_late ? "late" : "early"),
                    "trigger the two cameras by one signal, and stamp images when they are exposed"};
    if (info.right_delay && interval > 0) {
      const double ms = std::round(1e-4 * static_cast<double>(*info.right_delay + (is_late ? interval : -interval)));
      finding.options = {"--set", "input.right_delay=" + urban_nav_core::printNumber(ms / 100.0)};
      finding.remedy = finding.options[0] + " " + finding.options[1] + "; for later recordings, " + finding.remedy;
    }
    findings.push_back(std::move(finding));
    return;
  }
  if (2 * unmatched_ > textured_)
    findings.push_back({FindingKind::Pairs,
                        std::to_string(unmatched_) + " of " + std::to_string(textured_) + " pairs have fewer than " +
                            std::to_string(kFewMatches) + " points in common: their images do not show the same scene",
                        "--topic left:=NAME --topic right:=NAME names the two cameras of one head", true});
}

void PairCheck::rowsFindings(const SourceInfo& info, std::vector<Finding>& findings) const {
  constexpr std::size_t kFew = 100;
  if (matches_.size() < kFew) return;
  // Robust plane through the row errors: the median, then least squares with a shrinking inlier band.
  std::vector<double> rows;
  for (const Match& match : matches_) rows.push_back(match.dv);
  Eigen::Vector3d plane(medianValue(rows), 0.0, 0.0);
  double spread = 0.0;
  std::size_t inliers = 0, negative = 0;
  for (const double gate : {6.0, 4.0, 2.5, 2.5}) {
    Eigen::Matrix3d information = Eigen::Matrix3d::Identity() * 1e-6;
    Eigen::Vector3d vector = Eigen::Vector3d::Zero();
    spread = 0.0, inliers = 0, negative = 0;
    for (const Match& match : matches_) {
      const Eigen::Vector3d row(1.0, match.u / half_width_, match.v / half_height_);
      const double residual = match.dv - row.dot(plane);
      if (std::abs(residual) > gate) continue;
      information += row * row.transpose();
      vector += row * match.dv;
      spread += residual * residual;
      ++inliers;
      negative += match.du < -1.0;
    }
    if (inliers < kFew / 2) return;
    spread = std::sqrt(spread / static_cast<double>(inliers));
    plane = urban_nav_core::SmallCholesky<3>(information).solve(vector);
  }
  if (3 * negative > 2 * inliers)
    findings.push_back(
        {FindingKind::Pairs,
         percent(static_cast<double>(negative) / static_cast<double>(inliers)) +
             " of the matching points have a disparity below zero: left and right images are exchanged",
         "--topic left:=NAME --topic right:=NAME, exchanged; in a folder, exchange the two image folders", true,
         exchangeOptions(info)});
  const double worst = std::abs(plane[0]) + std::abs(plane[1]) + std::abs(plane[2]);
  if (std::abs(plane[0]) <= kOffsetTolerance && worst <= kCornerTolerance && spread <= kMaxScatter) return;
  const double tilt = 180.0 / M_PI * std::atan(plane[1] / half_width_);
  findings.push_back(
      {FindingKind::Rectification,
       "matching points lie " + printed(plane[0]) + " px lower in right images than in left ones, " +
           printed(plane[1]) + " px more at the right edge and " + printed(plane[2]) +
           " px more at the lower edge (scatter " + printed(spread) + " px): " +
           (std::abs(plane[1]) > std::abs(plane[0]) && std::abs(plane[1]) > std::abs(plane[2])
                ? "a rotation of " + printed(tilt) + " deg about the optical axis"
            : std::abs(plane[2]) > std::abs(plane[0])
                ? "focal lengths that differ by " + percent(std::abs(plane[2]) / half_height_)
                : "a pitch between the cameras, or different image crops"),
       "calibrate the stereo camera again (rosrun camera_calibration cameracalibrator.py), or give its calibration by "
       "--calibration LEFT.yaml,RIGHT.yaml"});
}

void PairCheck::greyFindings(std::vector<Finding>& findings) const {
  const auto median = [](const std::vector<Grey>& greys, double Grey::*member) {
    std::vector<double> values;
    for (const Grey& grey : greys) values.push_back(grey.*member);
    return medianValue(values);
  };
  for (const auto& [side, greys] : {std::make_pair("left", &left_), std::make_pair("right", &right_)}) {
    const double mean = median(*greys, &Grey::mean), bright = median(*greys, &Grey::bright);
    if (mean < 8.0)
      findings.push_back(
          {FindingKind::Depth, std::string(side) + " images are nearly black: a mean of " + printed(mean) + " of 255",
           "if they are brighter in a viewer, their encoding has more bits than the pixels: record mono16 "
           "with the bits at the top, or mono8; otherwise expose longer"});
    if (bright > 0.3)
      findings.push_back({FindingKind::Depth, percent(bright) + " of the pixels of " + side + " images are saturated",
                          "expose shorter, or restrict the automatic exposure to the lower part of the image"});
  }
  const double left = median(left_, &Grey::mean), right = median(right_, &Grey::mean);
  const double ratio = std::max(left, right) / std::max(1.0, std::min(left, right));
  if (ratio > 2.0)
    findings.push_back({FindingKind::Depth,
                        "the images of one camera are " + printed(ratio) +
                            " times as bright as those of the other one (left " + printed(left) + ", right " +
                            printed(right) + ")",
                        "use the same exposure, gain and pixel depth for both cameras"});
}

}  // namespace urban_nav_input
