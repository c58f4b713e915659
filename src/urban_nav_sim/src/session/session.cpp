// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/session.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "camera/rig.hpp"
#include "faults/fault_filter.hpp"
#include "ground_truth/cloud.hpp"
#include "ground_truth/truth_files.hpp"
#include "motion/simulate_drive.hpp"
#include "rig/sensor_poses.hpp"
#include "session/optical_sensors.hpp"
#include "session/settings.hpp"
#include "session/timeline.hpp"
#include "urban_nav_core/io/text.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "world/world.hpp"

namespace urban_nav_sim {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::UserError;

namespace {

constexpr StampNs kFirstDay = 1'225'719'873'000'000'000;  // of the New College set: 3 November 2008
constexpr double kDefaultScale = 1.01;                    // of the baseline that camera_info states
constexpr StampNs kOneDay = 86'400'000'000'000;

bool isRendered(Sensor sensor) {
  return sensor == Sensor::Stereo || sensor == Sensor::Ladybug || sensor == Sensor::Lasers || sensor == Sensor::Lidar3d;
}

const SessionOptions& checked(const SessionOptions& options) {
  const std::vector<std::string> worlds = worldNames();
  if (std::find(worlds.begin(), worlds.end(), options.world) == worlds.end())
    throw UserError(options.where + "world", options.world, urban_nav_core::joined(worlds));
  for (const Sensor sensor : options.views)
    if (!isRendered(sensor) || options.sensors.count(sensor) == 0)
      throw UserError(options.where + "views", std::string("views of \"") + toString(sensor) + "\"",
                      "stereo, ladybug, lasers, lidar3d, if among the sensors");
  return options;
}

Route makeRoute(const SessionOptions& options) {
  std::vector<std::string> names;
  for (Route& route : worldRoutes(options.world, options.seed)) {
    if (route.name == options.route) return std::move(route);
    names.push_back(route.name);
  }
  throw UserError(options.where + "route", options.route, urban_nav_core::joined(names) + " in " + options.world);
}

DriveOptions rideOptions(const SessionOptions& options) {
  DriveOptions made;
  made.duration = options.duration;
  made.seed = Noise(options.seed, "ride").bits(static_cast<std::uint64_t>(options.day));
  return made;
}

}  // namespace

class Session::Implementation {
 public:
  explicit Implementation(const SessionOptions& options)
      : options_(checked(options)),
        route_(makeRoute(options_)),
        world_(buildWorld(options_.world, options_.seed, options_.day, options_.light)),
        motion_(simulateDrive(world_, route_, rideOptions(options_))),
        begin_(kFirstDay + (options_.day - 1) * kOneDay),
        noise_(Noise(options_.seed, "session").of(static_cast<std::uint64_t>(options_.day))),
        timeline_(options_.duration),
        faults_(options_.faults, options_.seed, begin_, bumblebee(stereoImages(options_.defects))[1].lens) {
    addTruth();
    if (has(Sensor::Imu)) addImu();
    if (has(Sensor::Wheels)) addWheels();
    if (has(Sensor::Gps)) addGps();
    if (std::any_of(options_.sensors.begin(), options_.sensors.end(), isRendered)) addEyes();
  }

  std::optional<Arrival> next() {
    while (std::optional<Timeline::Due> due = timeline_.next()) {
      const StampNs taken = begin_ + std::llround(1e9 * due->taken);
      if (std::optional<Measurement> arrived = faults_.apply(std::move(due->measurement), taken))
        return Arrival{std::move(*arrived), taken};
    }
    return std::nullopt;
  }

  Pose truth(StampNs taken) const { return motion_->at(1e-9 * static_cast<double>(taken - begin_)).T_world_base; }
  StampNs begin() const { return begin_; }
  const SessionOptions& options() const { return options_; }

  void writeTruth(const std::string& folder, double false_closures) const {
    writeTruthFiles(folder, *motion_, truthClock(), sensorClock(Sensor::Ladybug), false_closures, options_.seed);
    std::map<Sensor, ClockOptions> clocks;
    for (const Sensor sensor : kAllSensors)
      if (sensor != Sensor::Lidar3d || has(sensor)) clocks[sensor] = clockErrors(sensor);
    writeClocks(folder + "/clocks.csv", clocks);
    for (const char* name : {"imu.csv", "imu_scale.csv", "wheels.csv", "lidar3d_rings.csv"})
      std::filesystem::remove(folder + "/" + name);  // of an earlier run
    if (imu_) writeImuErrors(folder, *imu_, truthClock(), options_.duration);
    if (wheels_) writeWheelErrors(folder, *wheels_, truthClock());
    if (has(Sensor::Lidar3d)) writeLidarRings(folder + "/lidar3d_rings.csv", optical_sensors_->lidarDevice());
    writeCloud(folder + "/cloud.ply", world_, *motion_);
  }

 private:
  bool has(Sensor sensor) const { return options_.sensors.count(sensor) != 0; }
  ClockOptions clockErrors(Sensor sensor) const {
    return clockOptions(options_.defects, sensor, noise_.of("clocks").bits(0));
  }
  Clock sensorClock(Sensor sensor) const { return {begin_, clockErrors(sensor), noise_.of(toString(sensor))}; }
  Clock truthClock() const { return {begin_, ClockOptions(), noise_.of("truth")}; }

  void addTruth() {
    timeline_.add(truthSchedule(), [this, clock = truthClock()](std::int64_t k) {
      const double t = truthSchedule().at(k);
      return std::vector<Measurement>{TruthMeasurement{clock.stamp(k, t), motion_->at(t).T_world_base}};
    });
  }

  void addImu() {
    imu_.emplace(*motion_, sensorPose(urban_nav_core::frames::kImu), imuOptions(options_.defects),
                 sensorClock(Sensor::Imu), noise_.of("imu errors"));
    timeline_.add(sensorSchedule(Sensor::Imu),
                  [this](std::int64_t k) { return std::vector<Measurement>{imu_->at(k)}; });
  }

  void addWheels() {
    wheels_.emplace(*motion_, wheelOptions(options_.defects), sensorClock(Sensor::Wheels), noise_.of("wheel errors"));
    timeline_.add(sensorSchedule(Sensor::Wheels), [this](std::int64_t k) {
      return k < wheels_->count() ? std::vector<Measurement>{wheels_->at(k)} : std::vector<Measurement>();
    });
  }

  void addGps() {
    gps_.emplace(*motion_, sensorPose(urban_nav_core::frames::kGps), gpsOptions(options_.defects),
                 sensorClock(Sensor::Gps), noise_.of("gps errors"));
    timeline_.add(sensorSchedule(Sensor::Gps),
                  [this](std::int64_t k) { return std::vector<Measurement>{gps_->at(k)}; });
  }

  void addEyes() {
    optical_sensors_ = std::make_unique<OpticalSensors>(world_, *motion_, noise_, options_.defects, options_.lidar,
                                                        options_.views, options_.faults);
    if (has(Sensor::Lasers))
      for (const Side side : {Side::Left, Side::Right})
        timeline_.add(laserSchedule(side), [this, side, clock = sensorClock(Sensor::Lasers)](std::int64_t k) {
          return optical_sensors_->laser(side, k, clock);
        });
    if (has(Sensor::Stereo))
      timeline_.add(sensorSchedule(Sensor::Stereo), [this, clock = sensorClock(Sensor::Stereo)](std::int64_t k) {
        return optical_sensors_->stereo(k, clock);
      });
    if (has(Sensor::Ladybug))
      timeline_.add(sensorSchedule(Sensor::Ladybug), [this, clock = sensorClock(Sensor::Ladybug)](std::int64_t k) {
        return optical_sensors_->panorama(k, clock);
      });
    if (has(Sensor::Lidar3d))
      timeline_.add(sensorSchedule(Sensor::Lidar3d), [this, clock = sensorClock(Sensor::Lidar3d)](std::int64_t k) {
        return optical_sensors_->lidar(k, clock);
      });
  }

  SessionOptions options_;
  Route route_;
  World world_;
  std::unique_ptr<Motion> motion_;
  StampNs begin_;
  Noise noise_;
  Timeline timeline_;
  FaultFilter faults_;
  std::optional<Imu> imu_;
  std::optional<Wheels> wheels_;
  std::optional<Gps> gps_;
  std::unique_ptr<OpticalSensors> optical_sensors_;
};

void checkPlace(const SessionOptions& options) { makeRoute(checked(options)); }

Session::Session(const SessionOptions& options) : implementation_(std::make_unique<Implementation>(options)) {}
Session::~Session() = default;

std::optional<Session::Arrival> Session::next() { return implementation_->next(); }
Pose Session::truth(StampNs taken) const { return implementation_->truth(taken); }
StampNs Session::begin() const { return implementation_->begin(); }
double Session::duration() const { return implementation_->options().duration; }
std::int64_t Session::frames() const { return sensorSchedule(Sensor::Stereo).count(duration()); }
std::map<std::string, Pose> Session::places() const {
  std::map<std::string, Pose> places = sensorPlaces();
  if (implementation_->options().sensors.count(Sensor::Lidar3d) != 0)
    places[urban_nav_core::frames::kLidar3d] = lidarPose();
  const StereoImages images = stereoImages(implementation_->options().defects);
  if (images == StereoImages::Rectified) return places;
  // Raw images are in the mounted orientation of the cameras: R of camera_info rotates them to the rectified pair.
  const std::array<Camera, 2> cameras = bumblebee(images);
  const char* const frames[] = {urban_nav_core::frames::kStereoLeft, urban_nav_core::frames::kStereoRight};
  for (std::size_t i = 0; i < cameras.size(); ++i)
    places.at(frames[i]) = places.at(frames[i]) * Pose(cameras[i].T_head_camera.R(), Eigen::Vector3d::Zero());
  return places;
}
urban_nav_core::CameraInfo Session::stereoInfo(Side side) const {
  urban_nav_core::CameraInfo info = OpticalSensors::stereoInfo(side, implementation_->options().defects);
  for (const Fault& fault : implementation_->options().faults)
    if (fault.kind == FaultKind::Scale) info.P(0, 3) *= fault.value.value_or(kDefaultScale);
  return info;
}
urban_nav_core::CameraInfo Session::ladybugInfo(int camera) const { return OpticalSensors::ladybugInfo(camera); }
void Session::writeTruth(const std::string& folder, double false_closures) const {
  implementation_->writeTruth(folder, false_closures);
}

std::string worldHelp() {
  std::string text = "Worlds and their routes:\n";
  for (const std::string& world : worldNames()) {
    text += "  " + world + "\n";
    for (const Route& route : worldRoutes(world, 1)) {
      std::string name = route.name;
      name.resize(std::max<std::size_t>(name.size() + 1, 14), ' ');
      text += "    " + name + route.summary + "\n";
    }
  }
  return text;
}

}  // namespace urban_nav_sim
