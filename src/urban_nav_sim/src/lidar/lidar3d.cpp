// SPDX-License-Identifier: BSD-3-Clause
#include "lidar/lidar3d.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "urban_nav_core/parallel/for_each.hpp"

namespace urban_nav_sim {

using Eigen::Vector3d;
using urban_nav_core::Beam;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Sweep;

/// One beam: measurement and true hit.
struct Lidar3d::Return {
  float range = std::numeric_limits<float>::infinity();  ///< m; infinite: no return
  float intensity = 0.0F;                                ///< 0 ... 255
  float true_range = std::numeric_limits<float>::infinity();
  SurfaceClass true_class = SurfaceClass::Other;
};

/// One firing of all lasers: poses of the sensor at its begin and at that of the next one.
struct Lidar3d::Column {
  std::uint64_t sweep;
  int index;
  Pose begin, end;
  double t_begin, t_end;  ///< s of the session, of the snapshot
  double t_sweep;         ///< s of the session, begin of the sweep
};

namespace {

constexpr double kBeamDivergence = 3e-3;              // rad, VLP-16
constexpr double kPulseLength = 0.8;                  // m: 5 ns; the device does not separate closer echoes
constexpr double kWeakestEcho = 0.1 / (50.0 * 50.0);  // 50 m on an albedo of 0.1 (HDL-64E)
constexpr double kLost = 3e-3;                        // share of the beams, for any surface
constexpr double kFullScale = 100.0;                  // intensity of an ideal diffuse reflector (VLP-16)
constexpr float kTracedRange = 250.0F;                // m
constexpr int kPieces = 10;                           // per sweep, each with a snapshot; movers are linear within 10 ms
constexpr std::size_t kColumnsOfTask = 10;

/// Returns the direction of a ray of the footprint of a beam; outer rays are at half the radius.
Vector3d footprintRay(const Vector3d& middle, int ray) {
  if (ray == 0) return middle;
  const Vector3d aside = middle.unitOrthogonal(), along = middle.cross(aside);
  const double off = (ray % 2 == 1 ? 1.0 : -1.0) * kBeamDivergence / 4.0;
  return middle + off * (ray <= 2 ? along : aside);
}

/// Interpolates between two poses 50 us apart.
Pose between(const Pose& a, const Pose& b, double f) {
  const Eigen::Quaterniond& p = a.q();
  Eigen::Quaterniond q = b.q();
  if (p.dot(q) < 0.0) q.coeffs() = -q.coeffs();
  Eigen::Quaterniond mean;
  mean.coeffs() = (1.0 - f) * p.coeffs() + f * q.coeffs();
  return Pose(mean.normalized(), Vector3d((1.0 - f) * a.t() + f * b.t()));
}

}  // namespace

Lidar3d::Settings Lidar3d::Settings::exact() {
  Settings settings;
  settings.sigma = settings.ring_range_sigma = settings.ring_angle_sigma = settings.step = 0.0;
  settings.mixes = settings.loses = false;
  return settings;
}

Lidar3d::Lidar3d(const Tracer& tracer, const Pose& T_base_lidar, std::uint64_t seed, const LidarModel& model,
                 const Settings& settings)
    : tracer_(tracer),
      T_base_lidar_(T_base_lidar),
      pattern_(model),
      settings_(settings),
      noise_(Noise(seed, "lidar3d")) {
  const Noise range = noise_.of("ring range"), angle = noise_.of("ring angle");
  for (int ring = 0; ring < pattern_.rings(); ++ring) {
    const auto counter = static_cast<std::uint64_t>(ring);
    ring_errors_.push_back(
        {settings.ring_range_sigma * range.normal(counter), settings.ring_angle_sigma * angle.normal(counter)});
  }
}

Lidar3d::Return Lidar3d::measured(const Echo& echo, const Echo& truth, int ring, const Noise& noise) const {
  Return result;
  result.true_range = static_cast<float>(truth.range);
  result.true_class = truth.surface_class;
  if (!std::isfinite(echo.range)) return result;
  const auto counter = static_cast<std::uint64_t>(ring);
  if (settings_.loses) {
    // Fading softens the limit.
    const double limit = kWeakestEcho * std::exp(0.4 * noise.of("fading").normal(counter));
    if (!(echo.strength / (echo.range * echo.range) > limit) || noise.of("lost").chance(counter, kLost)) return result;
  }
  double shown = echo.range + ring_errors_[static_cast<std::size_t>(ring)].range;
  double intensity = kFullScale * std::max(echo.strength, 0.0);
  if (settings_.sigma > 0.0) {
    shown += settings_.sigma * noise.of("range").normal(counter);
    intensity *= 1.0 + 0.05 * noise.of("intensity").normal(counter);
  }
  if (settings_.step > 0.0) {
    shown = std::round(shown / settings_.step) * settings_.step;
    intensity = std::round(intensity);
  }
  if (!(shown >= settings_.range_min && shown <= settings_.range_max)) return result;
  result.range = static_cast<float>(shown);
  result.intensity = static_cast<float>(std::clamp(intensity, 0.0, 255.0));
  return result;
}

/// Casts the beams of a column, sixteen rings at a time; rays around the centre of a beam only for mixed echoes.
/// `returns`: one per ring.
void Lidar3d::castColumn(const Snapshot& snapshot, const Column& column, Return* returns) const {
  const Noise noise = noise_.of(column.sweep).of(static_cast<std::uint64_t>(column.index));
  const int rays = settings_.mixes ? kRaysOfBeam : 1, rings = pattern_.rings();
  const double length = pattern_.time(column.index + 1, 0) - pattern_.time(column.index, 0);
  for (int first = 0; first < rings; first += kLanes) {
    const int lanes = std::min(kLanes, rings - first);
    std::array<Packet, kRaysOfBeam> packets{};
    std::array<Hits, kRaysOfBeam> hits;
    for (int lane = 0; lane < lanes; ++lane) {
      const int ring = first + lane;
      const double t = pattern_.time(column.index, ring);
      const Pose T_world_lidar = between(column.begin, column.end, (t - pattern_.time(column.index, 0)) / length);
      const Vector3d middle =
          pattern_.direction(column.sweep, column.index, ring, ring_errors_[static_cast<std::size_t>(ring)].elevation);
      for (int ray = 0; ray < rays; ++ray) {
        Packet& packet = packets[static_cast<std::size_t>(ray)];
        packet.setOrigin(lane, T_world_lidar.t().cast<float>());
        packet.setDirection(lane, (T_world_lidar.q() * footprintRay(middle, ray)).cast<float>());
        packet.far[lane] = kTracedRange;
        packet.time[lane] = static_cast<float>(
            std::clamp((column.t_sweep + t - column.t_begin) / (column.t_end - column.t_begin), 0.0, 1.0));
        packet.active |= 1U << lane;
      }
    }
    for (std::size_t ray = 0; ray < static_cast<std::size_t>(rays); ++ray) snapshot.closest(packets[ray], hits[ray]);
    for (int lane = 0; lane < lanes; ++lane) {
      const auto echo = [&](std::size_t ray) {
        return makeEcho(snapshot, packets[ray], hits[ray], lane, static_cast<float>(kBeamDivergence));
      };
      const Echo middle = echo(0);
      Echo seen = middle;
      if (settings_.mixes) {
        std::array<double, kRaysOfBeam> traced;
        for (std::size_t ray = 0; ray < traced.size(); ++ray)
          traced[ray] = hits[ray].facet[lane] == kNothing ? std::numeric_limits<double>::infinity()
                                                          : static_cast<double>(hits[ray].distance[lane]);
        if (hasEdge(traced)) seen = mixEchoes({middle, echo(1), echo(2), echo(3), echo(4)}, kPulseLength);
      }
      returns[first + lane] = measured(seen, middle, first + lane, noise);
    }
  }
}

std::vector<Lidar3d::Return> Lidar3d::castSweep(const Motion& motion, double t_sweep, std::uint64_t number) const {
  const auto rings = static_cast<std::size_t>(pattern_.rings());
  std::vector<Return> returns(static_cast<std::size_t>(pattern_.columns()) * rings);
  const auto poseAt = [&](int column) {
    return motion.at(t_sweep + pattern_.time(column, 0)).T_world_base * T_base_lidar_;
  };
  const int columns_of_piece = pattern_.columns() / kPieces;
  for (int piece = 0; piece < kPieces; ++piece) {
    const int first = piece * columns_of_piece;
    const double t_begin = t_sweep + pattern_.time(first, 0);
    const double t_end = t_sweep + pattern_.time(first + columns_of_piece, 0);
    const Snapshot snapshot(tracer_, t_begin, t_end);
    urban_nav_core::forEach(static_cast<std::size_t>(columns_of_piece), kColumnsOfTask, [&](std::size_t i) {
      const int index = first + static_cast<int>(i);
      const Column column{number, index, poseAt(index), poseAt(index + 1), t_begin, t_end, t_sweep};
      castColumn(snapshot, column, &returns[static_cast<std::size_t>(index) * rings]);
    });
  }
  return returns;
}

Sweep Lidar3d::sweep(const Motion& motion, double t_end, StampNs stamp, std::uint64_t number, SweepTruth* truth) const {
  const int columns = pattern_.columns(), rings = pattern_.rings();
  const std::vector<Return> returns = castSweep(motion, t_end - LidarPattern::kPeriod, number);
  Sweep sweep;
  sweep.duration = LidarPattern::kPeriod;
  sweep.times = settings_.has_times ? Sweep::Times::Measured : Sweep::Times::Unknown;
  sweep.reference = stamp - std::llround(0.5e9 * LidarPattern::kPeriod);
  if (truth != nullptr)
    *truth = {rings, columns, std::vector<float>(returns.size()), std::vector<SurfaceClass>(returns.size())};
  for (int column = 0; column < columns; ++column) {
    for (int ring = 0; ring < rings; ++ring) {
      const Return& each = returns[static_cast<std::size_t>(column * rings + ring)];
      if (truth != nullptr) {
        const auto place = static_cast<std::size_t>(ring * columns + column);
        truth->range[place] = each.true_range;
        truth->surface_class[place] = each.true_class;
      }
      if (!std::isfinite(each.range)) continue;
      const double before_end = LidarPattern::kPeriod - pattern_.time(column, ring);
      sweep.beams.push_back({settings_.has_times ? stamp - std::llround(1e9 * before_end) : stamp,
                             pattern_.direction(number, column, ring).cast<float>(), each.range, each.intensity,
                             static_cast<std::uint16_t>(ring), static_cast<std::uint16_t>(column)});
    }
  }
  return sweep;
}

}  // namespace urban_nav_sim
