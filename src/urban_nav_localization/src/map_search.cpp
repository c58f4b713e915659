// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_localization/map_search.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "near.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_registration/session/calibration_fingerprint.hpp"
#include "urban_nav_registration/session/stored_keyframe.hpp"
#include "urban_nav_registration/stereo/stereo_closure.hpp"

namespace urban_nav_localization {

using urban_nav_core::Constraint;
using urban_nav_core::Pose;
using urban_nav_registration::betweenBases;
using urban_nav_registration::Keyframe;
using urban_nav_registration::KeyframeRetrieval;
using urban_nav_registration::kKeyframeCamera;
using urban_nav_registration::MountedCamera;
using urban_nav_registration::SearchedKeyframe;
using urban_nav_registration::StereoClosure;
using urban_nav_registration::StereoMatcher;
using urban_nav_registration::toKeyframe;

namespace {

constexpr double kSearchSpacing = 1.5;              // m between keyframes of the map that are found in the whole map
constexpr std::size_t kMaxRegisteredKeyframes = 3;  // of one query
constexpr double kMaxNearDistance = 6.0;            // m from the prior to keyframes that are tried first, and
constexpr double kMaxNearAngle = 0.9;               // rad
constexpr double kMaxSureDistance = 2.0;            // m; nearer, and
constexpr double kMaxSureAngle = 0.35;              // rad, 92 to 100 of 100 match (docs/results/registration.md)
// Keyframes from further apart share a distant wall rather than the surroundings of the robot, and walls have repeated
// patterns: such a match starts no hypothesis, unless it determines the position so well that much of it was near. Of
// 134 correct matches along one drive in the opposite direction 98 % are firm, of 12 false ones none.
constexpr double kMaxFirmDistance = 2.5;        // m, or
constexpr double kMaxFirmSigma = 0.03;          // m
constexpr double kMetresPerRadianOfView = 4.0;  // a rotation costs as many matches as this distance

bool isFirm(const Constraint& measured) {
  if (measured.T_a_b.t().norm() <= kMaxFirmDistance) return true;
  const auto covariance = urban_nav_core::invertPositiveDefinite(measured.information);
  return covariance && covariance->topLeftCorner<3, 3>().trace() <= kMaxFirmSigma * kMaxFirmSigma;
}

}  // namespace

class MapSearch::Implementation {
 public:
  Implementation(const Parameters& parameters, std::vector<MapKeyframe> views, urban_nav_store::Store& store,
                 const MountedCamera& camera, std::shared_ptr<KeyframeRetrieval> retrieval)
      : store_(store.keyframes()),
        views_(std::move(views)),
        retrieval_(std::move(retrieval)),
        matcher_(camera.camera, parameters.registration),
        T_base_left_(camera.T_base_left) {
    std::vector<SearchedKeyframe> searched;
    std::map<urban_nav_store::SessionId, Pose> last;
    for (std::size_t i = 0; i < views_.size(); ++i) {
      const auto before = last.find(views_[i].session);
      if (before != last.end() && distanceBetween(before->second, views_[i].T_map_base) < kSearchSpacing &&
          angleBetween(before->second, views_[i].T_map_base) < kMaxNearAngle / 4.0)
        continue;
      last[views_[i].session] = views_[i].T_map_base;
      searched_.push_back(i);
      searched.push_back({{views_[i].session, views_[i].stamp}, views_[i].conversion});
    }
    retrieval_->open(store, std::move(searched));
  }

  std::size_t views() const { return searched_.size(); }
  std::size_t read() const { return retrieval_->read(); }
  bool readNext() { return retrieval_->readNext(); }

  bool query(const Keyframe& view, Localiser& localiser) {
    const LocalizationEstimate prior = localiser.at(view.at.stamp);
    const std::vector<std::size_t> nearest = isNearKnownPlace(prior)
                                                 ? near(prior.T_map_base->pose, kMaxNearDistance, kMaxNearAngle)
                                                 : std::vector<std::size_t>();
    std::optional<MapMatch> seen = findFirst(nearest, view);
    // The prior may be wrong, and the robot may have been carried elsewhere: without a match near it, search the whole
    // map.
    if (!seen) {
      std::vector<std::size_t> found;
      for (const std::size_t each : retrieval_->find(view, kMaxRegisteredKeyframes)) found.push_back(searched_[each]);
      seen = findFirst(found, view);
    }
    if (seen) localiser.addMatch(view.at.stamp, views_[seen->view].T_map_base, seen->measured, isFirm(seen->measured));
    else localiser.addMiss(view.at.stamp, !nearest.empty() && shows(views_[nearest.front()], prior));
    return seen.has_value();
  }

 private:
  struct MapMatch {
    std::size_t view;
    Constraint measured;  // T_view_robot, between base_links
  };

  Keyframe keyframe(const MapKeyframe& view) const {
    const auto stored = store_.get(view.session, kKeyframeCamera, view.stamp);
    Keyframe made;
    made.at = {view.session, view.stamp};
    if (stored) made = toKeyframe(*stored, view.session);
    return stored && view.conversion ? view.conversion->convert(made) : made;
  }

  /// Returns whether a robot at the prior should match the keyframe.
  static bool shows(const MapKeyframe& view, const LocalizationEstimate& prior) {
    return prior.state == LocalizationState::Localized &&
           distanceBetween(view.T_map_base, prior.T_map_base->pose) <= kMaxSureDistance &&
           angleBetween(view.T_map_base, prior.T_map_base->pose) <= kMaxSureAngle;
  }

  /// Returns the match with the first keyframe that can be registered, since others of the same place are not
  /// independent. If the resulting pose is far from the keyframe, and the map has keyframes near that pose, one of
  /// these must match too and is returned, because it is more accurate.
  std::optional<MapMatch> findFirst(const std::vector<std::size_t>& views, const Keyframe& view) {
    const std::optional<MapMatch> seen = registered(views, view);
    if (!seen || isFirm(seen->measured)) return seen;
    const std::vector<std::size_t> nearest =
        near(views_[seen->view].T_map_base * seen->measured.T_a_b, kMaxSureDistance, kMaxSureAngle);
    return nearest.empty() ? seen : registered(nearest, view);
  }
  std::optional<MapMatch> registered(const std::vector<std::size_t>& views, const Keyframe& view) {
    for (const std::size_t each : views) {
      const StereoClosure closure = matcher_.match(keyframe(views_[each]), view);
      if (closure.verdict == urban_nav_core::ClosureVerdict::Accepted)
        return MapMatch{each, betweenBases(closure.lefts, T_base_left_)};
    }
    return std::nullopt;
  }

  /// Returns the keyframes nearest to a pose.
  std::vector<std::size_t> near(const Pose& here, double most_path, double most_turn) const {
    std::vector<std::pair<double, std::size_t>> costs;
    for (std::size_t i = 0; i < views_.size(); ++i) {
      const double way = distanceBetween(views_[i].T_map_base, here), turn = angleBetween(views_[i].T_map_base, here);
      if (way <= most_path && turn <= most_turn) costs.emplace_back(way + kMetresPerRadianOfView * turn, i);
    }
    std::sort(costs.begin(), costs.end());
    std::vector<std::size_t> nearest;
    for (std::size_t i = 0; i < std::min(costs.size(), kMaxRegisteredKeyframes); ++i)
      nearest.push_back(costs[i].second);
    return nearest;
  }

  const urban_nav_store::KeyframeStore& store_;
  std::vector<MapKeyframe> views_;
  std::vector<std::size_t> searched_;  // indices in views_ of those that retrieval_ finds
  std::shared_ptr<KeyframeRetrieval> retrieval_;
  StereoMatcher matcher_;
  Pose T_base_left_;
};

MapSearch::MapSearch(const Parameters& parameters, const FrozenMap& map, urban_nav_store::Store& store,
                     const MountedCamera& camera, std::shared_ptr<KeyframeRetrieval> retrieval)
    : implementation_(std::make_unique<Implementation>(parameters, map.findKeyframes(camera), store, camera,
                                                       std::move(retrieval))) {}
MapSearch::~MapSearch() = default;

std::size_t MapSearch::views() const { return implementation_->views(); }
std::size_t MapSearch::read() const { return implementation_->read(); }
bool MapSearch::readNext() { return implementation_->readNext(); }
bool MapSearch::query(const Keyframe& view, Localiser& localiser) { return implementation_->query(view, localiser); }

}  // namespace urban_nav_localization
