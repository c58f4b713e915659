// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/parameter_effects.hpp"

#include <sstream>

#include "live/live_localiser.hpp"
#include "urban_nav_registration/keyframe/keyframe.hpp"
#include "urban_nav_registration/session/stored_keyframe.hpp"

namespace urban_nav_localization {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;

constexpr StampNs kEffectSecond = 1'000'000'000;

/// A drive of 8 m with three matches, the last of which is wrong by half a metre.
std::string localise(const Parameters& parameters) {
  const auto place = [](double x, double y) { return Pose(Eigen::Quaterniond::Identity(), {x, y, 0.0}); };
  Localiser localiser(parameters);
  for (StampNs i = 0; i < 8; ++i) {
    urban_nav_core::RelativePose step;
    step.from = i * kEffectSecond;
    step.to = step.from + kEffectSecond;
    step.T_from_to = place(1.0, 0.0);
    step.covariance = 1e-6 * urban_nav_core::Matrix6d::Identity();
    localiser.addOdometry(step);
  }
  for (const StampNs second : {2, 4, 6}) {
    urban_nav_core::Constraint measured;
    measured.T_a_b = place(0.0, second == 6 ? 0.5 : 0.0);
    measured.information = 1e4 * urban_nav_core::Matrix6d::Identity();
    localiser.addMatch(second * kEffectSecond, place(static_cast<double>(second), 0.0), measured);
  }
  const LocalizationEstimate estimate = localiser.now();
  std::ostringstream text;
  text.precision(17);
  text << toString(estimate.state) << estimate.supporting_matches << "\n";
  if (estimate.T_map_base) text << estimate.T_map_base->pose.matrix() << "\n" << estimate.T_map_base->covariance;
  return text.str();
}

/// A map of 20 m with a keyframe and the scan of a laser.
void writeMap(const std::string& path) {
  const std::string session = "0123456789abcdef0123";
  urban_nav_store::removeStore(path);
  urban_nav_store::Store store(path, urban_nav_store::Access::Write);
  store.sessions().put(urban_nav_store::Session{session, "first", "", "", 0, true});
  store.sessions().put(session, urban_nav_store::Extrinsic{"laser", Pose()});
  urban_nav_registration::Keyframe keyframe;
  keyframe.width = keyframe.height = 1;
  store.keyframes().put(session, urban_nav_registration::kKeyframeCamera,
                        urban_nav_registration::toStoredKeyframe(keyframe));
  for (StampNs i = 0; i <= 20; ++i) {
    urban_nav_store::Node node{i * kEffectSecond,
                               Pose(Eigen::Quaterniond::Identity(), {static_cast<double>(i), 0.0, 0.0})};
    if (i > 0) node.covariance = 1e-6 * urban_nav_core::Matrix6d::Identity();
    store.graph().put(session, node);
  }
  urban_nav_core::Scan scan;
  scan.beams.push_back({0, {1.0F, 0.0F, 0.0F}, 5.0F, 1.0F});
  store.scans().put(session, "laser", scan);
  store.commit();
}

/// Places of the map whose clouds a live robot is searched at.
std::string searchClouds(const Parameters& parameters) {
  const std::string path = ::testing::TempDir() + "localization_effects.db";
  writeMap(path);
  urban_nav_store::Store store(path, urban_nav_store::Access::Read);
  FrozenMap map(store);
  LiveLocaliser localiser(parameters, std::move(store), std::move(map), {}, {});
  localiser.work();
  return std::to_string(localiser.state().map_places);
}

TEST(ParameterEffects, EachParameterChangesTheEstimate) {
  const std::string faults = urban_nav_core::testing::findParametersWithoutEffect(
      table(), {{"drive with a wrong match", localise, {{"gate", 1.0}, {"map_sigma", 0.2}}},
                {"map with clouds", searchClouds, {{"icp", false}}}});
  EXPECT_EQ(faults, "");
}

}  // namespace
}  // namespace urban_nav_localization
