// SPDX-License-Identifier: BSD-3-Clause
#include "prior_agreement.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace laser_odometry {
namespace {

constexpr double kBlockSeconds = 0.5;
// Differences that are always tolerated: the play of a vehicle on its wheels, and of clocks a few milliseconds apart.
constexpr double kPositionFloor = 0.01;  // m
constexpr double kTurnFloor = 2e-3;      // rad
constexpr double kSigmas = 4.0;
constexpr double kShareOfMotion = 0.1;      // share of a block: beyond the scale error of working wheels
constexpr double kFarShareOfMotion = 0.5;   // share of one step
constexpr double kFarFloors = 4.0;          // floors, of one step
constexpr double kForgetting = 0.8;         // weight of earlier blocks, per block
constexpr double kContradictions = 1.5;     // weighted blocks: two in a row
constexpr double kFirstRequirement = 5.0;   // s of agreement until the prior is used again; doubles each time,
constexpr double kLastRequirement = 300.0;  // up to this

/// A part of a difference: positions or turns.
struct Part {
  double error = 0.0, motion = 0.0, variance = 0.0, floor = 0.0;

  double limit() const { return kSigmas * std::sqrt(variance + floor * floor); }
  bool contradicts() const { return error > limit() && error > kShareOfMotion * motion; }
  bool isFar() const { return error > limit() && error > kFarFloors * floor && error > kFarShareOfMotion * motion; }
  bool hasMotion() const { return motion > limit(); }
};

std::string describe(const char* format, double prior, double sweeps) {
  char text[96];
  std::snprintf(text, sizeof(text), format, prior, sweeps);
  return text;
}

}  // namespace

PriorAgreement::Block PriorAgreement::measure(const ComparedStep& step, const std::vector<Vector6d>& free) const {
  std::vector<Vector6d> unmeasured = free;
  unmeasured.insert(unmeasured.end(), free_before_.begin(), free_before_.end());
  const Matrix6d rest = Matrix6d::Identity() - projectorOnto(unmeasured);
  Block block;
  block.seconds = step.seconds;
  block.by_sweeps = rest * urban_nav_core::logSe3(step.by_sweeps);
  block.by_prior = rest * urban_nav_core::logSe3(step.by_prior);
  const Matrix6d C = rest * (step.covariance_by_sweeps + step.covariance_by_prior) * rest.transpose();
  block.position_variance = C.topLeftCorner<3, 3>().trace();
  block.turn_variance = C.bottomRightCorner<3, 3>().trace();
  return block;
}

namespace {

template <typename Block>
std::pair<Part, Part> splitBlock(const Block& block) {
  const Vector6d error = block.by_sweeps - block.by_prior;
  const auto larger = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return std::max(a.norm(), b.norm()); };
  return {
      {error.template head<3>().norm(), larger(block.by_sweeps.template head<3>(), block.by_prior.template head<3>()),
       block.position_variance, kPositionFloor},
      {error.template tail<3>().norm(), larger(block.by_sweeps.template tail<3>(), block.by_prior.template tail<3>()),
       block.turn_variance, kTurnFloor}};
}

}  // namespace

bool PriorAgreement::isFarFrom(const ComparedStep& step, const std::vector<Vector6d>& free) const {
  const auto [position, turn] = splitBlock(measure(step, free));
  return position.isFar() || turn.isFar();
}

void PriorAgreement::follow(const std::string& source) {
  if (source == source_) return;
  const std::vector<Vector6d> free = free_before_;
  *this = PriorAgreement();
  free_before_ = free;
  source_ = source;
}

void PriorAgreement::add(const ComparedStep& step, const std::vector<Vector6d>& free) {
  const Block one = measure(step, free);
  block_.seconds += one.seconds;
  block_.by_sweeps += one.by_sweeps;
  block_.by_prior += one.by_prior;
  block_.position_variance += one.position_variance;
  block_.turn_variance += one.turn_variance;
  free_before_ = free;
  if (block_.seconds > kBlockSeconds - 1e-3) closeBlock();
}

void PriorAgreement::interrupt(const std::vector<Vector6d>& free) {
  block_ = Block();
  free_before_ = free;
}

void PriorAgreement::closeBlock() {
  const auto [position, turn] = splitBlock(block_);
  const bool contradicts = position.contradicts() || turn.contradicts();
  const bool confirms = !contradicts && (position.hasMotion() || turn.hasMotion());
  if (contradicts || confirms) {
    contradicted_ = kForgetting * contradicted_ + (contradicts ? 1.0 : 0.0);
    confirmed_ = kForgetting * confirmed_ + (confirms ? 1.0 : 0.0);
  }
  if (contradicts && position.contradicts())
    sentence_ = describe("it moves %.2f m where the sweeps measure %.2f m", block_.by_prior.head<3>().norm(),
                         block_.by_sweeps.head<3>().norm());
  else if (contradicts)
    sentence_ =
        describe("it turns %.1f deg where the sweeps measure %.1f deg", block_.by_prior.tail<3>().norm() * 180.0 / M_PI,
                 block_.by_sweeps.tail<3>().norm() * 180.0 / M_PI);
  agreeing_s_ = contradicts ? 0.0 : agreeing_s_ + (confirms ? block_.seconds : 0.0);
  if (!left_out_ && contradicted_ > kContradictions && contradicted_ > confirmed_) {
    left_out_ = true;
    agreeing_s_ = 0.0;
    required_s_ = required_s_ > 0.0 ? std::min(2.0 * required_s_, kLastRequirement) : kFirstRequirement;
  } else if (left_out_ && agreeing_s_ >= required_s_) {
    left_out_ = false;
    contradicted_ = confirmed_ = 0.0;
  }
  block_ = Block();
}

void PriorAgreement::archive(urban_nav_core::Archive& archive) {
  archive(source_, free_before_, block_, contradicted_, confirmed_, agreeing_s_, required_s_, left_out_, sentence_);
}

}  // namespace laser_odometry
