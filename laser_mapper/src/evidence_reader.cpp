// SPDX-License-Identifier: BSD-3-Clause
#include "evidence_reader.hpp"

#include <algorithm>
#include <utility>

#include "laser_mapper/sensors.hpp"
#include "urban_nav_store/digest.hpp"
#include "urban_nav_store/table_store.hpp"

namespace laser_mapper {

using urban_nav_core::StampNs;
using urban_nav_store::DepthImage;
using urban_nav_store::DepthView;
using urban_nav_store::LidarSweep;
using urban_nav_store::MountedLidar;
using urban_nav_store::TableStore;

namespace {

constexpr StampNs kEvidenceSpacing = 400'000'000;  // between sweeps used as evidence of free space

template <typename Key, typename Value>
void dropBefore(std::map<Key, Value>& values, const Key& first) {
  values.erase(values.begin(), values.lower_bound(first));
}

/// Returns the first sweep of each interval of kEvidenceSpacing.
template <typename Sweeps>
auto chooseSweeps(const Sweeps& sweeps) {
  std::vector<typename Sweeps::mapped_type> chosen;
  StampNs last = 0;
  for (const auto& [stamp, sweep] : sweeps) {
    const StampNs slot = stamp / kEvidenceSpacing;
    if (chosen.empty() || slot != last) chosen.push_back(sweep);
    last = slot;
  }
  return chosen;
}

}  // namespace

EvidenceReader::EvidenceReader(urban_nav_store::Store& store, urban_nav_store::SessionId session)
    : store_(store), session_(std::move(session)) {
  TableStore<MountedLidar>(store_).forEach(session_, [&](const MountedLidar& row) { lidars_.push_back({row, {}, 0}); });
}

void EvidenceReader::readViews(StampNs from, StampNs to, const Parameters& parameters) {
  if (parameters.stereo) {
    DepthView key;
    key.session = session_;
    TableStore<DepthView>(store_).forEachBetween(key, from, to, [&](const DepthView& row) {
      views_[{row.stamp, kStereo}] = {std::make_shared<const DepthFrame>(depthFrame(row)),
                                      urban_nav_store::sha256(row.packed)};
    });
  }
  for (std::size_t camera = 0; camera < kMostDepthCameras; ++camera) {
    DepthImage key;
    key.session = session_;
    key.role = depthRole(camera);
    const std::uint8_t sensor = depthSensor(camera);
    TableStore<DepthImage>(store_).forEachBetween(key, from, to, [&](const DepthImage& row) {
      DepthFrame frame = depthFrame(row, sensor, parameters.depth_sigma);
      std::string digest = urban_nav_store::sha256(row.packed) + std::to_string(frame.floor);
      views_[{row.stamp, sensor}] = {std::make_shared<const DepthFrame>(std::move(frame)), std::move(digest)};
    });
  }
}

void EvidenceReader::advance(StampNs from, StampNs to, const Parameters& parameters) {
  for (Lidar& lidar : lidars_) {
    dropBefore(lidar.sweeps, from);
    const LidarSweep key{session_, lidar.mounted.role, 0, {}};
    TableStore<LidarSweep>(store_).forEachBetween(
        key, std::max(from, lidar.read_to), to - 1,
        [&](const LidarSweep& row) { lidar.sweeps[row.reference] = std::make_shared<const LidarSweep>(row); });
    lidar.read_to = std::max(lidar.read_to, to);
  }
  dropBefore(views_, ViewKey(from, 0));
  readViews(std::max(from, views_read_to_), to - 1, parameters);
  views_read_to_ = std::max(views_read_to_, to);
}

std::string EvidenceReader::read(StampNs begin, const Parameters& parameters, ChunkInput& input) {
  advance(begin - kEvidenceNs, begin + kChunkNs + kEvidenceNs, parameters);
  std::string read;
  for (const Lidar& lidar : lidars_) {
    LidarInput input_of{lidar.mounted.T_base_lidar, lidarSensor(lidar.mounted.role), {}, chooseSweeps(lidar.sweeps)};
    for (const auto& [stamp, sweep] : lidar.sweeps) {
      read += lidar.mounted.role + " " + std::to_string(stamp) + " " + std::to_string(sweep->packed.size()) + "\n";
      if (stamp >= begin && stamp < begin + kChunkNs) input_of.sweeps.push_back(sweep);
    }
    input.lidars.push_back(std::move(input_of));
  }
  for (const auto& [key, view] : views_) {
    input.views.push_back(view.frame);
    read += std::to_string(key.first) + " " + view.digest + "\n";
  }
  return read;
}

}  // namespace laser_mapper
