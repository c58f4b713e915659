// SPDX-License-Identifier: BSD-3-Clause
#include "edits/edit_measurement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "loop_metric/candidate/closure_checks.hpp"
#include "topics/loops/candidate_measurement.hpp"
#include "topics/loops/stored_sessions.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/session/calibration_fingerprint.hpp"
#include "urban_nav_registration/session/stored_keyframe.hpp"

namespace urban_nav {

using urban_nav_core::MetricClosure;
using urban_nav_core::UserError;
using urban_nav_registration::MountedCamera;
using urban_nav_store::NodeRef;
using urban_nav_store::Store;

namespace {

constexpr double kNearestView = 1.0;    // s
constexpr double kNearestPoint = 10.0;  // px

std::size_t sessionPlace(const PreviousSessions& sessions, const urban_nav_store::SessionId& id) {
  return static_cast<std::size_t>(std::find(sessions.ids.begin(), sessions.ids.end(), id) - sessions.ids.begin());
}

/// Returns the camera of the last session with images (see MapContext::lastCamera()).
std::optional<MountedCamera> lastCamera(const PreviousSessions& sessions) {
  for (auto run = sessions.runs.rbegin(); run != sessions.runs.rend(); ++run)
    if (auto camera = urban_nav_registration::parseCalibrationFingerprint(run->cameras)) return camera;
  return std::nullopt;
}

}  // namespace

MetricClosure measurePair(Store& store, const StoredMeasurements& measurements, const ParameterSet& parameters,
                          const NodeRef& a, const NodeRef& b) {
  const PreviousSessions& sessions = measurements.sessions;
  std::vector<CandidateSession> named;
  for (std::size_t s = 0; s < sessions.ids.size(); ++s)
    named.push_back({sessions.names[s], sessions.ids[s], &sessions.runs[s]});
  CandidateMeasurer measurer;
  measurer.camera = lastCamera(sessions).value_or(MountedCamera());
  measurer.stores = {store.path()};
  measurer.sessions = storedSessions(named, store, measurer.camera);
  measurer.parameters = parameters.get(loop_metric::table());
  measurer.parameters.registration = parameters.get(urban_nav_registration::table());
  const urban_nav_core::TopologicalClosure pair{{sessions.names[sessionPlace(sessions, a.session)], a.stamp},
                                                {sessions.names[sessionPlace(sessions, b.session)], b.stamp},
                                                1.0};
  std::vector<MetricClosure> measured =
      measureCandidates(measurer, {toCandidate(pair, "edit")}, [](std::size_t) {}).closures;
  const SeveralStores stores(measurer.stores);
  const loop_metric::StoredPlaceData place_data(measurer.sessions, stores.keyframes(), stores.scans());
  loop_metric::applyChecks(measured, place_data, measurer.parameters);
  return std::move(measured.front());
}

std::optional<urban_nav_core::StampNs> findNearestView(Store& store, const NodeRef& at, double within) {
  const std::vector<urban_nav_core::StampNs> stamps =
      store.keyframes().stamps(at.session, urban_nav_registration::kKeyframeCamera);
  const auto distance = [&](urban_nav_core::StampNs stamp) {
    return std::abs(urban_nav_core::secondsBetween(at.stamp, stamp));
  };
  const auto nearest = std::min_element(stamps.begin(), stamps.end(),
                                        [&](auto one, auto other) { return distance(one) < distance(other); });
  if (nearest == stamps.end() || distance(*nearest) > within) return std::nullopt;
  return *nearest;
}

SeenPoint findSeenPoint(Store& store, const StoredMeasurements& measurements, const NodeRef& at, double u, double v) {
  const SessionOdometry& run = measurements.sessions.runs[sessionPlace(measurements.sessions, at.session)];
  const std::optional<MountedCamera> camera = urban_nav_registration::parseCalibrationFingerprint(run.cameras);
  const std::optional<urban_nav_core::StampNs> nearest = findNearestView(store, at, kNearestView);
  if (!camera || !nearest)
    throw UserError("--point", "the store holds no view of the left camera within 1 s of T",
                    "a T with a view, or a pin of base_link without --point");
  const auto row = store.keyframes().get(at.session, urban_nav_registration::kKeyframeCamera, *nearest);
  const urban_nav_registration::Keyframe keyframe = urban_nav_registration::toKeyframe(*row, at.session);
  double least = std::numeric_limits<double>::infinity();
  SeenPoint seen;
  seen.stamp = *nearest;
  for (const urban_nav_registration::KeyframePoint& point : keyframe.points) {
    const Eigen::Vector2d pixel = point.pixel();
    const double apart = (pixel - Eigen::Vector2d(u, v)).norm();
    const std::optional<Eigen::Vector3d> p_left =
        camera->camera.triangulate({pixel.x(), pixel.y(), pixel.x() - static_cast<double>(point.disparity)});
    if (apart >= least || !p_left) continue;
    least = apart;
    seen.p_base = camera->T_base_left * *p_left;
  }
  if (!(least <= kNearestPoint))
    throw UserError(
        "--point",
        "the view at " + urban_nav_core::printStamp(*nearest) + " has no point with depth within " +
            urban_nav_core::formatNumber(kNearestPoint, 2) + " px of " + urban_nav_core::printNumber(u) + "," +
            urban_nav_core::printNumber(v) +
            (std::isfinite(least) ? "; the nearest is " + urban_nav_core::formatNumber(least, 3) + " px away" : ""),
        "the pixel of a corner in that view");
  return seen;
}

}  // namespace urban_nav
