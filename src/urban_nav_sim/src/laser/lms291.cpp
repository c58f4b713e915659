// SPDX-License-Identifier: BSD-3-Clause
#include "laser/lms291.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace urban_nav_sim {

struct Lms291::Reading {
  double range = std::numeric_limits<double>::infinity();  ///< m
  double intensity = 0.0;                                  ///< 0 ... 255
};

namespace {

using Eigen::Vector3d;
using urban_nav_core::Pose;

constexpr double kBeamStep = 0.5 * M_PI / 180.0;      // rad from beam to beam
constexpr double kExit = 0.013, kDivergence = 0.011;  // m, rad: width of the beam (1.6 there)
constexpr double kWeakest = 0.1 / (30.0 * 30.0);      // 30 m on an albedo of 0.1 (1.3 there)
constexpr double kPulse = 1.5;                        // m: the device does not separate closer echoes
constexpr float kFarRange = 200.0F;                   // m
constexpr int kBeamsOfPacket = kLanes / kRaysOfBeam;

/// Returns the direction of a ray of the footprint of a beam, in the laser frame; outer rays are at half the radius.
Vector3d beamRay(int beam, int ray) {
  const double angle = -M_PI / 4.0 + kBeamStep * beam, off = kDivergence / 4.0;
  const double up = ray == 1 ? off : ray == 2 ? -off : 0.0, aside = ray == 3 ? off : ray == 4 ? -off : 0.0;
  return {std::cos(angle) - aside * std::sin(angle), std::sin(angle) + aside * std::cos(angle), up};
}

/// Returns the intensity as in the log: path at 1-1.5 m 37-54, walls at 3.5-5.5 m 53-80; the optics lose light at short
/// range, distance attenuates from 8 m on (Smith et al. 2009; data sheet of the LMS291).
double computeIntensity(double strength, double range) {
  const double optics = range / (range + 0.5), distance = range > 8.0 ? 8.0 / range : 1.0;
  return 190.0 * std::pow(std::max(strength, 0.0), 0.85) * optics * distance;
}

}  // namespace

Lms291::Lms291(const Tracer& tracer, const Pose& T_base_laser, std::uint64_t seed, std::string_view name,
               const Settings& settings)
    : tracer_(tracer),
      T_base_laser_(T_base_laser),
      settings_(settings),
      noise_(Noise(seed, "lasers").of(name)),
      bias_(noise_.of("bias").uniform(0, -settings.largest_bias, settings.largest_bias)) {}

Lms291::Settings Lms291::Settings::exact() {
  Settings settings;
  settings.sigma = settings.largest_bias = settings.step = 0.0;
  settings.mixes = settings.loses = false;
  return settings;
}

Lms291::Reading Lms291::measured(const BeamEchoes& footprint, const Noise& noise, int beam) const {
  const Echo echo = settings_.mixes ? mixEchoes(footprint, kPulse) : footprint[0];
  if (!std::isfinite(echo.range)) return {};
  const auto counter = static_cast<std::uint64_t>(beam);
  // Fading softens the limit.
  const double limit = kWeakest * std::exp(0.4 * noise.of("fading").normal(counter));
  if (settings_.loses && !(echo.strength / (echo.range * echo.range) > limit)) return {};
  const double sigma = settings_.sigma * (echo.range > 20.0 ? 2.0 : 1.0);
  double shown = echo.range + bias_ + settings_.systematic_error + sigma * noise.of("range").normal(counter);
  if (settings_.step > 0.0) shown = std::round(shown / settings_.step) * settings_.step;
  if (!(shown > 0.0 && shown < settings_.range_max)) return {};
  double intensity = computeIntensity(echo.strength, echo.range);
  if (settings_.sigma > 0.0) intensity *= 1.0 + 0.04 * noise.of("intensity").normal(counter);
  if (settings_.step > 0.0) intensity = std::round(intensity);
  return {shown, std::clamp(intensity, 1.0, 255.0)};
}

/// Returns the echoes of the rays of a beam.
BeamEchoes Lms291::echoes(const Snapshot& snapshot, const Packet& packet, const Hits& hits, int first_lane) {
  BeamEchoes footprint;
  for (int ray = 0; ray < kRaysOfBeam; ++ray) {
    const int lane = first_lane + ray;
    const float width =
        static_cast<float>(kDivergence) + static_cast<float>(kExit) / std::max(0.1F, hits.distance[lane]);
    footprint[static_cast<std::size_t>(ray)] = makeEcho(snapshot, packet, hits, lane, width);
  }
  return footprint;
}

urban_nav_core::PlanarScan Lms291::scan(const Motion& motion, double t, urban_nav_core::StampNs stamp,
                                        std::uint64_t number, std::vector<BeamTruth>* truth) const {
  urban_nav_core::PlanarScan scan;
  scan.stamp = stamp;
  scan.angle_first = -M_PI / 4.0;
  scan.angle_step = kBeamStep;
  scan.time_step = settings_.period / 720.0;
  scan.period = settings_.period;
  scan.range_min = 0.05;
  scan.range_max = settings_.range_max;
  if (truth != nullptr) truth->clear();
  const Snapshot snapshot(tracer_, t, t + scan.time_step * (kBeams - 1));
  const Noise noise = noise_.of(number);
  for (int first = 0; first < kBeams; first += kBeamsOfPacket) {
    const int beams = std::min(kBeamsOfPacket, kBeams - first);
    Packet packet{};
    for (int i = 0; i < beams; ++i) {
      const int beam = first + i;
      const Pose T_world_laser = motion.at(t + scan.time_step * beam).T_world_base * T_base_laser_;
      for (int ray = 0; ray < kRaysOfBeam; ++ray) {
        const int lane = i * kRaysOfBeam + ray;
        packet.setOrigin(lane, T_world_laser.t().cast<float>());
        packet.setDirection(lane, (T_world_laser.q() * beamRay(beam, ray)).cast<float>());
        packet.far[lane] = kFarRange;
        packet.time[lane] = static_cast<float>(beam) / (kBeams - 1);
        packet.active |= 1U << lane;
      }
    }
    Hits hits;
    snapshot.closest(packet, hits);
    for (int i = 0; i < beams; ++i) {
      const BeamEchoes footprint = echoes(snapshot, packet, hits, i * kRaysOfBeam);
      const Reading reading = measured(footprint, noise, first + i);
      scan.ranges.push_back(static_cast<float>(reading.range));
      scan.intensities.push_back(std::isfinite(reading.range) ? static_cast<float>(reading.intensity) : 0.0F);
      if (truth != nullptr) truth->push_back({footprint[0].range, footprint[0].surface_class});
    }
  }
  return scan;
}

}  // namespace urban_nav_sim
