// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/cloud_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cloud/surfels.hpp"
#include "global/search.hpp"
#include "localise/near.hpp"
#include "loop_metric/align.hpp"
#include "loop_metric/session_odometry.hpp"
#include "loop_metric/stored_surroundings.hpp"
#include "urban_nav_core/geometry/compose.hpp"
#include "urban_nav_core/geometry/covariance_frames.hpp"
#include "urban_nav_core/geometry/dense.hpp"

namespace loop_metric {

using urban_nav_core::ClosureVerdict;
using urban_nav_core::Constraint;
using urban_nav_core::OdometryChain;
using urban_nav_core::PointCloud;
using urban_nav_core::Pose;
using urban_nav_core::PoseRef;
using urban_nav_core::PoseWithCovariance;
using urban_nav_core::StampNs;

namespace {

constexpr double places_apart = 5.0;    // m between places of the map: a cloud reaches twice as far to both sides
constexpr double least_way = 3.0;       // m to both sides of a stretch that may be recognised
constexpr double firm_cloud_way = 5.0;  // m: what is seen of less is no beginning of a hypothesis
constexpr double step = 2.0;            // m between looks, and
constexpr double known_step = 5.0;      // m while it is KNOWN where the robot is
constexpr std::size_t cloud_candidates = 3;
// Share of the drive's upright surfaces that the map must have where nobody knows where the robot is: it saw what there was. Of a firm stretch, 95 of 100 right answers share 0.77 and
// more, and those of other quads that fit in all else 0.62 to 0.66; of shorter ones up to 0.88.
constexpr double enough_shared = 0.7;
constexpr double one_place = 1.0;       // m: answers further apart contradict each other
constexpr double near_cloud_way = 8.0;  // m: places further from where the robot believes to be are not near

/// A place of the map that was driven through, and what stands around it.
struct MapPlace {
  PoseRef at;
  Pose T_map_base;
  Outline outline;
};

/// T_a_b with odometry from b on: next to no information where there was none.
Constraint withOdometry(const Constraint& measured, const PoseWithCovariance& T_b_end) {
  constexpr double metres_per_radian = 10.0;
  const PoseWithCovariance end = compose(
      PoseWithCovariance{measured.T_a_b, urban_nav_core::covarianceForDisplay(measured.information, metres_per_radian)},
      T_b_end);
  Constraint made;
  made.T_a_b = end.pose;
  if (const auto information = urban_nav_core::invertPositiveDefinite(end.covariance)) made.information = *information;
  return made;
}

}  // namespace

class CloudSearch::Implementation {
 public:
  Implementation(const Parameters& parameters, const FrozenMap& map, urban_nav_store::Store& store)
      : parameters_(parameters), demanding_(parameters) {
    demanding_.min_shared = std::max(demanding_.min_shared, enough_shared);
    StoredSurroundings::Sessions sessions;
    for (const urban_nav_store::StoredTrajectory& session : map.sessions()) {
      const std::vector<LaserAt> lasers = storedLasers(store, session.session.id);
      if (lasers.empty()) continue;
      const SessionOdometry odometry = readOdometry(store, session.session.id);
      for (std::size_t part = 0; part < odometry.parts().size(); ++part)
        sessions[session.session.id + "/" + std::to_string(part)] = {session.session.id, odometry.parts()[part], lasers,
                                                                     false};
      addPlaces(session, odometry);
    }
    surroundings_ = std::make_unique<StoredSurroundings>(std::move(sessions), store.keyframes(), store.scans());
  }

  std::size_t places() const { return places_.size(); }
  std::size_t read() const { return read_; }
  bool readNext() {
    if (read_ < places_.size()) {
      MapPlace& place = places_[read_++];
      const PointCloud cloud = surroundings_->cloud(place.at, parameters_.cloud_way);
      place.outline = outlineOf(makeSurfels(cloud, static_cast<float>(parameters_.voxel)), kCoarse);
    }
    return read_ < places_.size();
  }

  std::optional<Stretch> due(const Localiser& localiser) const {
    const OdometryChain& odometry = localiser.odometry();
    if (odometry.empty() || places_.empty()) return std::nullopt;
    const StampNs newest = odometry.trajectory().back().stamp;
    const double driven = odometry.distance(newest);
    const double way = std::min(parameters_.cloud_way, driven / 2.0);
    if (way < least_way) return std::nullopt;
    const bool is_known = localiser.now().knowledge == Knowledge::Known;
    const double pause = is_known ? known_step : step;
    if (looked_ && odometry.nearestFrame(*looked_) && driven - odometry.distance(*looked_) < pause) return std::nullopt;
    if (is_known && localiser.unseen() < pause) return std::nullopt;
    Stretch stretch;
    stretch.way = way;
    stretch.at = frameAt(odometry, driven - way);
    return stretch;
  }

  bool look(const Stretch& stretch, const PointCloud& cloud, double bend, Localiser& localiser) {
    const StampNs end = localiser.odometry().trajectory().back().stamp;
    looked_ = end;
    const auto T_middle_end = localiser.odometry().between(stretch.at, end);
    if (cloud.points.empty() || !T_middle_end) return false;
    const Looked looked{cloud, bend, localiser.at(stretch.at)};
    std::optional<Sighting> seen;
    if (const auto place = near(looked.believed)) {
      const Located& believed = looked.believed;
      seen =
          at(*place, looked, {Search::IfRejected, believed.T_map_base->pose, believed.knowledge == Knowledge::Known});
    }
    if (!seen) seen = among(alike(cloud), looked);
    if (!seen) return false;
    // At its end: the whole stretch has been recognised, and what was seen on it is no older.
    localiser.addSighting(end, seen->T_map_place, withOdometry(seen->measured, *T_middle_end),
                          stretch.way >= firm_cloud_way);
    return true;
  }

 private:
  struct Looked {
    const PointCloud& cloud;
    double bend;
    Located believed;
  };
  /// Where an alignment begins, in the map.
  struct Start {
    Search search;
    Pose T_map_base;
    bool is_known;  ///< that the robot is about there
  };
  struct Sighting {
    std::size_t place = 0;
    Pose T_map_place;
    Constraint measured;

    Pose T_map_base() const { return T_map_place * measured.T_a_b; }
  };

  void addPlaces(const urban_nav_store::StoredTrajectory& session, const SessionOdometry& odometry) {
    const Pose* last = nullptr;
    for (const urban_nav_core::StampedPose& pose : session.T_map_base) {
      if (last != nullptr && distanceBetween(*last, pose.pose) < places_apart) continue;
      const std::size_t part = odometry.partAt(pose.stamp);
      if (odometry.empty() || !odometry.parts()[part]->nearestFrame(pose.stamp)) continue;
      last = &pose.pose;
      places_.push_back({{session.session.id + "/" + std::to_string(part), pose.stamp}, pose.pose, {}});
    }
  }

  /// The first frame that lies so far along the way.
  static StampNs frameAt(const OdometryChain& odometry, double way) {
    const auto& frames = odometry.trajectory();
    std::size_t first = 0, last = frames.size() - 1;
    while (first < last) {
      const std::size_t middle = (first + last) / 2;
      if (odometry.distance(frames[middle].stamp) < way) first = middle + 1;
      else last = middle;
    }
    return frames[first].stamp;
  }

  /// The nearest place to where the robot believes to be; none where it knows too little.
  std::optional<std::size_t> near(const Located& believed) const {
    if (read_ == 0 || !tellsWhatIsNear(believed)) return std::nullopt;
    const std::size_t nearest = nearestTo(believed.T_map_base->pose);
    if (distanceBetween(places_[nearest].T_map_base, believed.T_map_base->pose) > near_cloud_way) return std::nullopt;
    return nearest;
  }

  std::size_t nearestTo(const Pose& T_map_base) const {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < read_; ++i)
      if (distanceBetween(places_[i].T_map_base, T_map_base) < distanceBetween(places_[nearest].T_map_base, T_map_base))
        nearest = i;
    return nearest;
  }

  /// The places whose outlines the cloud's can be laid upon best, at places_apart or more from each other.
  std::vector<std::size_t> alike(const PointCloud& cloud) const {
    const Outline outline = outlineOf(makeSurfels(cloud, static_cast<float>(parameters_.voxel)), kCoarse);
    std::vector<std::pair<double, std::size_t>> scores;
    for (std::size_t i = 0; i < read_; ++i) {
      const std::vector<Candidate> found = searchGlobally(outline, places_[i].outline, urban_nav_core::Vector3d::Zero(),
                                                          parameters_.search_radius, kCoarse);
      if (!found.empty()) scores.emplace_back(-found.front().score, i);
    }
    std::sort(scores.begin(), scores.end());
    std::vector<std::size_t> best;
    for (const auto& [score, i] : scores) {
      if (best.size() == cloud_candidates) break;
      const auto isBeside = [&, i = i](std::size_t other) {
        return distanceBetween(places_[i].T_map_base, places_[other].T_map_base) < 0.9 * places_apart;
      };
      if (std::none_of(best.begin(), best.end(), isBeside)) best.push_back(i);
    }
    return best;
  }

  std::optional<Sighting> at(std::size_t place, const Looked& looked, const Start& start) const {
    const PoseRef& moment = places_[place].at;
    const Pose& T_map_place = places_[place].T_map_base;
    const PointCloud target = surroundings_->cloud(moment, parameters_.cloud_way);
    Known known;
    known.bend = std::hypot(looked.bend, surroundings_->bend(moment, parameters_.cloud_way));
    const Alignment found = align(looked.cloud, target, start.is_known ? parameters_ : demanding_,
                                  T_map_place.inverse() * start.T_map_base, start.search, known);
    if (found.verdict == ClosureVerdict::Rejected) return std::nullopt;
    // One flat facade lies on any other: what slides tells no place from another, unless it is known which one it is.
    if (found.verdict == ClosureVerdict::Degenerate && !start.is_known) return std::nullopt;
    return Sighting{place, T_map_place, {found.T_target_source, found.information}};
  }

  /// Where all of them that fit say the same: else the map has more than one place like this. The map's own place there must fit too, which saw more of what stands around than one
  /// further off that looks like it.
  std::optional<Sighting> among(const std::vector<std::size_t>& places, const Looked& looked) const {
    std::optional<Sighting> seen;
    for (const std::size_t place : places) {
      const std::optional<Sighting> found = at(place, looked, {Search::AtOnce, places_[place].T_map_base, false});
      if (!found) continue;
      if (!seen) seen = found;
      else if (distanceBetween(seen->T_map_base(), found->T_map_base()) > one_place) return std::nullopt;
    }
    if (!seen) return std::nullopt;
    const std::size_t nearest = nearestTo(seen->T_map_base());
    if (nearest == seen->place) return seen;
    const auto there = at(nearest, looked, {Search::Never, seen->T_map_base(), false});
    if (!there || distanceBetween(seen->T_map_base(), there->T_map_base()) > one_place) return std::nullopt;
    return there;
  }

  Parameters parameters_, demanding_;
  std::unique_ptr<StoredSurroundings> surroundings_;
  std::vector<MapPlace> places_;
  std::size_t read_ = 0;
  std::optional<StampNs> looked_;  // the newest frame then
};

CloudSearch::CloudSearch(const Parameters& parameters, const FrozenMap& map, urban_nav_store::Store& store)
    : implementation_(std::make_unique<Implementation>(parameters, map, store)) {}
CloudSearch::~CloudSearch() = default;

std::size_t CloudSearch::places() const { return implementation_->places(); }
std::size_t CloudSearch::read() const { return implementation_->read(); }
bool CloudSearch::readNext() { return implementation_->readNext(); }
std::optional<CloudSearch::Stretch> CloudSearch::due(const Localiser& localiser) const {
  return implementation_->due(localiser);
}
bool CloudSearch::look(const Stretch& stretch, const PointCloud& cloud, double bend, Localiser& localiser) {
  return implementation_->look(stretch, cloud, bend, localiser);
}

}  // namespace loop_metric
