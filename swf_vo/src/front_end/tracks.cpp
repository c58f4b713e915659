// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/tracks.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/camera/surface.hpp"
#include "urban_nav_core/io/archive_types.hpp"

namespace swf_vo {

using urban_nav_core::PatchTemplate;
using urban_nav_core::PatchWarp;
using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;

Eigen::Vector3d surfaceAt(const Track& track, double inverse_depth) {
  return urban_nav_core::surfaceAt(track.plane, track.ray, inverse_depth);
}

std::optional<PatchWarp> warpInto(Side side, const StereoCamera& camera, const Track& track, const Pose& T_camera_born,
                                  double inverse_depth) {
  Eigen::Vector3d t = T_camera_born.t();
  if (side == Side::Right) t.x() -= camera.baseline;
  return urban_nav_core::warpOfSurface(camera, surfaceAt(track, inverse_depth), track.ray, {T_camera_born.q(), t});
}

Eigen::Vector2d slantDirection(const StereoCamera& camera, const Track& track, const Pose& T_camera_born,
                               double inverse_depth) {
  const Eigen::Vector3d t = T_camera_born.t();
  const Eigen::Vector3d p = T_camera_born.q() * track.ray + t * std::max(inverse_depth, 0.0);
  if (!(p.z() > 0.05)) return Eigen::Vector2d::Zero();
  const Eigen::Vector2d along = (t.head<2>() - p.head<2>() / p.z() * t.z()) / p.z();
  return {along.x(), along.y() * camera.left.fy / camera.left.fx};
}

Tracks::Tracks(int capacity) : places_(static_cast<std::size_t>(capacity)) {
  order_.reserve(places_.size());
  free_.reserve(places_.size());
  for (std::size_t i = places_.size(); i > 0; --i) free_.push_back(i - 1);
}

std::vector<Tracks::Entry>::iterator Tracks::lowerBound(LandmarkId id) {
  return std::lower_bound(order_.begin(), order_.end(), id,
                          [](const Entry& entry, LandmarkId value) { return entry.id < value; });
}

Track* Tracks::start() {
  if (free_.empty()) return nullptr;
  const std::size_t place = free_.back();
  free_.pop_back();
  order_.push_back({next_, place});  // ids increase, so it is the last
  places_[place] = Track();
  places_[place].id = next_++;
  return &places_[place];
}

Track* Tracks::find(LandmarkId id) {
  const auto it = lowerBound(id);
  return it != order_.end() && it->id == id ? &places_[it->place] : nullptr;
}

void Tracks::end(LandmarkId id) {
  const auto it = lowerBound(id);
  if (it == order_.end() || it->id != id) return;
  free_.push_back(it->place);
  order_.erase(it);
}

namespace {

/// Makes the template of a track again as prepareTemplate() does. Returns false if the warp is degenerate, or the blur
/// out of range.
bool remakeTemplate(const Track& track, const Eigen::Vector2d& blur, const PatchWarp& warp, PatchTemplate& made) {
  if (!(blur.minCoeff() >= 0.0 && blur.maxCoeff() <= urban_nav_core::kLargestBlur)) return false;
  if (blur.isZero()) return urban_nav_core::warpTemplate(track.source, warp, made);
  return urban_nav_core::warpTemplate(urban_nav_core::blurred(track.source, blur), warp, made);
}

bool isSame(const PatchTemplate& a, const PatchTemplate& b) {
  return a.value == b.value && a.filter_x == b.filter_x && a.filter_y == b.filter_y && a.filter_gain == b.filter_gain &&
         a.inverse_hessian == b.inverse_hessian && a.unit_covariance == b.unit_covariance &&
         a.view_blur == b.view_blur && a.energy == b.energy;
}

/// Reads or writes a template: only its warp, a fiftieth of its bytes, if the source and the warp give it bit-exactly.
void archiveTemplate(urban_nav_core::Archive& archive, const Track& track, const Eigen::Vector2d& blur,
                     PatchTemplate& patch) {
  PatchTemplate again;
  bool is_remade = !archive.isReading() && remakeTemplate(track, blur, patch.warp, again) && isSame(again, patch);
  archive(is_remade);
  if (!is_remade) return archive(patch);
  archive(patch.warp.A, patch.warp.bend);
  if (!archive.isReading()) return;
  const PatchWarp warp = patch.warp;
  archive.require(remakeTemplate(track, blur, warp, patch), "the warp or blur of a template is out of range");
}

}  // namespace

void archive(urban_nav_core::Archive& archive, Track& track) {
  archive(track.id, track.born, track.level, track.noise.squares, track.noise.coordinates);
  archive(track.seen, track.blurred, track.aside, track.missed, track.disagreed);
  archive(track.T_born_odom, track.ray, track.plane, track.slant, track.slant_reach, track.seen_as);
  archive(track.sigma_disparity, track.z, track.information, track.measured, track.source);
  archive(track.born_edges, track.blur, track.made_blur_left, track.made_blur_right, track.sharper);
  archive(track.left_ready, track.right_ready);
  if (track.left_ready) archiveTemplate(archive, track, track.made_blur_left, track.in_left);
  if (track.right_ready) archiveTemplate(archive, track, track.made_blur_right, track.in_right);
}

void Tracks::archive(urban_nav_core::Archive& archive, int levels) {
  std::size_t size = order_.size();
  archive(next_, free_);
  archive.count(size);
  archive.require(size + free_.size() == places_.size(), "inconsistent track storage");
  if (archive.isReading()) order_.assign(size, Entry());
  std::vector<bool> taken(places_.size(), false);
  const auto take = [&](std::size_t place) {
    archive.require(place < places_.size() && !taken[place], "invalid or duplicate track index");
    taken[place] = true;
  };
  for (const std::size_t place : free_) take(place);
  LandmarkId last = -1;
  for (Entry& entry : order_) {
    archive(entry.id, entry.place);
    take(entry.place);
    Track& track = places_[entry.place];
    if (archive.isReading()) track = Track();
    archive(track);
    archive.require(entry.id > last && entry.id < next_ && track.id == entry.id, "track ids are not increasing");
    archive.require(track.level >= 0 && track.level < levels, "pyramid level of a track out of range");
    last = entry.id;
  }
}

}  // namespace swf_vo
