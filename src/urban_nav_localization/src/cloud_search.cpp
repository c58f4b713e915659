// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_localization/cloud_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "near.hpp"
#include "urban_nav_core/geometry/compose.hpp"
#include "urban_nav_core/geometry/covariance_frames.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_registration/cloud/surfels.hpp"
#include "urban_nav_registration/global/search.hpp"
#include "urban_nav_registration/icp/align.hpp"
#include "urban_nav_registration/session/session_lasers.hpp"
#include "urban_nav_registration/session/session_odometry.hpp"
#include "urban_nav_registration/session/stored_beams.hpp"

namespace urban_nav_localization {

using urban_nav_core::ClosureVerdict;
using urban_nav_core::Constraint;
using urban_nav_core::OdometryChain;
using urban_nav_core::PointCloud;
using urban_nav_core::Pose;
using urban_nav_core::PoseWithCovariance;
using urban_nav_core::StampNs;
using urban_nav_registration::align;
using urban_nav_registration::Alignment;
using urban_nav_registration::AlignmentPrior;
using urban_nav_registration::deformationSigma;
using urban_nav_registration::extractVerticalStructure;
using urban_nav_registration::kCoarseResolution;
using urban_nav_registration::LaserAt;
using urban_nav_registration::LaserScans;
using urban_nav_registration::localCloud;
using urban_nav_registration::makeSurfels;
using urban_nav_registration::PoseCandidate;
using urban_nav_registration::readOdometry;
using urban_nav_registration::searchGlobally;
using urban_nav_registration::SearchMode;
using urban_nav_registration::SessionOdometry;
using urban_nav_registration::storedBeamSources;
using urban_nav_registration::storedScans;
using urban_nav_registration::VerticalStructure;

namespace {

constexpr double kPlaceDistance = 5.0;      // m between places of the map; a cloud extends twice as far to both sides
constexpr double kMinHalfLength = 3.0;      // m of a stretch of planar scans that is searched for
constexpr double kMinFirmHalfLength = 5.0;  // m of a stretch of planar scans whose match may start a hypothesis
// m of a stretch of sweeps: as between two matches that are independent, and its sweeps fill the gaps between rings.
constexpr double kMinSweepHalfLength = 1.0;
constexpr double kMaxSweepHalfLength = 3.0;      // m; further sweeps show the same surroundings again
constexpr double kQueryDistance = 2.0;           // m between queries
constexpr double kLocalizedQueryDistance = 5.0;  // m between queries while Localized
constexpr std::size_t kMaxAlignedPlaces = 3;     // of one query
// Smallest overlap of the vertical structure without a pose prior. Of firm stretches, 95 of 100 correct matches have
// 0.77 and more; false ones in courtyards that pass all other tests have 0.62 to 0.66, those of shorter stretches up to
// 0.88.
constexpr double kMinOverlapWithoutPrior = 0.7;
constexpr double kSamePoseDistance = 1.0;   // m; results further apart contradict each other
constexpr double kMaxNearbyDistance = 8.0;  // m from the prior to a place that is tried first

/// Gapless part of a session of the map, and its lasers.
struct Drive {
  SessionOdometry::Part odometry;
  std::vector<LaserScans> scans;
};

/// Place of the map on the path of a session, with its surroundings.
struct Place {
  std::size_t drive;  ///< index of the Drive
  StampNs stamp;
  Pose T_map_base;
  VerticalStructure structure;
};

/// Returns T_a_b extended by odometry from b on; directions without information keep next to none.
Constraint carried(const Constraint& measured, const PoseWithCovariance& T_b_end) {
  constexpr double kMetresPerRadian = 10.0;
  const PoseWithCovariance end = compose(
      PoseWithCovariance{measured.T_a_b, urban_nav_core::covarianceForDisplay(measured.information, kMetresPerRadian)},
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
      : parameters_(parameters), demanding_(parameters.registration), beams_(store) {
    demanding_.min_overlap = std::max(demanding_.min_overlap, kMinOverlapWithoutPrior);
    for (const urban_nav_store::StoredTrajectory& session : map.sessions()) {
      const std::vector<LaserAt> lasers = storedBeamSources(store, session.session.id);
      if (lasers.empty()) continue;
      addPlaces(session, readOdometry(store, session.session.id), storedScans(beams_, session.session.id, lasers));
    }
  }

  std::size_t places() const { return places_.size(); }
  std::size_t read() const { return read_; }
  bool readNext() {
    if (read_ < places_.size()) {
      Place& place = places_[read_++];
      place.structure = extractVerticalStructure(
          makeSurfels(cloudAt(place), static_cast<float>(parameters_.registration.voxel_size)), kCoarseResolution);
    }
    return read_ < places_.size();
  }

  std::optional<Stretch> due(const Localiser& localiser, BeamSources sources) const {
    const OdometryChain& odometry = localiser.odometry();
    if (odometry.empty() || places_.empty()) return std::nullopt;
    const StampNs newest = odometry.trajectory().back().stamp;
    const double driven = odometry.distance(newest);
    const bool by_sweeps = sources == BeamSources::Lidars;
    double way = std::min(parameters_.registration.cloud_half_length, driven / 2.0);
    if (by_sweeps) way = std::min(way, kMaxSweepHalfLength);
    if (way < (by_sweeps ? kMinSweepHalfLength : kMinHalfLength)) return std::nullopt;
    const bool is_known = localiser.now().state == LocalizationState::Localized;
    const double distance = is_known ? kLocalizedQueryDistance : kQueryDistance;
    if (last_query_ && odometry.nearestFrame(*last_query_) && driven - odometry.distance(*last_query_) < distance)
      return std::nullopt;
    if (is_known && localiser.distanceSinceMatch() < distance) return std::nullopt;
    Stretch stretch;
    stretch.way = way;
    stretch.at = frameAt(odometry, driven - way);
    stretch.is_firm = by_sweeps || way >= kMinFirmHalfLength;
    return stretch;
  }

  void addMiss(const Stretch& stretch, Localiser& localiser) const {
    const StampNs end = localiser.odometry().trajectory().back().stamp;
    const LocalizationEstimate prior = localiser.at(stretch.at);
    localiser.addMiss(end, prior.state == LocalizationState::Localized && near(prior).has_value());
  }

  bool query(const Stretch& stretch, const PointCloud& cloud, double deformation_sigma, Localiser& localiser) {
    const StampNs end = localiser.odometry().trajectory().back().stamp;
    last_query_ = end;
    const auto T_middle_end = localiser.odometry().between(stretch.at, end);
    if (cloud.points.empty() || !T_middle_end) return false;
    const Query queried{cloud, deformation_sigma, localiser.at(stretch.at)};
    std::optional<MapMatch> seen;
    if (const auto place = near(queried.prior)) {
      const LocalizationEstimate& prior = queried.prior;
      seen = at(*place, queried,
                {SearchMode::IfRejected, prior.T_map_base->pose, prior.state == LocalizationState::Localized});
    }
    if (!seen) seen = among(alike(cloud), queried);
    if (!seen) return false;
    // The match counts at the end of the stretch: all of it has been matched.
    localiser.addMatch(end, seen->T_map_place, carried(seen->measured, *T_middle_end), stretch.is_firm);
    return true;
  }

 private:
  struct Query {
    const PointCloud& cloud;
    double deformation_sigma;
    LocalizationEstimate prior;
  };
  /// Start of an alignment, in the map.
  struct Start {
    SearchMode search;
    Pose T_map_base;
    bool is_known;  ///< the robot is known to be near it
  };
  struct MapMatch {
    std::size_t place = 0;
    Pose T_map_place;
    Constraint measured;

    Pose T_map_base() const { return T_map_place * measured.T_a_b; }
  };

  void addPlaces(const urban_nav_store::StoredTrajectory& session, const SessionOdometry& odometry,
                 const std::vector<LaserScans>& scans) {
    if (odometry.empty()) return;
    const std::size_t first = drives_.size();
    for (const SessionOdometry::Part& part : odometry.parts()) drives_.push_back({part, scans});
    const Pose* last = nullptr;
    for (const urban_nav_core::StampedPose& pose : session.T_map_base) {
      if (last != nullptr && distanceBetween(*last, pose.pose) < kPlaceDistance) continue;
      const std::size_t part = odometry.partAt(pose.stamp);
      if (!odometry.parts()[part]->nearestFrame(pose.stamp)) continue;
      last = &pose.pose;
      places_.push_back({first + part, pose.stamp, pose.pose, {}});
    }
  }

  PointCloud cloudAt(const Place& place) const {
    const Drive& drive = drives_[place.drive];
    return localCloud(*drive.odometry, place.stamp, parameters_.registration.cloud_half_length, drive.scans);
  }
  double deformationSigmaAt(const Place& place) const {
    return deformationSigma(*drives_[place.drive].odometry, place.stamp, parameters_.registration.cloud_half_length);
  }

  /// Returns the first frame at a distance along the odometry.
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

  /// Returns the place nearest to the prior; nullopt if the prior is too uncertain or no place is near.
  std::optional<std::size_t> near(const LocalizationEstimate& prior) const {
    if (read_ == 0 || !isNearKnownPlace(prior)) return std::nullopt;
    const std::size_t nearest = nearestTo(prior.T_map_base->pose);
    if (distanceBetween(places_[nearest].T_map_base, prior.T_map_base->pose) > kMaxNearbyDistance) return std::nullopt;
    return nearest;
  }

  std::size_t nearestTo(const Pose& T_map_base) const {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < read_; ++i)
      if (distanceBetween(places_[i].T_map_base, T_map_base) < distanceBetween(places_[nearest].T_map_base, T_map_base))
        nearest = i;
    return nearest;
  }

  /// Returns the places whose vertical structure fits that of the cloud best, at different positions.
  std::vector<std::size_t> alike(const PointCloud& cloud) const {
    const VerticalStructure structure = extractVerticalStructure(
        makeSurfels(cloud, static_cast<float>(parameters_.registration.voxel_size)), kCoarseResolution);
    std::vector<std::pair<double, std::size_t>> scores;
    for (std::size_t i = 0; i < read_; ++i) {
      const std::vector<PoseCandidate> found =
          searchGlobally(structure, places_[i].structure, urban_nav_core::Vector3d::Zero(),
                         parameters_.registration.search_radius, kCoarseResolution);
      if (!found.empty()) scores.emplace_back(-found.front().score, i);
    }
    std::sort(scores.begin(), scores.end());
    std::vector<std::size_t> best;
    for (const auto& [score, i] : scores) {
      if (best.size() == kMaxAlignedPlaces) break;
      const auto isNeighbour = [&, i = i](std::size_t other) {
        return distanceBetween(places_[i].T_map_base, places_[other].T_map_base) < 0.9 * kPlaceDistance;
      };
      if (std::none_of(best.begin(), best.end(), isNeighbour)) best.push_back(i);
    }
    return best;
  }

  std::optional<MapMatch> at(std::size_t place, const Query& queried, const Start& start) const {
    const Pose& T_map_place = places_[place].T_map_base;
    const PointCloud target = cloudAt(places_[place]);
    AlignmentPrior known;
    known.deformation_sigma = std::hypot(queried.deformation_sigma, deformationSigmaAt(places_[place]));
    const Alignment found = align(queried.cloud, target, start.is_known ? parameters_.registration : demanding_,
                                  T_map_place.inverse() * start.T_map_base, start.search, known);
    if (found.verdict == ClosureVerdict::Rejected) return std::nullopt;
    // One flat facade fits any other: a result with free directions does not identify a place, unless the pose is
    // known.
    if (found.verdict == ClosureVerdict::Degenerate && !start.is_known) return std::nullopt;
    return MapMatch{place, T_map_place, {found.T_target_source, found.information}};
  }

  /// Returns the match if all places that fit agree on one pose; otherwise the map has several similar places. The
  /// place of the map nearest to that pose must fit too, since it has more of its surroundings than a similar one
  /// further away.
  std::optional<MapMatch> among(const std::vector<std::size_t>& places, const Query& queried) const {
    std::optional<MapMatch> seen;
    for (const std::size_t place : places) {
      const std::optional<MapMatch> found = at(place, queried, {SearchMode::AtOnce, places_[place].T_map_base, false});
      if (!found) continue;
      if (!seen) seen = found;
      else if (distanceBetween(seen->T_map_base(), found->T_map_base()) > kSamePoseDistance) return std::nullopt;
    }
    if (!seen) return std::nullopt;
    const std::size_t nearest = nearestTo(seen->T_map_base());
    if (nearest == seen->place) return seen;
    const auto there = at(nearest, queried, {SearchMode::Never, seen->T_map_base(), false});
    if (!there || distanceBetween(seen->T_map_base(), there->T_map_base()) > kSamePoseDistance) return std::nullopt;
    return there;
  }

  const Parameters parameters_;
  urban_nav_registration::Parameters demanding_;
  const urban_nav_registration::BeamReader beams_;
  std::vector<Drive> drives_;
  std::vector<Place> places_;
  std::size_t read_ = 0;
  std::optional<StampNs> last_query_;  // newest frame at the last query
};

CloudSearch::CloudSearch(const Parameters& parameters, const FrozenMap& map, urban_nav_store::Store& store)
    : implementation_(std::make_unique<Implementation>(parameters, map, store)) {}
CloudSearch::~CloudSearch() = default;

std::size_t CloudSearch::places() const { return implementation_->places(); }
std::size_t CloudSearch::read() const { return implementation_->read(); }
bool CloudSearch::readNext() { return implementation_->readNext(); }
std::optional<CloudSearch::Stretch> CloudSearch::due(const Localiser& localiser, BeamSources sources) const {
  return implementation_->due(localiser, sources);
}
void CloudSearch::addMiss(const Stretch& stretch, Localiser& localiser) const {
  implementation_->addMiss(stretch, localiser);
}
bool CloudSearch::query(const Stretch& stretch, const PointCloud& cloud, double deformation_sigma,
                        Localiser& localiser) {
  return implementation_->query(stretch, cloud, deformation_sigma, localiser);
}

}  // namespace urban_nav_localization
