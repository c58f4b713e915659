// SPDX-License-Identifier: BSD-3-Clause
#include "topics/localization/localization_run.hpp"

#include <algorithm>
#include <chrono>
#include <memory>

#include "fabmap_node/retrieval/keyframe_places.hpp"
#include "map/session_odometry.hpp"
#include "map/store_keys.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/trajectory/statistics.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_localization/cloud_search.hpp"
#include "urban_nav_localization/map_search.hpp"
#include "urban_nav_registration/session/session_lasers.hpp"
#include "urban_nav_registration/session/stored_beams.hpp"
#include "urban_nav_registration/session/stored_keyframe.hpp"

namespace urban_nav {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_localization::BeamSources;
using urban_nav_localization::LocalizationEstimate;
using urban_nav_localization::LocalizationState;
using urban_nav_store::Store;

namespace {

using Clock = std::chrono::steady_clock;

/// Registers local clouds of a run to the map; does nothing without scans or sweeps.
class CloudComparisons {
 public:
  CloudComparisons(const urban_nav_localization::Parameters& parameters, const urban_nav_localization::FrozenMap& map,
                   Store& frozen, Store& own, const urban_nav_store::SessionId& id, const SessionOdometry& run,
                   Console& console)
      : console_(console), beams_(own) {
    if (!parameters.icp) return;
    const std::vector<urban_nav_registration::LaserAt> lasers = urban_nav_registration::storedBeamSources(own, id);
    if (lasers.empty()) return;
    if (std::any_of(lasers.begin(), lasers.end(), [](const auto& laser) { return laser.is_lidar; }))
      sources_ = BeamSources::Lidars;
    scans_ = urban_nav_registration::storedScans(beams_, id, lasers);
    odometry_ = odometryChain(run);
    auto search = std::make_unique<urban_nav_localization::CloudSearch>(parameters, map, frozen);
    if (search->places() > 0) search_ = std::move(search);
  }

  bool arePossible() const { return search_ != nullptr; }

  /// `alone`: no keyframes are compared, whose misses count otherwise.
  void compareWith(urban_nav_localization::Localiser& localiser, bool alone, LocalizationRun& result) {
    const auto stretch = search_ ? search_->due(localiser, sources_) : std::nullopt;
    if (!stretch) return;
    if (search_->read() == 0) readMap();
    ++result.cloud_looks;
    const bool is_match =
        search_->query(*stretch, urban_nav_registration::localCloud(odometry_, stretch->at, stretch->way, scans_),
                       urban_nav_registration::deformationSigma(odometry_, stretch->at, stretch->way), localiser);
    if (is_match) ++result.cloud_sightings;
    else if (alone) search_->addMiss(*stretch, localiser);
  }

 private:
  /// Reads the map on demand, since keyframes may suffice.
  void readMap() {
    Progress progress(console_, "clouds of the map", "places", static_cast<std::int64_t>(search_->places()));
    while (search_->readNext()) progress.update(static_cast<std::int64_t>(search_->read()));
    progress.finish(static_cast<std::int64_t>(search_->places()));
  }

  Console& console_;
  const urban_nav_registration::BeamReader beams_;
  BeamSources sources_ = BeamSources::PlanarLasers;
  urban_nav_core::OdometryChain odometry_;
  std::vector<urban_nav_registration::LaserScans> scans_;
  std::unique_ptr<urban_nav_localization::CloudSearch> search_;
};

/// Registers keyframes of a run to the map; does nothing without keyframes in both.
class KeyframeComparisons {
 public:
  KeyframeComparisons(const urban_nav_localization::Parameters& parameters,
                      const urban_nav_localization::FrozenMap& map, Store& frozen, Store& own,
                      const urban_nav_store::SessionId& id, const SessionOdometry& run, Console& console)
      : own_(own), id_(id), stamps_(own.keyframes().stamps(id, urban_nav_core::frames::kStereoLeft)) {
    if (stamps_.empty() || !map.hasKeyframes()) return;
    search_ = std::make_unique<urban_nav_localization::MapSearch>(
        parameters, map, frozen, urban_nav_registration::MountedCamera{run.camera, run.T_base_camera},
        std::make_shared<fabmap_node::KeyframePlaces>());
    Progress reading(console, "views of the map", "views", static_cast<std::int64_t>(search_->views()));
    while (search_->readNext()) reading.update(static_cast<std::int64_t>(search_->read()));
    reading.finish(static_cast<std::int64_t>(search_->views()));
  }

  bool arePossible() const { return search_ != nullptr; }
  bool hasKeyframes() const { return !stamps_.empty(); }

  void compareWith(urban_nav_localization::Localiser& localiser, StampNs stamp, LocalizationRun& result) {
    if (!search_ || !std::binary_search(stamps_.begin(), stamps_.end(), stamp)) return;
    const Clock::time_point begin = Clock::now();
    ++result.looks;
    if (const auto stored = own_.keyframes().get(id_, urban_nav_core::frames::kStereoLeft, stamp))
      result.sightings += search_->query(urban_nav_registration::toKeyframe(*stored, ""), localiser) ? 1 : 0;
    ms_.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
  }
  double medianMs() const { return urban_nav_core::quantile(ms_, 0.5); }

 private:
  Store& own_;
  const urban_nav_store::SessionId id_;
  const std::vector<StampNs> stamps_;
  std::unique_ptr<urban_nav_localization::MapSearch> search_;
  std::vector<double> ms_;
};

/// Fills T_map_base. Frames before the first known one, and later unknown ones, are placed by odometry relative to the
/// nearest known one.
void placeAllFrames(const SessionOdometry& run, LocalizationRun& result) {
  std::optional<Pose> T_map_odom;
  for (std::size_t i = 0; i < result.frames.size() && !T_map_odom; ++i)
    if (result.frames[i].state == LocalizationState::Localized)
      T_map_odom = result.frames[i].T_map_base->pose * run.settled[i].T_odom_base.pose.inverse();
  if (!T_map_odom) {
    result.warnings.push_back("the session was not localised in the map: trajectory.tum follows odometry");
    return;
  }
  for (std::size_t i = 0; i < result.frames.size(); ++i) {
    if (result.frames[i].state == LocalizationState::Localized)
      T_map_odom = result.frames[i].T_map_base->pose * run.settled[i].T_odom_base.pose.inverse();
    result.T_map_base.append(run.settled[i].stamp, *T_map_odom * run.settled[i].T_odom_base.pose);
  }
}

/// Warns where one of two kinds of comparison is impossible; throws UserError if both are.
void explainMissing(const KeyframeComparisons& keyframes, const CloudComparisons& clouds, const Store& frozen,
                    LocalizationRun& result) {
  if (keyframes.arePossible()) return;
  const std::string reason =
      keyframes.hasKeyframes() ? "the map " + frozen.path() + " has no keyframes" : "the session has no stereo images";
  if (!clouds.arePossible())
    throw urban_nav_core::UserError(
        "--localise", reason + ", and the two have no scans or sweeps of lasers in common",
        "a map and a session with stereo images in both, or with lasers in both (stage lasers)");
  result.warnings.push_back("localised by the clouds of lasers alone: " + reason);
}

}  // namespace

LocalizationRun runLocalization(const urban_nav_localization::Parameters& parameters, Store& frozen, Store& own,
                                const urban_nav_store::SessionId& id, const SessionOdometry& run, Console& console) {
  LocalizationRun result;
  const urban_nav_localization::FrozenMap map(frozen);
  KeyframeComparisons keyframes(parameters, map, frozen, own, id, run, console);
  CloudComparisons clouds(parameters, map, frozen, own, id, run, console);
  explainMissing(keyframes, clouds, frozen, result);
  urban_nav_localization::Localiser localiser(parameters);
  Progress progress(console, "localise", "frames", static_cast<std::int64_t>(run.settled.size()));
  std::size_t known = 0;
  for (std::size_t i = 0; i < run.settled.size(); ++i) {
    const SmoothedFrame& frame = run.settled[i];
    if (i > 0) {
      localiser.addOdometry(frame.from_previous);
      keyframes.compareWith(localiser, frame.stamp, result);
    }
    clouds.compareWith(localiser, !keyframes.arePossible(), result);
    LocalizationEstimate located = localiser.at(frame.stamp);
    located.stamp = frame.stamp;
    if (located.state == LocalizationState::Localized) {
      ++known;
      if (result.first_known_s < 0.0)
        result.first_known_s = urban_nav_core::secondsBetween(run.settled.front().stamp, frame.stamp);
    }
    result.frames.push_back(std::move(located));
    progress.update(static_cast<std::int64_t>(i + 1));
  }
  progress.finish(static_cast<std::int64_t>(run.settled.size()));
  result.known_share =
      result.frames.empty() ? 0.0 : static_cast<double>(known) / static_cast<double>(result.frames.size());
  result.ms_median = keyframes.medianMs();
  placeAllFrames(run, result);
  return result;
}

namespace {

/// Returns the text of a state in localisation.csv.
const char* csvWord(LocalizationState state) {
  switch (state) {
    case LocalizationState::Uncertain: return "UNSURE";
    case LocalizationState::Localized: return "KNOWN";
    case LocalizationState::Unmapped: break;
  }
  return "NEW";
}

}  // namespace

std::string localizationCsv(const LocalizationRun& run) {
  using urban_nav_core::printNumber;
  std::vector<std::string> header = {"stamp_ns", "knowledge", "witnesses", "x", "y", "z", "qx", "qy", "qz", "qw"};
  for (int i = 0; i < 36; ++i) header.push_back("c" + std::to_string(i / 6) + std::to_string(i % 6));
  header.emplace_back("sentence");
  std::string text = urban_nav_core::printCsvRow(header);
  for (const LocalizationEstimate& frame : run.frames) {
    std::vector<std::string> cells = {std::to_string(frame.stamp), csvWord(frame.state),
                                      std::to_string(frame.supporting_matches)};
    if (frame.T_map_base) {
      const Pose& T = frame.T_map_base->pose;
      for (const double value : {T.t().x(), T.t().y(), T.t().z(), T.q().x(), T.q().y(), T.q().z(), T.q().w()})
        cells.push_back(printNumber(value));
      for (int i = 0; i < 36; ++i) cells.push_back(printNumber(frame.T_map_base->covariance(i / 6, i % 6)));
    }
    cells.resize(header.size() - 1);
    cells.push_back(frame.sentence);
    text += urban_nav_core::printCsvRow(cells);
  }
  return text;
}

Json toJson(const LocalizationRun& run) {
  Json json = Json::object();
  json["frames"] = run.frames.size();
  json["known_share"] = run.known_share;
  json["first_known_s"] = run.first_known_s;
  json["looks"] = run.looks;
  json["sightings"] = run.sightings;
  json["ms_median"] = run.ms_median;
  json["cloud_looks"] = run.cloud_looks;
  json["cloud_sightings"] = run.cloud_sightings;
  Json& warnings = json["warnings"] = Json::array();
  for (const std::string& warning : run.warnings) warnings.append(warning);
  return json;
}

}  // namespace urban_nav
