// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/motion/agreement.hpp"

#include <algorithm>
#include <cmath>

namespace urban_nav_core {

namespace {

constexpr double kAgreementBlock = 0.25;  // s
// Standard deviations of a significant difference, and share of the motion above which it contradicts.
constexpr double kFar = 4.0, kLargeShare = 0.5;
// Weight of a block relative to the next one, and sums required for a contradiction and for a confirmation.
constexpr double kKept = 0.8, kContradictions = 2.2, kConfirmations = 1.0;
// Maximum scale error of a working sensor, and weight of sums relative to the next block.
constexpr double kScaleError = 0.1, kSumsKept = 0.98;
// Time until a sensor is used, s: at the start, after its first contradiction, and maximum.
constexpr double kFirstWait = 1.0, kLaterWait = 5.0, kLongestWait = 60.0;
// Time until bias and delay are estimated; before, they may explain errors along the motion, s.
constexpr double kScaleWait = 3.0;
constexpr std::size_t kMostSteps = 240;

}  // namespace

void Agreement::add(const ComparedStep& step, const Vector3d& error, double variance) {
  if (steps_.size() >= kMostSteps) steps_.erase(steps_.begin());
  steps_.push_back(step);
  block_.seconds += step.seconds;
  block_.variance += variance;
  block_.error += error;
  block_.by_reference += step.by_reference;
  block_.by_sensor += step.by_sensor;
  if (block_.seconds >= kAgreementBlock) closeBlock();
}

void Agreement::closeBlock() {
  const double least = kFar * kFar * (block_.variance + floor_ * floor_), error = block_.error.squaredNorm(),
               motion = std::max(block_.by_reference.squaredNorm(), block_.by_sensor.squaredNorm());
  const bool differs = error > kLargeShare * kLargeShare * motion;
  if (differs && error > least) {
    contradicted_ = kKept * contradicted_ + 1.0;
    confirmed_ *= kKept;
  } else if (!differs && block_.by_reference.squaredNorm() > least) {
    confirmed_ = kKept * confirmed_ + 1.0;
    contradicted_ *= kKept;
  }
  const double moved = block_.by_reference.squaredNorm();
  motion_ = kSumsKept * motion_ + moved;
  along_ = kSumsKept * along_ + block_.by_reference.dot(block_.error);
  along_variance_ = kSumsKept * kSumsKept * along_variance_ + moved * (block_.variance + floor_ * floor_);
  compared_ += block_.seconds;
  block_ = Block();
}

bool Agreement::isOffScale() const {
  const double along = std::abs(along_);
  return along > kScaleError * motion_ && along * along > kFar * kFar * along_variance_;
}

void Agreement::interrupt() { block_ = Block(); }

void Agreement::restart(bool was_trusted) {
  ++restarts_;
  if (!(wanted_ > 0.0)) wanted_ = kLaterWait;
  else if (was_trusted) wanted_ = std::min(2.0 * wanted_, kLongestWait);
  contradicted_ = confirmed_ = compared_ = 0.0;
  motion_ = along_ = along_variance_ = 0.0;
  block_ = Block();
}

Agreement::Verdict Agreement::verdict() const {
  if (contradicted_ > kContradictions && contradicted_ > confirmed_) return Verdict::Contradicts;
  if (isOffScale() && compared_ > kScaleWait) return Verdict::Contradicts;
  if (compared_ < std::max(kFirstWait, wanted_)) return Verdict::Unknown;
  if (confirmed_ < kConfirmations) return Verdict::Unknown;  // rest is not evidence
  return Verdict::Agrees;
}

bool Agreement::isUntested() const { return compared_ < kFirstWait; }

void Agreement::archive(Archive& archive) {
  archive(block_.seconds, block_.variance, block_.error, block_.by_reference, block_.by_sensor);
  archive(contradicted_, confirmed_, motion_, along_, along_variance_);
  archive(compared_, wanted_, restarts_, steps_);
}

}  // namespace urban_nav_core
