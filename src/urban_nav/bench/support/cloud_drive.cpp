// SPDX-License-Identifier: BSD-3-Clause
#include "cloud_drive.hpp"

#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/laser/beam_renderer.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_sim/session.hpp"

namespace urban_nav::bench {

using urban_nav_core::StampNs;

namespace {

constexpr const char* kReturnsSeal = "returns of a simulated drive";
constexpr std::uint32_t kReturnsVersion = 1;
constexpr StampNs kTruthStep = 20'000'000, kLongestTruthGap = 500'000'000;  // ns
constexpr StampNs kLaserSweep = 100'000'000;                                // ns

/// Beams with their true classes.
struct SeenBeams {
  urban_nav_core::Scan scan;
  std::vector<std::uint8_t> classes;
};

SeenBeams seenBeams(const urban_nav_core::PlanarScan& scan, const urban_nav_sim::ViewTruth& view) {
  SeenBeams seen;
  seen.scan = toScan(scan);
  for (int i = 0; i < view.surface_class.cols; ++i) {
    const float range = scan.ranges[static_cast<std::size_t>(i)];
    const auto metres = static_cast<double>(range);
    if (range > 0.0F && metres >= scan.range_min && metres <= scan.range_max)
      seen.classes.push_back(view.surface_class.at<std::uint8_t>(0, i));
  }
  return seen;
}

SeenBeams seenBeams(const urban_nav_core::Sweep& sweep, const urban_nav_sim::ViewTruth& view) {
  SeenBeams seen;
  seen.scan = {sweep.reference, sweep.beams};
  for (const urban_nav_core::Beam& beam : sweep.beams)
    seen.classes.push_back(view.surface_class.at<std::uint8_t>(beam.ring, beam.column));
  return seen;
}

urban_nav_sim::SessionOptions sessionOptions(const CloudDrive& drive) {
  urban_nav_sim::SessionOptions options;
  options.world = drive.world;
  options.route = drive.route;
  options.seed = drive.seed;
  options.day = drive.day;
  options.duration = drive.seconds;
  const bool has_lasers = drive.device == "lasers";
  options.sensors = options.views = {has_lasers ? urban_nav_sim::Sensor::Lasers : urban_nav_sim::Sensor::Lidar3d};
  if (!has_lasers) options.lidar = urban_nav_sim::parseLidarModel(drive.device, "device");
  return options;
}

/// Renders beams along the true path of a session.
class ReturnCollector {
 public:
  explicit ReturnCollector(const urban_nav_sim::Session& session) : session_(session) {
    const auto end = session.begin() + static_cast<StampNs>(1e9 * session.duration());
    for (StampNs t = session.begin(); t <= end; t += kTruthStep) truth_.append(t, session.truth(t));
  }

  void add(const std::string& frame, const SeenBeams& seen, StampNs sweep_length) {
    urban_nav_core::Scan covered;
    covered.stamp = seen.scan.stamp;
    std::vector<std::uint8_t> classes;
    for (std::size_t i = 0; i < seen.scan.beams.size() && i < seen.classes.size(); ++i) {
      if (seen.scan.beams[i].stamp < truth_.front().stamp || seen.scan.beams[i].stamp > truth_.back().stamp) continue;
      covered.beams.push_back(seen.scan.beams[i]);
      classes.push_back(seen.classes[i]);
    }
    urban_nav_core::BeamRenderer renderer(truth_, session_.places().at(frame), urban_nav_core::Pose(),
                                          kLongestTruthGap);
    std::vector<urban_nav_core::LaserPoint> points;
    if (covered.beams.empty() || renderer.render(covered, points) > 0) return;
    if (returns_.origins.empty() || covered.stamp - begin_ >= sweep_length) {
      returns_.origins.push_back(points.back().origin);
      begin_ = covered.stamp;
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      returns_.points.push_back(points[i].p);
      returns_.classes.push_back(classes[i]);
      returns_.sweeps.push_back(static_cast<std::uint32_t>(returns_.origins.size() - 1));
    }
  }
  DriveReturns take() { return std::move(returns_); }

 private:
  const urban_nav_sim::Session& session_;
  urban_nav_core::Trajectory truth_;
  DriveReturns returns_;
  StampNs begin_ = 0;
};

DriveReturns simulate(const CloudDrive& drive) {
  urban_nav_sim::Session session(sessionOptions(drive));
  ReturnCollector collector(session);
  std::map<StampNs, urban_nav_sim::LidarMeasurement> sweeps;
  std::map<std::pair<std::string, StampNs>, urban_nav_sim::LaserMeasurement> scans;
  while (auto arrival = session.next()) {
    if (auto* lidar = std::get_if<urban_nav_sim::LidarMeasurement>(&arrival->measurement))
      sweeps[lidar->stamp] = std::move(*lidar);
    if (auto* laser = std::get_if<urban_nav_sim::LaserMeasurement>(&arrival->measurement)) {
      const char* frame = laser->side == urban_nav_sim::Side::Left ? urban_nav_core::frames::kLaserLeft
                                                                   : urban_nav_core::frames::kLaserRight;
      const StampNs stamp = laser->scan.stamp;
      scans[{frame, stamp}] = std::move(*laser);
    }
    const auto* view = std::get_if<urban_nav_sim::ViewTruth>(&arrival->measurement);
    if (view == nullptr) continue;
    if (const auto sweep = sweeps.find(view->stamp); sweep != sweeps.end()) {
      collector.add(urban_nav_core::frames::kLidar3d, seenBeams(sweep->second.sweep, *view), 1);
      sweeps.erase(sweep);
    } else if (const auto scan = scans.find({view->frame, view->stamp}); scan != scans.end()) {
      collector.add(view->frame, seenBeams(scan->second.scan, *view), kLaserSweep);
      scans.erase(scan);
    }
  }
  return collector.take();
}

std::vector<float> toNumbers(const std::vector<Eigen::Vector3f>& points) {
  std::vector<float> numbers;
  numbers.reserve(3 * points.size());
  for (const Eigen::Vector3f& p : points) numbers.insert(numbers.end(), {p.x(), p.y(), p.z()});
  return numbers;
}

std::vector<Eigen::Vector3f> toPoints(const std::vector<float>& numbers) {
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  return points;
}

}  // namespace

DriveReturns simulateReturns(const CloudDrive& drive, const std::string& folder) {
  const std::string path = (std::filesystem::path(folder) / (drive.name() + ".returns")).string();
  DriveReturns returns;
  std::vector<float> points, origins;
  if (std::filesystem::exists(path)) {
    const std::string bytes = urban_nav_core::readBytes(path);
    urban_nav_core::Archive archive(urban_nav_core::unseal(kReturnsSeal, kReturnsVersion, bytes), kReturnsSeal);
    archive(points, returns.classes, returns.sweeps, origins);
    archive.finish();
    returns.points = toPoints(points);
    returns.origins = toPoints(origins);
    return returns;
  }
  returns = simulate(drive);
  points = toNumbers(returns.points);
  origins = toNumbers(returns.origins);
  urban_nav_core::Archive archive;
  archive(points, returns.classes, returns.sweeps, origins);
  urban_nav_core::writeAtomically(path, urban_nav_core::seal(kReturnsSeal, kReturnsVersion, archive.take()));
  return returns;
}

}  // namespace urban_nav::bench
