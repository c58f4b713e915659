// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/laser/beam_renderer.hpp"

#include <algorithm>
#include <cmath>

namespace urban_nav_core {

BeamRenderer::BeamRenderer(const Trajectory& T_world_base, const Pose& T_base_laser, const Pose& T_frame_world,
                           StampNs max_gap)
    : T_world_base_(T_world_base), T_base_laser_(T_base_laser), T_frame_world_(T_frame_world), max_gap_(max_gap) {}

bool BeamRenderer::find(StampNs stamp) {
  if (stretch_.begin <= stamp && stamp <= stretch_.end) return true;
  const Trajectory& poses = T_world_base_;
  if (poses.size() < 2 || stamp < poses.front().stamp || stamp > poses.back().stamp) return false;
  // Usually the next interval; otherwise it is searched for.
  const bool follows =
      next_ > 0 && next_ + 1 < poses.size() && poses[next_].stamp <= stamp && stamp <= poses[next_ + 1].stamp;
  if (follows) {
    ++next_;
  } else {
    const auto after = std::lower_bound(poses.begin() + 1, poses.end() - 1, stamp,
                                        [](const StampedPose& pose, StampNs wanted) { return pose.stamp < wanted; });
    next_ = static_cast<std::size_t>(after - poses.begin());
  }
  if (secondsBetween(poses[next_ - 1].stamp, poses[next_].stamp) <= static_cast<double>(max_gap_) * 1e-9) {
    begin(poses[next_ - 1], poses[next_]);
    return true;
  }
  for (const std::size_t i : {next_ - 1, next_})  // at a gap
    if (poses[i].stamp == stamp) {
      begin(poses[i], poses[i]);
      return true;
    }
  return false;
}

void BeamRenderer::begin(const StampedPose& a, const StampedPose& b) {
  const Pose T_frame_a = T_frame_world_ * a.pose, T_frame_b = T_frame_world_ * b.pose;
  const Vector3d turn = logSo3(T_frame_b.q() * T_frame_a.q().conjugate());
  stretch_.begin = a.stamp;
  stretch_.end = b.stamp;
  stretch_.per_ns = b.stamp > a.stamp ? 1e-9 / secondsBetween(a.stamp, b.stamp) : 0.0;
  stretch_.R_frame_laser = (T_frame_a.q() * T_base_laser_.q()).toRotationMatrix();
  stretch_.lever = T_frame_a.q() * T_base_laser_.t();
  stretch_.t = T_frame_a.t();
  stretch_.along = T_frame_b.t() - T_frame_a.t();
  stretch_.angle = turn.norm();
  stretch_.axis = stretch_.angle > 0.0 ? Vector3d(turn / stretch_.angle) : Vector3d::UnitZ();
}

Vector3d BeamRenderer::turned(const Vector3d& v, double cosine, double sine) const {
  const Vector3d& k = stretch_.axis;  // Rodrigues' formula
  return cosine * v + sine * k.cross(v) + ((1.0 - cosine) * k.dot(v)) * k;
}

std::size_t BeamRenderer::render(const Scan& scan, std::vector<LaserPoint>& points) {
  std::size_t left_out = 0;
  points.reserve(points.size() + scan.beams.size());
  for (const Beam& beam : scan.beams) {
    if (!find(beam.stamp)) {
      ++left_out;
      continue;
    }
    const double share = static_cast<double>(beam.stamp - stretch_.begin) * stretch_.per_ns;
    const double cosine = std::cos(share * stretch_.angle), sine = std::sin(share * stretch_.angle);
    const Vector3d base = stretch_.t + share * stretch_.along;
    const Vector3d origin = base + turned(stretch_.lever, cosine, sine);
    const Vector3d ray = stretch_.R_frame_laser * (beam.range * beam.direction).cast<double>();
    const Vector3d p = origin + turned(ray, cosine, sine);
    points.push_back({beam.stamp, p.cast<float>(), origin.cast<float>(), beam.range, beam.intensity});
  }
  return left_out;
}

}  // namespace urban_nav_core
