// SPDX-License-Identifier: BSD-3-Clause
#include "topics/vo/vo_run_state.hpp"

#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_core::Archive;
using urban_nav_core::DataError;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::Quaterniond;
using urban_nav_core::Vector3d;

namespace {

constexpr const char* kVoRunName = "visual odometry of a session";
constexpr std::uint32_t kVoRunVersion = 8;
/// Version 2 was not sealed: its number in four bytes, then the content.
constexpr std::string_view kVoRunHead2("\2\0\0\0", 4);

/// A frame in a stored state.
struct StoredRow {
  OdometryFrame frame;
  VoFigures figures;
};

void archive(Archive& archive, StoredRow& row) {
  archive(row.frame.frame, row.frame.stamp, row.frame.accepted, row.frame.status, row.figures.statistics,
          row.frame.T_odom_base, row.figures.process_ms);
}

/// Stored members of a run.
struct StoredRun {
  std::vector<StoredRow> rows;
  std::vector<swf_vo::Settled> settled;
  std::vector<VoLandmark> landmarks;
  std::vector<urban_nav_core::ConsideredConstants> constants;  // of each step of `settled`
  std::vector<urban_nav_core::FrameMeasurements> compared;     // one for each row
  std::vector<Vector3d> right_turns;                           // one for each row
};

StoredRun toStored(const VoRun& run) {
  StoredRun stored;
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    stored.rows.push_back({run.frames[i], run.figures[i]});
    stored.compared.push_back(run.frames[i].compared);
    stored.right_turns.push_back(run.figures[i].statistics.right_turn_rad);
  }
  for (const SmoothedFrame& frame : run.settled)
    stored.settled.push_back({frame.frame, frame.stamp, frame.T_odom_base, frame.from_previous, frame.status});
  for (const SmoothedFrame& frame : run.settled) stored.constants.push_back(frame.from_previous.constants);
  for (const auto& [id, landmark] : run.landmarks) stored.landmarks.push_back(landmark);
  return stored;
}

void fromStored(const StoredRun& stored, VoRun& run) {
  for (const StoredRow& row : stored.rows) {
    run.frames.push_back(row.frame);
    run.figures.push_back(row.figures);
  }
  for (const swf_vo::Settled& frame : stored.settled)
    run.settled.push_back({frame.frame, frame.stamp, frame.T_odom_base, frame.from_previous, frame.status});
  for (const VoLandmark& landmark : stored.landmarks) run.landmarks.emplace(landmark.landmark.id, landmark);
  for (std::size_t i = 0; i < stored.constants.size(); ++i)
    run.settled[i].from_previous.constants = stored.constants[i];
  for (std::size_t i = 0; i < stored.compared.size(); ++i) run.frames[i].compared = stored.compared[i];
  for (std::size_t i = 0; i < stored.rows.size(); ++i)
    run.frames[i].compared.reprojection_px = run.figures[i].statistics.reprojection_px;
  for (std::size_t i = 0; i < stored.right_turns.size(); ++i)
    run.rig.right_turn_rad = run.figures[i].statistics.right_turn_rad = run.frames[i].compared.right_turn =
        stored.right_turns[i];
}

/// Reads the content of version 2: poses with the translation first, matrices row by row.
class VoRunReader2 {
 public:
  explicit VoRunReader2(Archive& archive) : archive_(archive) {}

  void read(VoRun& run, StoredRun& stored) {
    list(stored.rows);
    list(stored.settled);
    archive_(run.pictures, run.faults, run.faults_total, run.forces, stored.landmarks);
  }

 private:
  template <typename Item>
  void list(std::vector<Item>& items) {
    std::size_t size = 0;
    archive_.count(size);
    for (std::size_t i = 0; i < size; ++i) read(items.emplace_back());
  }
  void read(StoredRow& row) {
    archive_(row.frame.frame, row.frame.stamp, row.frame.accepted, row.frame.status, row.figures.statistics);
    read(row.frame.T_odom_base);
    archive_(row.figures.process_ms);
  }
  void read(swf_vo::Settled& settled) {
    archive_(settled.frame, settled.stamp);
    read(settled.T_odom_base.pose);
    read(settled.T_odom_base.covariance);
    urban_nav_core::RelativePose& step = settled.from_previous;
    archive_(step.from, step.to);
    read(step.T_from_to);
    read(step.covariance);
    archive_(step.status, step.source);
    read(step.drift_covariance);
    archive_(settled.status);
  }
  void read(Pose& pose) {
    Vector3d t = Vector3d::Zero();
    Quaterniond::Coefficients q = Quaterniond::Identity().coeffs();
    archive_(t, q);
    archive_.require(q.norm() > 0.5 && q.norm() < 2.0, "a rotation is invalid");
    pose = Pose(Quaterniond(q), t);
  }
  void read(Matrix6d& matrix) {
    archive_(matrix);
    matrix.transposeInPlace();
  }

  Archive& archive_;
};

void members(Archive& archive, std::uint32_t version, VoRun& run, StoredRun& stored) {
  archive(stored.rows, stored.settled, run.pictures, run.faults, run.faults_total, run.forces, stored.landmarks);
  if (version > 3) archive(run.rig);
  if (version > 4) archive(stored.constants);
  if (version > 5) archive(run.motion);
  if (version > 6) archive(stored.compared);
  if (version > 7) archive(stored.right_turns);
  archive.require(stored.constants.empty() || stored.constants.size() == stored.settled.size(),
                  "the numbers of rig constants and steps differ");
  archive.require(stored.compared.empty() || stored.compared.size() == stored.rows.size(),
                  "the numbers of comparisons and frames differ");
  archive.require(stored.right_turns.empty() || stored.right_turns.size() == stored.rows.size(),
                  "the numbers of turns of the right camera and frames differ");
}

VoRun readVoRun(std::string_view bytes) {
  VoRun run;
  StoredRun stored;
  if (bytes.substr(0, kVoRunHead2.size()) == kVoRunHead2) {
    Archive reader(bytes.substr(kVoRunHead2.size()), kVoRunName);
    VoRunReader2(reader).read(run, stored);
    reader.finish();
  } else {
    const urban_nav_core::UnsealedState state = urban_nav_core::unseal(kVoRunName, 3, kVoRunVersion, bytes);
    Archive reader(state.content, kVoRunName);
    members(reader, state.version, run, stored);
    reader.finish();
  }
  fromStored(stored, run);
  return run;
}

}  // namespace

void archive(Archive& archive, VoPicture& picture) {
  archive(picture.frame, picture.stamp, picture.caption, picture.jpeg, picture.width, picture.height);
}

void archive(Archive& archive, VoLandmark& landmark) {
  archive(landmark.landmark.id, landmark.landmark.p_odom, landmark.landmark.sigma, landmark.grey, landmark.seen);
}

std::string packVoRun(VoRun run) {
  StoredRun stored = toStored(run);
  Archive writer;
  members(writer, kVoRunVersion, run, stored);
  return urban_nav_core::seal(kVoRunName, kVoRunVersion, writer.take());
}

std::optional<VoRun> unpackVoRun(std::string_view bytes) {
  try {
    return readVoRun(bytes);
  } catch (const DataError&) {
    return std::nullopt;
  }
}

}  // namespace urban_nav
