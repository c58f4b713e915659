// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/map_search.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "loop_metric/camera_words.hpp"
#include "loop_metric/stereo_closure.hpp"
#include "loop_metric/stored_surroundings.hpp"
#include "loop_metric/view_finder.hpp"

namespace loop_metric {

using urban_nav_core::Pose;

namespace {

constexpr double views_apart = 1.5;        // m between views of the map that are kept in memory for the search
constexpr std::size_t candidates = 3;      // of a search, that are registered
constexpr double near_way = 6.0;           // m, and
constexpr double near_turn = 0.9;          // rad: what is further from where the robot believes to be is not near
constexpr double sure_way = 2.0;           // m, and
constexpr double sure_turn = 0.35;         // rad: nearer, 92 to 100 of 100 are recognised (README, stereo)
constexpr double metres_per_radian = 4.0;  // a turn costs as many matches as this way
constexpr double useful_belief = 2.0;      // m: a belief that is vaguer says nothing about which views are near

}  // namespace

class MapSearch::Implementation {
 public:
  Implementation(const Parameters& parameters, std::vector<MapView> views, const urban_nav_store::KeyframeStore& store,
                 const urban_nav_core::StereoCamera& camera, const Pose& T_base_left)
      : store_(store),
        views_(std::move(views)),
        finder_(camera),
        matcher_(camera, parameters),
        T_base_left_(T_base_left) {
    std::map<urban_nav_store::SessionId, Pose> last;
    for (std::size_t i = 0; i < views_.size(); ++i) {
      const auto before = last.find(views_[i].session);
      if (before != last.end() && distanceBetween(before->second, views_[i].T_map_base) < views_apart &&
          angleBetween(before->second, views_[i].T_map_base) < near_turn / 4.0)
        continue;
      last[views_[i].session] = views_[i].T_map_base;
      searched_.push_back(i);
    }
  }

  std::size_t views() const { return searched_.size(); }
  std::size_t read() const { return finder_.size(); }
  bool readNext() {
    if (read() < views()) finder_.add(keyframe(views_[searched_[read()]]));
    return read() < views();
  }

  bool look(const Keyframe& view, Localiser& localiser) {
    const Located believed = localiser.at(view.at.stamp);
    const std::vector<std::size_t> nearest = near(believed);
    bool seen = see(nearest, view, localiser);
    // A belief may be wrong, and a robot may have been carried elsewhere: what shows nothing of it is no reason not to look there.
    if (!seen) {
      std::vector<std::size_t> found;
      for (const ViewFinder::Found& each : finder_.find(view, candidates)) found.push_back(searched_[each.view]);
      seen = see(found, view, localiser);
    }
    if (!seen) localiser.addNothing(view.at.stamp, !nearest.empty() && shows(views_[nearest.front()], believed));
    return seen;
  }

 private:
  Keyframe keyframe(const MapView& view) const {
    const auto stored = store_.get(view.session, keyframe_camera, view.stamp);
    Keyframe made;
    made.at = {view.session, view.stamp};
    return stored ? keyframeOf(*stored, view.session) : made;
  }

  /// Should a robot there recognise the view?
  static bool shows(const MapView& view, const Located& believed) {
    return believed.knowledge == Knowledge::Known &&
           distanceBetween(view.T_map_base, believed.T_map_base->pose) <= sure_way &&
           angleBetween(view.T_map_base, believed.T_map_base->pose) <= sure_turn;
  }

  /// The first of them that can be registered: a second one of the same place is no second witness.
  bool see(const std::vector<std::size_t>& views, const Keyframe& view, Localiser& localiser) {
    for (const std::size_t each : views) {
      const StereoClosure closure = matcher_.match(keyframe(views_[each]), view);
      if (closure.verdict != urban_nav_core::ClosureVerdict::Accepted) continue;
      localiser.addSighting(view.at.stamp, views_[each].T_map_base, betweenBases(closure.lefts, T_base_left_));
      return true;
    }
    return false;
  }

  /// The views nearest to where the robot believes to be; empty where it knows too little.
  std::vector<std::size_t> near(const Located& believed) const {
    const bool is_vague = !believed.T_map_base || believed.witnesses > 0 ||
                          believed.T_map_base->covariance.topLeftCorner<3, 3>().trace() > useful_belief * useful_belief;
    if (believed.knowledge != Knowledge::Known && is_vague) return {};
    const Pose& here = believed.T_map_base->pose;
    std::vector<std::pair<double, std::size_t>> costs;
    for (std::size_t i = 0; i < views_.size(); ++i) {
      const double way = distanceBetween(views_[i].T_map_base, here), turn = angleBetween(views_[i].T_map_base, here);
      if (way <= near_way && turn <= near_turn) costs.emplace_back(way + metres_per_radian * turn, i);
    }
    std::sort(costs.begin(), costs.end());
    std::vector<std::size_t> nearest;
    for (std::size_t i = 0; i < std::min(costs.size(), candidates); ++i) nearest.push_back(costs[i].second);
    return nearest;
  }

  const urban_nav_store::KeyframeStore& store_;
  std::vector<MapView> views_;
  std::vector<std::size_t> searched_;  // numbers in views_ of those in the finder, or to be
  ViewFinder finder_;
  StereoMatcher matcher_;
  Pose T_base_left_;
};

MapSearch::MapSearch(const Parameters& parameters, const FrozenMap& map, const urban_nav_store::KeyframeStore& store,
                     const urban_nav_core::StereoCamera& camera, const Pose& T_base_left)
    : implementation_(std::make_unique<Implementation>(parameters, map.viewsOf(cameraWords(camera, T_base_left)), store,
                                                       camera, T_base_left)) {}
MapSearch::~MapSearch() = default;

std::size_t MapSearch::views() const { return implementation_->views(); }
std::size_t MapSearch::read() const { return implementation_->read(); }
bool MapSearch::readNext() { return implementation_->readNext(); }
bool MapSearch::look(const Keyframe& view, Localiser& localiser) { return implementation_->look(view, localiser); }

}  // namespace loop_metric
