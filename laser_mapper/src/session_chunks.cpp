// SPDX-License-Identifier: BSD-3-Clause
#include "session_chunks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "laser_mapper/sensors.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_store/digest.hpp"
#include "urban_nav_store/tables/near_points.hpp"

namespace laser_mapper {

using urban_nav_core::Scan;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_store::MapChunk;
using urban_nav_store::NearPoints;

namespace {

constexpr std::size_t kBatch = 8;                           // chunks read before they are rendered, on all threads
constexpr std::size_t kBatchBytes = std::size_t{96} << 20;  // bytes of their sweeps
constexpr double kLongestPause = 0.5;                       // s between scans of a running laser

}  // namespace

std::vector<LaserInput> readLasers(urban_nav_store::Store& store, const urban_nav_store::SessionId& session,
                                   const std::vector<MountedLaser>& lasers, StampNs begin) {
  std::vector<LaserInput> inputs;
  for (std::size_t i = 0; i < lasers.size(); ++i) {
    LaserInput input;
    input.T_base_laser = lasers[i].T_base_laser;
    input.laser = planarSensor(lasers[i].frame, i);
    const StampNs delay = lasers[i].delay;
    store.scans().forEach(session, lasers[i].frame, begin + delay, begin + delay + kChunkNs - 1, [&](const Scan& scan) {
      input.scans.push_back(urban_nav_registration::withoutDelay(scan, delay));
    });
    inputs.push_back(std::move(input));
  }
  return inputs;
}

std::size_t SessionChunks::count(const Trajectory& T_map_base) {
  if (T_map_base.empty()) return 0;
  return static_cast<std::size_t>((chunkBegin(T_map_base.back().stamp) - chunkBegin(T_map_base.front().stamp)) /
                                  kChunkNs) +
         1;
}

SessionChunks::SessionChunks(const Parameters& parameters, urban_nav_store::Store& store,
                             const urban_nav_store::SessionId& session, const Trajectory& T_map_base)
    : parameters_(parameters),
      store_(store),
      session_(session),
      T_map_base_(T_map_base),
      max_gap_(std::llround(parameters.max_gap * 1e9)),
      lasers_(mountedLasers(store, session)),
      chunk_store_(store, session),
      evidence_(store, session),
      settings_(renderSettings(parameters, lasers_)),
      last_scan_(lasers_.size(), 0),
      silent_(lasers_.size(), 0.0) {
  for (const std::string& frame : store.scans().lasers(session))
    if (std::none_of(lasers_.begin(), lasers_.end(), [&](const auto& laser) { return laser.frame == frame; }))
      warnings_.push_back("scans of " + frame + " are ignored: its pose on the robot is unknown");
}

bool SessionChunks::isCurrent(const Stored& stored, const Task& task) const {
  const auto found = stored.find(task.begin);
  return found != stored.end() && found->second.settings == task.settings &&
         chunkShift(found->second.poses, T_map_base_, task.begin, max_gap_) <= parameters_.max_shift;
}

void SessionChunks::readEvidence(Task& task) {
  const std::string read = evidence_.read(task.begin, parameters_, task.input);
  if (!read.empty()) task.settings = urban_nav_store::sha256(task.settings + read);
}

void SessionChunks::readStereo(Task& task) const {
  std::string rows;
  if (parameters_.stereo)
    urban_nav_store::TableStore<NearPoints>(store_).forEachBetween(
        {session_, 0, {}, 0.0, {}}, task.begin, task.begin + kChunkNs - 1, [&](const NearPoints& row) {
          StereoFrame frame;
          frame.stamp = row.stamp;
          frame.camera_base = row.camera;
          for (const NearPoints::Point& point : row.points())
            frame.points.push_back({point.p_base, point.sigma, static_cast<float>(point.grey)});
          task.input.stereo.push_back(std::move(frame));
          rows += row.packed;
        });
  task.settings = rows.empty() ? settings_ : urban_nav_store::sha256(settings_ + rows);
}

void SessionChunks::checkContinuity(std::size_t laser, const Scan& scan) {
  const double pause = last_scan_[laser] == 0 ? 0.0 : urban_nav_core::secondsBetween(last_scan_[laser], scan.stamp);
  if (pause > kLongestPause) silent_[laser] += pause;
  last_scan_[laser] = scan.stamp;
}

void SessionChunks::readScans(Task& task) {
  task.input.lasers = readLasers(store_, session_, lasers_, task.begin);
  for (std::size_t i = 0; i < task.input.lasers.size(); ++i)
    for (const Scan& scan : task.input.lasers[i].scans) checkContinuity(i, scan);
}

void SessionChunks::renderTasks(std::vector<Task>& tasks, const Stored& stored) {
  urban_nav_core::forEach(tasks.size(), 1, [&](std::size_t i) {
    Task& task = tasks[i];
    const RenderedChunk chunk = renderChunk(parameters_, T_map_base_, task.input, task.begin);
    task.beams = chunk.beams;
    for (const RenderedChunk::Part& part : chunk.parts) task.parts.push_back(packPart(part.tile, part.cells));
  });
  for (Task& task : tasks) {
    const BeamCounts& beams = task.beams;
    MapChunk header;
    header.begin = task.begin;
    header.end = task.begin + kChunkNs;
    header.settings = task.settings;
    header.poses = packChunkPoses(T_map_base_, task.begin, max_gap_);
    header.beams = static_cast<std::int64_t>(beams.all);
    header.mixed = static_cast<std::int64_t>(beams.mixed);
    header.without_pose = static_cast<std::int64_t>(beams.without_pose);
    header.out_of_range = static_cast<std::int64_t>(beams.out_of_range);
    const auto old = stored.find(task.begin);
    for (const PackedPart& part : task.parts) tiles_.insert(part.tile);
    chunk_store_.put(header, std::move(task.parts), old == stored.end() ? nullptr : &old->second);
    beams_ = beams_ + beams;
  }
  rendered_ += tasks.size();
  tasks.clear();
  store_.commit();
}

void SessionChunks::reportGaps() {
  for (std::size_t i = 0; i < lasers_.size(); ++i)
    if (silent_[i] > 0.0)
      warnings_.push_back(lasers_[i].frame + " has no scans during " +
                          std::to_string(static_cast<int>(std::ceil(silent_[i]))) + " s of the rendered time");
}

void SessionChunks::update(const std::function<void(std::size_t)>& progress) {
  if (T_map_base_.empty()) return;
  const Stored stored = chunk_store_.chunks();
  const StampNs first = chunkBegin(T_map_base_.front().stamp), last = chunkBegin(T_map_base_.back().stamp);
  for (const auto& [begin, chunk] : stored)
    if (begin < first || begin > last) chunk_store_.remove(chunk);
  std::vector<Task> tasks;
  std::size_t bytes = 0;
  for (StampNs begin = first; begin <= last; begin += kChunkNs) {
    ++chunks_;
    Task task;
    task.begin = begin;
    readStereo(task);
    readEvidence(task);
    if (isCurrent(stored, task)) {
      const MapChunk& chunk = stored.at(begin);
      const auto size = [](std::int64_t n) { return static_cast<std::size_t>(n); };
      beams_ =
          beams_ + BeamCounts{size(chunk.beams), size(chunk.mixed), size(chunk.without_pose), size(chunk.out_of_range)};
      for (const Tile& tile : chunkTiles(chunk)) tiles_.insert(tile);
      continue;
    }
    readScans(task);
    for (const LidarInput& lidar : task.input.lidars)
      for (const auto& sweep : lidar.sweeps) bytes += sweep->packed.size();
    tasks.push_back(std::move(task));
    if (tasks.size() == kBatch || bytes > kBatchBytes) {
      renderTasks(tasks, stored);
      bytes = 0;
    }
    progress(chunks_);
  }
  renderTasks(tasks, stored);
  progress(chunks_);
  reportGaps();
}

}  // namespace laser_mapper
