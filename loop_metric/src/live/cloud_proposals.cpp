// SPDX-License-Identifier: BSD-3-Clause
#include "live/cloud_proposals.hpp"

#include <utility>

namespace loop_metric {

using urban_nav_registration::CloudPlaces;

void CloudProposals::follow(const std::string& part, const urban_nav_core::PoseRef& at,
                            const urban_nav_core::OdometryChain& odometry, bool is_known, bool all) {
  const urban_nav_core::Trajectory& frames = odometry.trajectory();
  if (frames.empty()) return;
  const auto added = parts_.emplace(part, Followed{parts_.size(), 0.0, 0});
  Followed& followed = added.first->second;
  const double driven = odometry.distance(frames.back().stamp);
  for (; followed.frame < frames.size(); ++followed.frame) {
    const urban_nav_core::StampNs stamp = frames[followed.frame].stamp;
    const double distance = odometry.distance(stamp);
    if (!all && driven - distance < CloudPlaces::kHalfLength) return;
    if (distance < followed.next) continue;
    followed.next = distance + CloudPlaces::kSpacing;
    waiting_.push_back({{at.session, stamp}, part, distance, is_known});
  }
}

std::optional<CloudProposals::Place> CloudProposals::next() {
  if (waiting_.empty()) return std::nullopt;
  Place place = std::move(waiting_.front());
  waiting_.pop_front();
  return place;
}

std::vector<urban_nav_core::TopologicalClosure> CloudProposals::describe(const Place& place,
                                                                         const urban_nav_core::PointCloud& cloud) {
  std::vector<urban_nav_core::TopologicalClosure> closures;
  auto description = urban_nav_registration::describePlace(cloud, voxel_);
  if (!description) return closures;
  described_.push_back(place.at);
  for (const urban_nav_registration::SimilarPlaces& similar :
       finder_.add({std::move(*description), parts_[place.part].number, place.distance, place.is_known}))
    closures.push_back({described_[similar.earlier], place.at, similar.similarity});
  return closures;
}

void CloudProposals::nameRunning(const std::string& id) {
  for (urban_nav_core::PoseRef& at : described_)
    if (at.session.empty()) at.session = id;
  for (Place& place : waiting_)
    if (place.at.session.empty()) place.at.session = id;
}

}  // namespace loop_metric
