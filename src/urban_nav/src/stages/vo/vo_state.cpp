// SPDX-License-Identifier: BSD-3-Clause
#include "stages/vo/vo_state.hpp"

#include "urban_nav_store/bytes.hpp"

namespace urban_nav {

using swf_vo::Settled;
using swf_vo::Statistics;
using urban_nav_core::Health;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::Status;
using urban_nav_core::UncertainPose;
using urban_nav_store::appendFloat;
using urban_nav_store::appendInteger;
using urban_nav_store::appendInteger32;
using urban_nav_store::appendNumber;
using urban_nav_store::appendText;
using urban_nav_store::ByteReader;

namespace {

constexpr std::uint32_t kVersion = 2;  // of these bytes

/// One description of what is packed serves both ways: each field is named once, for a Packer to append or an Unpacker to
/// read.
class Packer {
 public:
  template <typename Integer>
  void integer(const Integer& value) {
    appendInteger(bytes, static_cast<std::uint64_t>(static_cast<std::int64_t>(value)));
  }
  void number(const double& value) { appendNumber(bytes, value); }
  void real32(const float& value) { appendFloat(bytes, value); }
  void text(const std::string& value) { appendText(bytes, value); }
  void bytesOf(const std::vector<unsigned char>& value) { appendText(bytes, std::string(value.begin(), value.end())); }
  void pose(const Pose& value) {
    for (int i = 0; i < 3; ++i) number(value.t()(i));
    for (int i = 0; i < 4; ++i) number(value.q().coeffs()(i));
  }
  template <typename List, typename Each>
  void list(const List& values, const Each& each) {
    integer(values.size());
    for (const auto& value : values) each(value);
  }

  std::string bytes;
};

class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : reader(bytes) {}
  template <typename Integer>
  void integer(Integer& value) {
    value = static_cast<Integer>(static_cast<std::int64_t>(reader.integer()));
  }
  void number(double& value) { value = reader.number(); }
  void real32(float& value) { value = reader.real32(); }
  void text(std::string& value) { value = reader.text(); }
  void bytesOf(std::vector<unsigned char>& value) {
    const std::string_view text = reader.text();
    value.assign(text.begin(), text.end());
  }
  void pose(Pose& value) {
    double v[7];
    for (double& each : v) each = reader.number();
    const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
    const Eigen::Vector3d t(v[0], v[1], v[2]);
    if (q.coeffs().allFinite() && q.norm() > 0.5 && t.allFinite()) {
      value = Pose(q, t);
    } else {
      fine = false;
    }
  }
  template <typename List, typename Each>
  void list(List& values, const Each& each) {
    std::uint64_t count = reader.integer();
    if (!reader.ok() || count > reader.left()) count = 0, fine = false;  // each takes a byte at least
    values.resize(static_cast<std::size_t>(count));
    for (auto& value : values) {
      if (!fine || !reader.ok()) return;
      each(value);
    }
  }

  ByteReader reader;
  bool fine = true;
};

template <typename Way, typename Matrix>
void matrix(Way& way, Matrix& value) {
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column) way.number(value(row, column));
}

template <typename Way, typename AnyStatus>
void status(Way& way, AnyStatus& value) {
  way.integer(value.health);
  way.integer(value.reason);
  way.text(value.sentence);
}

template <typename Way, typename AnyStatistics>
void statistics(Way& way, AnyStatistics& value) {
  way.integer(value.corners);
  way.integer(value.features);
  way.integer(value.tracked);
  way.number(value.track_length_mean);
  way.number(value.reprojection_px);
  way.integer(value.iterations);
  way.integer(value.landmarks);
  way.integer(value.landmarks_in_prior);
  way.number(value.disparity_offset_px);
  way.number(value.disparity_offset_sigma_px);
  way.number(value.row_offset_px);
  way.number(value.noise_scale);
}

template <typename Way, typename AnyRow>
void row(Way& way, AnyRow& value) {
  way.integer(value.frame);
  way.integer(value.stamp);
  way.integer(value.accepted);
  status(way, value.status);
  statistics(way, value.statistics);
  way.pose(value.T_odom_base);
  way.number(value.process_ms);
}

template <typename Way, typename AnySettled>
void settled(Way& way, AnySettled& value) {
  way.integer(value.frame);
  way.integer(value.stamp);
  way.pose(value.T_odom_base.pose);
  matrix(way, value.T_odom_base.covariance);
  way.integer(value.from_previous.from);
  way.integer(value.from_previous.to);
  way.pose(value.from_previous.T_from_to);
  matrix(way, value.from_previous.covariance);
  status(way, value.from_previous.status);
  way.text(value.from_previous.source);
  matrix(way, value.from_previous.drift_covariance);
  status(way, value.status);
}

template <typename Way, typename AnyPicture>
void picture(Way& way, AnyPicture& value) {
  way.integer(value.frame);
  way.integer(value.stamp);
  way.text(value.caption);
  way.bytesOf(value.jpeg);
  way.integer(value.width);
  way.integer(value.height);
}

template <typename Way, typename AnyLandmark>
void landmark(Way& way, AnyLandmark& value) {
  way.integer(value.landmark.id);
  for (int i = 0; i < 3; ++i) way.number(value.landmark.p_odom(i));
  way.real32(value.landmark.sigma);
  way.integer(value.grey);
  way.integer(value.seen);
}

template <typename Way, typename AnyForce>
void force(Way& way, AnyForce& value) {
  way.integer(value.stamp);
  for (int i = 0; i < 3; ++i) way.number(value.force(i));
}

template <typename Way, typename Run>
void lists(Way& way, Run& run) {
  way.list(run.rows, [&](auto& each) { row(way, each); });
  way.list(run.settled, [&](auto& each) { settled(way, each); });
  way.list(run.pictures, [&](auto& each) { picture(way, each); });
  way.list(run.faults, [&](auto& each) { way.text(each); });
  way.integer(run.faults_total);
  way.list(run.forces, [&](auto& each) { force(way, each); });
}

bool isHealth(Health health) { return health >= Health::Ok && health <= Health::Recovered; }

}  // namespace

std::string packVoRun(const VoRun& run) {
  Packer packer;
  appendInteger32(packer.bytes, kVersion);
  lists(packer, run);
  packer.list(run.landmarks, [&](const auto& each) { landmark(packer, each.second); });
  return std::move(packer.bytes);
}

std::optional<VoRun> unpackVoRun(std::string_view bytes) {
  Unpacker unpacker(bytes);
  if (unpacker.reader.integer32() != kVersion) return std::nullopt;
  VoRun run;
  lists(unpacker, run);
  std::vector<VoLandmark> landmarks;
  unpacker.list(landmarks, [&](VoLandmark& each) { landmark(unpacker, each); });
  if (!unpacker.fine || !unpacker.reader.complete()) return std::nullopt;
  for (const VoRow& each : run.rows)
    if (!isHealth(each.status.health)) return std::nullopt;
  for (const Settled& each : run.settled)
    if (!isHealth(each.status.health) || !isHealth(each.from_previous.status.health)) return std::nullopt;
  for (const VoLandmark& each : landmarks) run.landmarks.emplace(each.landmark.id, each);
  return run;
}

}  // namespace urban_nav
