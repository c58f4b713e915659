// SPDX-License-Identifier: BSD-3-Clause
#include "health/health.hpp"

#include <cmath>
#include <cstdio>

namespace swf_vo {

using urban_nav_core::Health;
using urban_nav_core::Status;

const char* toString(Reason reason) {
  switch (reason) {
    case Reason::None: return "none";
    case Reason::TooFewFeatures: return "too_few_features";
    case Reason::Dark: return "dark";
    case Reason::Blurred: return "blurred";
    case Reason::Frozen: return "frozen";
    case Reason::Swapped: return "swapped";
    case Reason::ExposureJump: return "exposure_jump";
    case Reason::ImageMissing: return "image_missing";
    case Reason::BadStamp: return "bad_stamp";
    case Reason::Gap: return "gap";
    case Reason::Inconsistent: return "inconsistent";
    case Reason::NotObserved: return "not_observed";
    case Reason::Corrupted: return "corrupted";
    case Reason::NotRectified: return "not_rectified";
    case Reason::Calibration: return "calibration";
  }
  return "unknown";
}

const char* sentence(Reason reason) {
  switch (reason) {
    case Reason::None: return "";
    case Reason::TooFewFeatures: return "too few features tracked";
    case Reason::Dark: return "image without contrast: dark, covered or overexposed";
    case Reason::Blurred: return "images much less sharp than before";
    case Reason::Frozen: return "image identical to the previous one";
    case Reason::Swapped: return "left and right are exchanged: check the topics; the images were swapped before use";
    case Reason::ExposureJump: return "sudden change of brightness";
    case Reason::ImageMissing: return "image missing or of another size";
    case Reason::BadStamp: return "stamp not later than the previous one: frame dropped";
    case Reason::Gap: return "frames missing before this one";
    case Reason::Inconsistent: return "matches are inconsistent with one rigid motion";
    case Reason::NotObserved: return "a direction of the motion is constrained by the prediction only";
    case Reason::Corrupted: return "corrupted image rows: check cables, bandwidth and drivers; the other rows are used";
    case Reason::NotRectified:
      return "images are not rectified, or with another calibration: rows of left and right disagree";
    case Reason::Calibration:
      return "wrong calibration: the disparity offset is far outside its prior (disparity_offset)";
  }
  return "";
}

namespace {

// Rows of a rectified pair agree to a pixel after a common offset; RowCheck resolves whole pixels.
constexpr double kRowsAgreePx = 1.5;
constexpr double kFarOutside = 3.0;  // standard deviations of the prior

/// Returns the description of a reason with the measured values.
std::string describe(Reason reason, const Evidence& evidence) {
  const std::string text = sentence(reason);
  char amount[64] = "";
  if (reason == Reason::NotRectified && evidence.rows_disagree_px)
    std::snprintf(amount, sizeof amount, " by %.1f px (median of the matches)", *evidence.rows_disagree_px);
  if (reason == Reason::Calibration)
    std::snprintf(amount, sizeof amount, ", by %.2f +- %.2f px", evidence.disparity_offset_px,
                  evidence.disparity_offset_sigma_px);
  return text + amount;
}

}  // namespace

HealthMonitor::HealthMonitor(const Parameters& parameters)
    : lost_features_(parameters.lost_features),
      degraded_features_(parameters.degraded_features),
      offset_prior_px_(parameters.disparity_offset) {}

bool HealthMonitor::isTrusted(const Evidence& evidence) const {
  return evidence.image.usable && evidence.localised && evidence.tracked >= lost_features_;
}

Reason HealthMonitor::reasonFor(const Evidence& evidence) const {
  const bool replaceable = evidence.image.usable && !evidence.image.exchange;
  if (evidence.corrupted && replaceable) return Reason::Corrupted;
  if (evidence.image.reason != Reason::None) return evidence.image.reason;
  const int enough = evidence.first ? evidence.features : evidence.tracked;
  if (evidence.gap) return Reason::Gap;
  if (enough >= degraded_features_)
    return evidence.inlier_share < 0.4 && !evidence.first ? Reason::Inconsistent : Reason::None;
  if (evidence.rows_disagree_px && *evidence.rows_disagree_px > kRowsAgreePx) return Reason::NotRectified;
  if (isMiscalibrated(evidence)) return Reason::Calibration;
  const bool scattered = evidence.candidates >= degraded_features_ && 2 * evidence.tracked < evidence.candidates;
  return scattered ? Reason::Inconsistent : Reason::TooFewFeatures;
}

bool HealthMonitor::isUnexplained(const Evidence& evidence) const {
  const Reason reason = reasonFor(evidence);
  return evidence.image.usable && (reason == Reason::TooFewFeatures || reason == Reason::Inconsistent);
}

bool HealthMonitor::isMiscalibrated(const Evidence& evidence) const {
  if (!(offset_prior_px_ > 0.0) || !(evidence.disparity_offset_sigma_px > 0.0)) return false;
  const double known = std::abs(evidence.disparity_offset_px) - kFarOutside * evidence.disparity_offset_sigma_px;
  return known > kFarOutside * offset_prior_px_;
}

Status HealthMonitor::judge(const Evidence& evidence) {
  Status status;
  const Reason reason = reasonFor(evidence);
  const bool lost = evidence.first ? evidence.features < lost_features_ : !isTrusted(evidence);
  if (lost) status.health = Health::Lost;
  else if (reason != Reason::None) status.health = Health::Degraded;
  else if (was_lost_) status.health = Health::Recovered;
  was_lost_ = lost;
  status.reason = static_cast<int>(reason);
  status.sentence = describe(reason, evidence);
  return status;
}

void HealthMonitor::archive(urban_nav_core::Archive& archive) { archive(was_lost_); }

}  // namespace swf_vo
