// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/scan_places.hpp"

#include <cmath>

#include "urban_nav_core/parallel/for_each.hpp"

namespace laser_mapper {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;

namespace {

constexpr StampNs kMotionSpan = 25'000'000;  // before and after, for the velocity: half a period of the cameras
constexpr std::size_t kGrain = 256;

}  // namespace

std::vector<ScanPlace> placeScans(const SampledScans& samples, const std::vector<MountedLaser>& lasers,
                                  const std::vector<TermVector>& terms, const Trajectory& T_map_base,
                                  const std::vector<PoseCorrection>& corrections, StampNs max_gap) {
  std::vector<ScanPlace> places(samples.scans.size());
  urban_nav_core::forEach(places.size(), kGrain, [&](std::size_t i) {
    const SampledScans::Scan& scan = samples.scans[i];
    const StampNs stamp = scan.middle - std::llround(1e9 * delaySeconds(terms[scan.laser]));
    const auto before = T_map_base.at(stamp - kMotionSpan, max_gap), at = T_map_base.at(stamp, max_gap),
               after = T_map_base.at(stamp + kMotionSpan, max_gap);
    if (!before || !at || !after) return;
    ScanPlace& place = places[i];
    place.is_known = true;
    place.share = urban_nav_core::secondsBetween(samples.begin, scan.middle) - static_cast<double>(scan.window);
    const PoseCorrection correction =
        (1.0 - place.share) * corrections[scan.window] + place.share * corrections[scan.window + 1];
    const Pose T_map_base_now = urban_nav_core::boxPlus(*at, correction);
    const Pose T_stated_laser = statedToTrue(terms[scan.laser]);
    const Pose T_base_laser = lasers[scan.laser].T_base_laser * T_stated_laser;
    const double seconds = 2e-9 * static_cast<double>(kMotionSpan);
    place.base = T_map_base_now.t();
    place.R_map_stated = (T_map_base_now.q() * lasers[scan.laser].T_base_laser.q()).toRotationMatrix();
    place.R_map_laser = place.R_map_stated * T_stated_laser.R();
    place.lever = T_map_base_now.q() * T_base_laser.t();
    place.velocity = (after->t() - before->t()) / seconds;
    place.turn_rate = urban_nav_core::logSo3(after->q() * before->q().conjugate()) / seconds;
  });
  return places;
}

}  // namespace laser_mapper
