// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/parameter_effects.hpp"

#include <sstream>

#include "loop_metric/candidate/shared_clouds.hpp"
#include "loop_metric/loop_metric.hpp"
#include "support/line_place_data.hpp"
#include "urban_nav_core/testing/motion.hpp"
#include "urban_nav_core/testing/scanner.hpp"
#include "urban_nav_core/testing/textured_street.hpp"
#include "urban_nav_registration/testing/photographer.hpp"

namespace loop_metric {
namespace {

using testing::LinePlaceData;
using urban_nav_core::MetricClosure;
using urban_nav_core::Pose;
using urban_nav_core::PoseRef;
using urban_nav_core::StampNs;
using urban_nav_core::testing::findChangesWithoutEffect;
using urban_nav_core::testing::lookingAlong;
using urban_nav_core::testing::stand;

constexpr StampNs kEffectSecond = 1'000'000'000;
constexpr int kMetres = 6;  // length of a drive, at a metre per second

/// Prints verdict and transform, without thresholds, which equal the parameters.
std::string printVerdict(const MetricClosure& closure) {
  std::ostringstream text;
  text.precision(17);
  text << static_cast<int>(closure.verdict) << static_cast<int>(closure.method) << closure.reason_name << "\n"
       << closure.measured.T_a_b.matrix() << "\n"
       << closure.measured.information;
  return text.str();
}

/// Two drives along one street, as two sessions, and as a single one whose odometry has an error of 4 m between them.
class TwoDrives {
 public:
  TwoDrives() {
    std::vector<Pose> monday, tuesday, both;
    for (int x = 0; x < kMetres; ++x) {
      monday.push_back(lookingAlong({4.0 + x, 0.0, 1.2}, 0.0));
      tuesday.push_back(lookingAlong({4.0 + x, 0.7, 1.2}, 0.014));
    }
    both = monday;
    for (const Pose& pose : tuesday) both.push_back(Pose(pose.q(), pose.t() + Eigen::Vector3d(4.0, 0.0, 0.0)));
    around_.drive("monday", monday, 0.002, 0.0002);
    around_.drive("tuesday", tuesday, 0.002, 0.0002);
    around_.drive("both", both, 0.002, 0.0002);
    for (const int x : {1, 3}) {
      put("monday", x, photographer_.keyframe(monday[static_cast<std::size_t>(x)]));
      put("tuesday", x, photographer_.keyframe(tuesday[static_cast<std::size_t>(x)]));
      put("both", x, around_.keyframe({"monday", x * kEffectSecond}));
      put("both", x + kMetres, around_.keyframe({"tuesday", x * kEffectSecond}));
    }
  }

  std::string measure(const Parameters& parameters, const PoseRef& a, const PoseRef& b) const {
    return measureWith(parameters, a, b, around_);
  }
  /// measure() with a keyframe without image next to the pose.
  std::string measureBesideADarkKeyframe(const Parameters& parameters, const PoseRef& a, const PoseRef& b) const {
    LinePlaceData around = around_;
    around.keyframes[{"monday", kEffectSecond}].image.clear();
    return measureWith(parameters, a, b, around);
  }

 private:
  void put(const std::string& session, int second, urban_nav_registration::Keyframe keyframe) {
    keyframe.at = {session, second * kEffectSecond};
    around_.keyframes[keyframe.at] = keyframe;
  }
  std::string measureWith(const Parameters& parameters, const PoseRef& a, const PoseRef& b,
                          const LinePlaceData& around) const {
    LoopMetric stage(parameters, photographer_.camera(), Pose());
    return printVerdict(stage.measure({a, b, 0.9}, around).metric);
  }

  urban_nav_registration::testing::Photographer photographer_{urban_nav_core::testing::texturedStreet()};
  LinePlaceData around_;
};

/// Two sessions in a courtyard with clouds only.
std::string measureClouds(const Parameters& parameters) {
  static const urban_nav_core::testing::World world = urban_nav_core::testing::courtyard(5);
  const std::vector<Pose> there = {stand(0, 0, 0), stand(1, 0, 0)},
                          back = {stand(1.5, 1.0, 175.0), stand(0.5, 1.0, 175.0)};
  LinePlaceData around;
  around.drive("there", there, 0.01, 0.001);
  around.drive("back", back, 0.01, 0.001);
  around.clouds = [&](const PoseRef& at) {
    return urban_nav_core::testing::scan(world, (at.session == "there" ? there : back)[0], {}, 1);
  };
  return printVerdict(LoopMetric(parameters, {}, Pose()).measure({{"there", 0}, {"back", 0}, 0.9}, around).metric);
}

/// Two closures by clouds 2 m apart, which share beams.
std::string shareClouds(const urban_nav_registration::Parameters& registration) {
  LinePlaceData around;
  std::vector<Pose> poses;
  for (int x = 0; x < 40; ++x) poses.push_back(stand(x, 0, 0));
  for (const char* session : {"there", "back"}) around.drive(session, poses, 0.01, 0.001);
  std::vector<MetricClosure> closures(2);
  for (StampNs i = 0; i < 2; ++i) {
    MetricClosure& closure = closures[static_cast<std::size_t>(i)];
    closure.a = {"there", (10 + 2 * i) * kEffectSecond};
    closure.b = {"back", (20 + 2 * i) * kEffectSecond};
    closure.method = urban_nav_core::ClosureMethod::Icp;
    closure.verdict = urban_nav_core::ClosureVerdict::Accepted;
    closure.measured.information.setIdentity();
  }
  Parameters parameters;
  parameters.registration = registration;
  discountSharedClouds(closures, around, parameters);
  return printVerdict(closures[0]) + printVerdict(closures[1]);
}

TEST(ParameterEffects, EachParameterChangesAResult) {
  const TwoDrives drives;
  const PoseRef here{"monday", kEffectSecond}, again{"tuesday", 2 * kEffectSecond};
  const PoseRef first{"both", kEffectSecond}, second{"both", (kMetres + 1) * kEffectSecond};
  const auto across = [&](const Parameters& parameters) { return drives.measure(parameters, here, again); };
  const auto dark = [&](const Parameters& parameters) {
    return drives.measureBesideADarkKeyframe(parameters, here, again);
  };
  const auto within = [&](const Parameters& parameters) { return drives.measure(parameters, first, second); };
  const std::string faults = urban_nav_core::testing::findParametersWithoutEffect(
      table(), {{"two sessions", across, {{"stereo", false}, {"keyframe_search_distance", 0.0}, {"place_radius", 1.0}}},
                {"a keyframe without image", dark, {{"stereo_tries", 1}}},
                {"one session", within, {{"gate", 1000.0}}, {{"keyframe_search_distance", 2.5}}},
                {"clouds", measureClouds, {{"icp", false}}}});
  EXPECT_EQ(faults, "");
}

TEST(ParameterEffects, ParametersOfRegistrationChangeAResult) {
  const TwoDrives drives;
  const PoseRef first{"both", kEffectSecond}, second{"both", (kMetres + 1) * kEffectSecond};
  const auto within = [&](const urban_nav_registration::Parameters& registration) {
    Parameters parameters;
    parameters.registration = registration;
    parameters.keyframe_search_distance = 2.5;
    return drives.measure(parameters, first, second);
  };
  const std::string faults = findChangesWithoutEffect(
      urban_nav_registration::table(), {{"one session", within, {{"odometry_scale", 1.0}}},
                                        {"closures that share clouds", shareClouds, {{"cloud_half_length", 5.0}}}});
  EXPECT_EQ(faults, "");
}

}  // namespace
}  // namespace loop_metric
