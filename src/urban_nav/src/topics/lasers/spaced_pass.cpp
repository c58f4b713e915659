// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/spaced_pass.hpp"

#include <algorithm>
#include <utility>

#include "map/state_bytes.hpp"

namespace urban_nav {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::TravelSpacing;

namespace {

constexpr std::uint32_t kSpacedPassVersion = 3;

}  // namespace

SpacedPass::SpacedPass(std::string name, TravelSpacing::Spacing spacing, MapContext& context,
                       const Stage::SessionStart& start)
    : name_(std::move(name)), spacing_(spacing), store_(*context.store), session_(context.sessions[start.session]) {
  if (start.checkpoint) unpackState(name_.c_str(), kSpacedPassVersion, *start.checkpoint, state_);
}

bool SpacedPass::hasStored(const std::string& role) const {
  return std::any_of(state_.roles.begin(), state_.roles.end(), [&](const Role& each) { return each.name == role; });
}

bool SpacedPass::takes(const std::string& role, StampNs stamp) {
  const std::vector<OdometryFrame>& frames = session_.odometry->frames;
  const std::optional<Pose> now = frames.empty() ? std::nullopt : std::optional(frames.back().T_odom_base);
  auto found =
      std::find_if(state_.roles.begin(), state_.roles.end(), [&](const Role& each) { return each.name == role; });
  if (found == state_.roles.end()) found = state_.roles.insert(found, {role, TravelSpacing()});
  found->spacing.setSpacing(spacing_);  // which a checkpoint does not hold
  return found->spacing.takes(stamp, now);
}

std::string SpacedPass::checkpoint() { return packState(name_.c_str(), kSpacedPassVersion, state_); }

}  // namespace urban_nav
