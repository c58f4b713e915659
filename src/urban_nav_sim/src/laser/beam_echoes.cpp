// SPDX-License-Identifier: BSD-3-Clause
#include "laser/beam_echoes.hpp"

#include <algorithm>
#include <cmath>

namespace urban_nav_sim {

namespace {

constexpr double kLargestSlant = 0.02;  // m

/// Second differences of the range across the beam, m; infinite or NaN for a ray without hit.
double computeSlant(double middle, double above, double below, double left, double right) {
  return std::abs(above - 2.0 * middle + below) + std::abs(left - 2.0 * middle + right);
}

}  // namespace

Echo makeEcho(const Snapshot& snapshot, const Packet& packet, const Hits& hits, int lane, float width) {
  Echo echo;
  if (hits.facet[lane] == kNothing) return echo;
  const Eigen::Vector3f direction = packet.beamDirection(lane);
  const Eigen::Vector3f aside = direction.unitOrthogonal(), along = direction.cross(aside);
  const SurfacePoint point = snapshot.surfaceAt(hits, lane, packet, width * aside, width * along);
  const Appearance look = lookAt(*point.material, point.spot);
  const float cosine = std::abs(point.normal.dot(direction.normalized()));
  echo.range = point.distance;
  echo.strength = static_cast<double>(look.infrared * (1.0F - look.gloss) * cosine);
  // Glass at normal incidence is a mirror.
  if (cosine > 0.998F) echo.strength += static_cast<double>(look.gloss);
  echo.surface_class = point.surface_class;
  return echo;
}

bool hasEdge(const std::array<double, kRaysOfBeam>& ranges) {
  const double near = *std::min_element(ranges.begin(), ranges.end());
  return std::isfinite(near) && !(computeSlant(ranges[0], ranges[1], ranges[2], ranges[3], ranges[4]) < kLargestSlant);
}

Echo mixEchoes(const BeamEchoes& footprint, double pulse) {
  const Echo& middle = footprint[0];
  double near = std::numeric_limits<double>::infinity();
  for (const Echo& echo : footprint) near = std::min(near, echo.range);
  // A slanted surface spreads its echoes symmetrically about the central one; an edge does not.
  const double slant =
      computeSlant(middle.range, footprint[1].range, footprint[2].range, footprint[3].range, footprint[4].range);
  if (!std::isfinite(near) || slant < kLargestSlant) return middle;
  // The first sufficiently strong echo, shifted backwards by later ones within the pulse.
  double weights = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < footprint.size(); ++i) {
    const Echo& echo = footprint[i];
    if (!(echo.range < near + pulse)) continue;
    const double weight = (i == 0 ? 2.0 : 1.0) / 6.0 * echo.strength / (echo.range * echo.range);
    weights += weight;
    sum += weight * echo.range;
  }
  if (!(weights > 0.0)) return {};
  const double range = sum / weights;
  return {range, weights * range * range, middle.surface_class};
}

}  // namespace urban_nav_sim
