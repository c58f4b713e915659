// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/localise_stage.hpp"

#include <algorithm>
#include <chrono>
#include <map>

#include "loop_metric/camera_words.hpp"
#include "loop_metric/stereo_closure.hpp"
#include "loop_metric/stored_surroundings.hpp"
#include "loop_metric/view_finder.hpp"
#include "pipeline/store_stage.hpp"
#include "pipeline/vo_summary.hpp"
#include "store/stored_map.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using loop_metric::Keyframe;
using loop_metric::Knowledge;
using loop_metric::Located;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_store::Store;

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kViewsApart = 1.5;       // m between views of the map that are kept in memory for the search
constexpr std::size_t kCandidates = 3;    // of a search, that are registered
constexpr double kNear = 6.0;             // m, and
constexpr double kTurned = 0.9;           // rad: what is further from where the robot believes to be is not tried
constexpr double kMetresPerRadian = 4.0;  // a turn costs as many matches as this way
constexpr double kUsefulBelief = 2.0;     // m: a belief that is vaguer says nothing about which views are near

/// A view of the map.
struct MapView {
  urban_nav_store::SessionId session;
  StampNs stamp = 0;
  Pose T_map_base;
};

std::string propertyOf(Store& store, const urban_nav_store::SessionId& id, const std::string& name) {
  for (const urban_nav_store::Property& property : store.sessions().properties(id))
    if (property.name == name) return property.value;
  return {};
}

/// Those of the first map's sessions that have the camera of `words`.
std::vector<MapView> viewsOf(Store& frozen, const std::string& words) {
  std::vector<MapView> views;
  bool other_camera = false;
  const auto maps = readMaps(frozen, frozen.sessions().all());
  if (maps.empty()) throw urban_nav_core::DataError(frozen.path(), "holds no session", "");
  for (const StoredTrajectory& each : maps.front()) {
    const std::vector<StampNs> stamps = frozen.keyframes().stamps(each.session.id, kVoCamera);
    if (stamps.empty()) continue;
    if (propertyOf(frozen, each.session.id, loop_metric::camera_property) != words) {
      other_camera = true;
      continue;
    }
    auto stamp = stamps.begin();
    for (const urban_nav_core::StampedPose& pose : each.T_map_base) {
      while (stamp != stamps.end() && *stamp < pose.stamp) ++stamp;
      if (stamp != stamps.end() && *stamp == pose.stamp) views.push_back({each.session.id, pose.stamp, pose.pose});
    }
  }
  if (!views.empty()) return views;
  if (other_camera)
    throw urban_nav_core::DataError(frozen.path(), "its views are of another camera than those of this input", "");
  throw urban_nav_core::DataError(frozen.path(),
                                  "holds no views to recognise: map keeps them where --stages does not leave loops out", "");
}

class Search {
 public:
  Search(const loop_metric::Parameters& parameters, Store& frozen, const VoRun& run, Console& console)
      : frozen_(frozen),
        views_(viewsOf(frozen, loop_metric::cameraWords(run.camera, run.T_base_camera))),
        finder_(run.camera),
        matcher_(run.camera, parameters),
        T_base_camera_(run.T_base_camera) {
    Progress progress(console, "views of the map", "views", static_cast<std::int64_t>(views_.size()));
    std::map<urban_nav_store::SessionId, Pose> last;
    for (std::size_t i = 0; i < views_.size(); ++i) {
      progress.update(static_cast<std::int64_t>(i));
      const auto before = last.find(views_[i].session);
      if (before != last.end() && distanceBetween(before->second, views_[i].T_map_base) < kViewsApart &&
          angleBetween(before->second, views_[i].T_map_base) < kTurned / 4.0)
        continue;
      last[views_[i].session] = views_[i].T_map_base;
      finder_.add(keyframe(views_[i]));
      in_finder_.push_back(i);
    }
    progress.finish(static_cast<std::int64_t>(views_.size()));
  }

  /// Sightings of the view go to the localiser; how many there were.
  std::size_t look(const Keyframe& view, loop_metric::Localiser& localiser) {
    const Located believed = localiser.at(view.at.stamp);
    std::vector<std::size_t> candidates = near(believed);
    if (candidates.empty())
      for (const loop_metric::ViewFinder::Found& found : finder_.find(view, kCandidates))
        candidates.push_back(in_finder_[found.view]);
    std::size_t seen = 0;
    for (const std::size_t candidate : candidates) {
      const loop_metric::StereoClosure closure = matcher_.match(keyframe(views_[candidate]), view);
      if (closure.verdict != urban_nav_core::ClosureVerdict::Accepted) continue;
      localiser.addSighting(view.at.stamp, views_[candidate].T_map_base,
                            loop_metric::betweenBases(closure.lefts, T_base_camera_));
      ++seen;
      break;  // a second one of the same place is no second witness
    }
    if (seen == 0) localiser.addNothing(view.at.stamp);
    return seen;
  }

 private:
  Keyframe keyframe(const MapView& view) const {
    const auto stored = frozen_.keyframes().get(view.session, kVoCamera, view.stamp);
    Keyframe made;
    made.at = {view.session, view.stamp};
    return stored ? loop_metric::keyframeOf(*stored, view.session) : made;
  }

  /// The views nearest to where the robot believes to be; empty where it knows too little.
  std::vector<std::size_t> near(const Located& believed) const {
    std::vector<std::size_t> made;
    if (!believed.T_map_base || believed.knowledge != Knowledge::Known) {
      if (!believed.T_map_base || believed.witnesses > 0 ||
          believed.T_map_base->covariance.topLeftCorner<3, 3>().trace() > kUsefulBelief * kUsefulBelief)
        return made;
    }
    const Pose& here = believed.T_map_base->pose;
    std::vector<std::pair<double, std::size_t>> costs;
    for (std::size_t i = 0; i < views_.size(); ++i) {
      const double way = distanceBetween(views_[i].T_map_base, here), turn = angleBetween(views_[i].T_map_base, here);
      if (way <= kNear && turn <= kTurned) costs.emplace_back(way + kMetresPerRadian * turn, i);
    }
    std::sort(costs.begin(), costs.end());
    for (std::size_t i = 0; i < std::min(costs.size(), kCandidates); ++i) made.push_back(costs[i].second);
    return made;
  }

  Store& frozen_;
  std::vector<MapView> views_;
  loop_metric::ViewFinder finder_;
  std::vector<std::size_t> in_finder_;  // numbers in views_
  loop_metric::StereoMatcher matcher_;
  Pose T_base_camera_;
};

}  // namespace

LocaliseRun localise(const loop_metric::Parameters& parameters, Store& frozen, Store& own,
                     const urban_nav_store::SessionId& id, const VoRun& run, Console& console) {
  LocaliseRun made;
  Search search(parameters, frozen, run, console);
  loop_metric::Localiser localiser(parameters);
  const std::vector<StampNs> views = own.keyframes().stamps(id, kVoCamera);
  Progress progress(console, "localise", "frames", static_cast<std::int64_t>(run.settled.size()));
  std::vector<double> ms;
  std::size_t known = 0;
  for (std::size_t i = 0; i < run.settled.size(); ++i) {
    const swf_vo::Settled& frame = run.settled[i];
    if (i > 0) localiser.addOdometry(frame.from_previous);
    if (i > 0 && std::binary_search(views.begin(), views.end(), frame.stamp)) {
      const Clock::time_point begin = Clock::now();
      ++made.looks;
      if (const auto stored = own.keyframes().get(id, kVoCamera, frame.stamp))
        made.sightings += search.look(loop_metric::keyframeOf(*stored, ""), localiser);
      ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
    }
    Located located = localiser.at(frame.stamp);
    located.stamp = frame.stamp;
    if (located.knowledge == Knowledge::Known) {
      ++known;
      if (made.first_known_s < 0.0)
        made.first_known_s = urban_nav_core::secondsBetween(run.settled.front().stamp, frame.stamp);
    }
    made.frames.push_back(std::move(located));
    progress.update(static_cast<std::int64_t>(i + 1));
  }
  progress.finish(static_cast<std::int64_t>(run.settled.size()));
  made.known_share = made.frames.empty() ? 0.0 : static_cast<double>(known) / static_cast<double>(made.frames.size());
  made.ms_median = quantile(ms, 0.5);
  // Frames before the first that is known lie where odometry puts them, seen from there; so do those that are not known later.
  std::optional<Pose> T_map_odom;
  for (std::size_t i = 0; i < made.frames.size() && !T_map_odom; ++i)
    if (made.frames[i].knowledge == Knowledge::Known)
      T_map_odom = made.frames[i].T_map_base->pose * run.settled[i].T_odom_base.pose.inverse();
  if (!T_map_odom) {
    made.warnings.push_back("the session was never found in the map: trajectory.tum is that of odometry");
    return made;
  }
  for (std::size_t i = 0; i < made.frames.size(); ++i) {
    if (made.frames[i].knowledge == Knowledge::Known)
      T_map_odom = made.frames[i].T_map_base->pose * run.settled[i].T_odom_base.pose.inverse();
    made.T_map_base.append(run.settled[i].stamp, *T_map_odom * run.settled[i].T_odom_base.pose);
  }
  return made;
}

std::string localisationCsv(const LocaliseRun& run) {
  using urban_nav_core::printNumber;
  std::vector<std::string> header = {"stamp_ns", "knowledge", "witnesses", "x", "y", "z", "qx", "qy", "qz", "qw"};
  for (int i = 0; i < 36; ++i) header.push_back("c" + std::to_string(i / 6) + std::to_string(i % 6));
  header.emplace_back("sentence");
  std::string text = urban_nav_core::printCsvRow(header);
  for (const Located& frame : run.frames) {
    std::vector<std::string> cells = {std::to_string(frame.stamp), toString(frame.knowledge),
                                      std::to_string(frame.witnesses)};
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

Json toJson(const LocaliseRun& run) {
  Json json = Json::object();
  json["frames"] = run.frames.size();
  json["known_share"] = run.known_share;
  json["first_known_s"] = run.first_known_s;
  json["looks"] = run.looks;
  json["sightings"] = run.sightings;
  json["ms_median"] = run.ms_median;
  Json& warnings = json["warnings"] = Json::array();
  for (const std::string& warning : run.warnings) warnings.append(warning);
  return json;
}

}  // namespace urban_nav
