// SPDX-License-Identifier: BSD-3-Clause
// The back end on real feature tracks (folder stereo/ of URBAN_NAV_DATA): starry_night with known landmarks and the IMU
// as input, compared with the batch by Ceres; kitti00_tracks with its outliers; kitti07_tracks_ucsd with its repeated
// frames.
//   swf_vo-bench-real_tracks [-o OUT.json]     (data where URBAN_NAV_DATA says)
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "../test/window/batch_ceres.hpp"
#include "../test/window/track_runner.hpp"
#include "support/program.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/trajectory/errors.hpp"

namespace {

using namespace swf_vo;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using urban_nav_core::CsvTable;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::PoseWithCovariance;
using urban_nav_core::StereoCamera;
using urban_nav_core::Vector6d;
using urban_nav_core::testing::cell;

CsvTable readGz(const std::string& path) {
  std::string text;
  std::FILE* pipe = popen(("gzip -dc '" + path + "'").c_str(), "r");
  std::array<char, 65536> buffer;
  for (std::size_t n = 0; pipe != nullptr && (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    text.append(buffer.data(), n);
  if (pipe == nullptr || pclose(pipe) != 0) throw std::runtime_error(path + ": cannot be read");
  return CsvTable::parse(text, path);
}

Vector3d triple(const CsvTable& table, std::size_t row, std::size_t first) {
  return {table.number(row, first), table.number(row, first + 1), table.number(row, first + 2)};
}

// Root mean square over all poses, m and deg, and share of each axis inside three standard deviations.
struct Shares {
  double rmse_m = 0.0, rmse_deg = 0.0;
  std::array<double, 6> inside{};
};
Shares compare(const std::vector<Pose>& truth, const std::vector<PoseWithCovariance>& estimate) {
  Shares shares;
  const double n = static_cast<double>(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    Vector6d e = urban_nav_core::boxMinus(truth[i], estimate[i].pose);
    Matrix6d lift = Matrix6d::Identity();
    lift.bottomRightCorner<3, 3>() = truth[i].R().transpose();  // rotations about the vehicle's axes
    const Matrix6d P = lift * estimate[i].covariance * lift.transpose();
    e = lift * e;
    shares.rmse_m += e.head<3>().squaredNorm() / n;
    shares.rmse_deg += e.tail<3>().squaredNorm() / n;
    for (int c = 0; c < 6; ++c)
      shares.inside[static_cast<std::size_t>(c)] += (std::abs(e[c]) < 3.0 * std::sqrt(P(c, c)) ? 100.0 : 0.0) / n;
  }
  shares.rmse_m = std::sqrt(shares.rmse_m);
  shares.rmse_deg = std::sqrt(shares.rmse_deg) * 180.0 / 3.14159265358979323846;
  return shares;
}

// Calibration and variances are those of starry_night/calibration.yaml.
struct Starry {
  StereoCamera camera;
  Pose T_vehicle_camera;
  std::vector<Pose> truth;           // poses of the vehicle
  std::vector<ProcessInput> inputs;  // for the camera
  std::vector<Vector3d> landmarks;
  std::vector<std::vector<Observation>> frames;

  explicit Starry(const std::string& folder) {
    camera.left = {484.49984741211, 484.4998474121, 321.68048095703, 247.4814453125, 640, 480};
    camera.baseline = 0.23997700214386;
    Matrix3d C_c_v;
    C_c_v << 0.0024895746143281934, -0.99996875926414641, -0.0075021672844137249, -0.0068621935689208097,
        -0.0075190974076185307, 0.99994818539442198, -0.99997335580387436, -0.0024379642939095221,
        -0.0068806985429727902;
    T_vehicle_camera =
        Pose(Matrix3d(C_c_v.transpose()), Vector3d(-0.018471190575310225, 0.10737574109712875, 0.03039475336899054));
    const Vector3d w_var(0.009048716639031933, 0.017002242077980376, 0.1747167826999409);
    const Vector3d v_var(0.0026318905845479227, 0.0020748239953393096, 0.00079170909186070148);
    const Eigen::Vector4d y_var(37.979947023144447, 129.83556560272547, 41.952746193087151, 132.48913283822699);
    const CsvTable poses = readGz(folder + "/truth.csv.gz"), imu = readGz(folder + "/imu.csv.gz");
    for (std::size_t i = 0; i < poses.rows(); ++i)
      truth.emplace_back(urban_nav_core::expSo3(triple(poses, i, 4)), triple(poses, i, 1));
    const Pose T_camera_vehicle = T_vehicle_camera.inverse();
    inputs.resize(truth.size());
    for (std::size_t i = 1; i < truth.size(); ++i) {
      const double dt = imu.number(i, 0) - imu.number(i - 1, 0);
      const Pose moved(urban_nav_core::expSo3(triple(imu, i - 1, 1) * dt), triple(imu, i - 1, 4) * dt);
      inputs[i].T_from_to = T_camera_vehicle * moved * T_vehicle_camera;
      Vector6d variance;
      variance << v_var * dt * dt, w_var * dt * dt;
      const Matrix3d R = T_vehicle_camera.R().transpose();
      Matrix6d A = Matrix6d::Zero();
      A.topLeftCorner<3, 3>() = A.bottomRightCorner<3, 3>() = R;
      A.topRightCorner<3, 3>() = -R * urban_nav_core::skew(moved.R() * T_vehicle_camera.t());
      const Matrix6d covariance = A * variance.asDiagonal() * A.transpose();
      inputs[i].information = covariance.inverse();
    }
    const CsvTable known = readGz(folder + "/landmarks.csv.gz");
    for (std::size_t j = 0; j < known.rows(); ++j) landmarks.push_back(triple(known, j, 1));
    frames.resize(truth.size());
    const CsvTable seen = readGz(folder + "/stereo.csv.gz");
    for (std::size_t r = 0; r < seen.rows(); ++r) {
      Observation observation;
      observation.frame = seen.integer(r, 0);
      observation.landmark = seen.integer(r, 1);
      // Two measurements of one row: equivalent to their weighted mean.
      const double left = 1.0 / y_var[1], right = 1.0 / y_var[3];
      observation.z =
          Vector3d(seen.number(r, 2), (left * seen.number(r, 3) + right * seen.number(r, 5)) / (left + right),
                   seen.number(r, 4));
      observation.information = Vector3d(1.0 / y_var[0], left + right, 1.0 / y_var[2]).asDiagonal();
      frames[static_cast<std::size_t>(observation.frame)].push_back(observation);
    }
  }

  PoseWithCovariance vehicle(const PoseWithCovariance& camera_pose) const {
    PoseWithCovariance result;
    const Pose T_camera_vehicle = T_vehicle_camera.inverse();
    result.pose = camera_pose.pose * T_camera_vehicle;
    Matrix6d A = Matrix6d::Identity();
    A.topRightCorner<3, 3>() = -urban_nav_core::skew(camera_pose.pose.R() * T_camera_vehicle.t());
    result.covariance = A * camera_pose.covariance * A.transpose();
    return result;
  }
};

/// Poses when newest in the window, when they leave it, and after back-substitution.
struct StarryEstimates {
  std::vector<PoseWithCovariance> now, settled, full;
};

/// Runs a window of `size` poses over all frames.
StarryEstimates trackStarry(const Starry& data, const Matrix6d& first, int size) {
  WindowOptions options;
  options.size = size;
  options.exact_undo = false;
  options.keep_history = true;
  Window window(options, data.camera);
  StarryEstimates made;
  const auto keep = [&](const SettledPose& pose) { made.settled.push_back(data.vehicle(pose.T_odom_camera)); };
  for (std::size_t i = 0; i < data.truth.size(); ++i) {
    if (i == 0) {
      window.start(0, data.truth[0] * data.T_vehicle_camera, first);
      for (std::size_t j = 0; j < data.landmarks.size(); ++j)
        window.fixLandmark({static_cast<LandmarkId>(j), data.landmarks[j].homogeneous()});
    } else {
      window.addPose(static_cast<FrameId>(i), data.inputs[i]);
    }
    window.removePoses();
    for (const SettledPose& pose : window.settled()) keep(pose);
    for (const Observation& observation : data.frames[i]) window.observe(observation);
    window.update();
    made.now.push_back(data.vehicle(window.newest()));
  }
  for (const auto& [frame, pose] : window.trajectory()) made.full.push_back(data.vehicle({pose, Matrix6d::Identity()}));
  for (const SettledPose& pose : window.flush()) keep(pose);
  return made;
}

void starry(const std::string& folder, urban_nav_core::testing::BenchTable& table) {
  const Starry data(folder);
  const Matrix6d first = diagonalInformation(1e-3, 1e-3);
  BatchProblem batch;
  batch.camera = data.camera;
  batch.inputs = data.inputs;
  batch.points = data.landmarks;
  batch.known.assign(data.landmarks.size(), 1);
  batch.first_information = first;
  for (const auto& frame : data.frames) batch.observations.insert(batch.observations.end(), frame.begin(), frame.end());
  for (const int size : {1, 10, 25}) {
    const auto [now, settled, full] = trackStarry(data, first, size);
    if (batch.poses.empty())
      for (const PoseWithCovariance& pose : settled) batch.poses.push_back(pose.pose * data.T_vehicle_camera);
    const auto add = [&](const char* what, const std::vector<PoseWithCovariance>& estimate, bool covariances) {
      const Shares shares = compare(data.truth, estimate);
      std::string inside;
      for (const double share : shares.inside) inside += cell(share, 1) + " ";
      table.add({"starry_night", "k = " + std::to_string(size) + ", " + what,
                 cell(100.0 * shares.rmse_m, 2) + " cm, " + cell(shares.rmse_deg, 2) + " deg",
                 covariances ? inside : ""});
    };
    add("now", now, true);
    add("settled", settled, true);
    add("all, by back-substitution", full, false);
  }
  for (const double huber : {0.0, WindowOptions().huber}) {
    batch.huber = huber;
    solveBatch(batch);
    std::vector<PoseWithCovariance> estimate;
    for (const Pose& pose : batch.poses) estimate.push_back(data.vehicle({pose, Matrix6d::Identity()}));
    const Shares shares = compare(data.truth, estimate);
    table.add({"starry_night", huber > 0.0 ? "batch (Ceres, Huber)" : "batch (Ceres)",
               cell(100.0 * shares.rmse_m, 2) + " cm, " + cell(shares.rmse_deg, 2) + " deg",
               huber > 0.0 ? "" : "97.9 97.7 99.4 96.7 78.9 97.7 (its README)"});
  }
}

struct KittiTracks {
  StereoCamera camera;
  std::vector<Pose> truth;
  std::vector<std::vector<Observation>> frames;
  std::map<LandmarkId, FrameId> last;
};

// Tracks end where their numbers repeat, and new ones begin there (kitti07_tracks_ucsd/README.md).
KittiTracks readTracks(const std::string& folder, bool two_rows, double sigma_px) {
  KittiTracks data;
  data.truth = urban_nav_core::readKitti(folder + "/poses.txt");
  const CsvTable table = readGz(folder + "/stereo_tracks.csv.gz");
  std::map<std::int64_t, std::pair<Vector3d, LandmarkId>> before;
  std::map<std::int64_t, FrameId> before_frame;
  LandmarkId next = 0;
  std::vector<std::vector<std::size_t>> by_frame;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    const std::size_t frame = static_cast<std::size_t>(table.integer(r, 0));
    if (by_frame.size() <= frame) by_frame.resize(frame + 1);
    by_frame[frame].push_back(r);
  }
  data.frames.resize(by_frame.size());
  for (std::size_t frame = 0; frame < by_frame.size(); ++frame)
    for (const std::size_t r : by_frame[frame]) {
      const std::int64_t id = table.integer(r, 1);
      Vector3d z;
      if (two_rows)
        z = Vector3d(table.number(r, 2), 0.5 * (table.number(r, 3) + table.number(r, 5)), table.number(r, 4));
      else z = Vector3d(table.number(r, 2), table.number(r, 4), table.number(r, 3));
      const auto known = before.find(id);
      const bool goes_on =
          known != before.end() && known->second.first != z && before_frame[id] + 1 == static_cast<FrameId>(frame);
      const LandmarkId landmark = goes_on ? known->second.second : next++;
      before[id] = {z, landmark};
      before_frame[id] = static_cast<FrameId>(frame);
      data.frames[frame].push_back({landmark, static_cast<FrameId>(frame), z, pixelInformation(sigma_px)});
      data.last[landmark] = static_cast<FrameId>(frame);
    }
  return data;
}

// Constant velocity without other information.
ProcessInput constantVelocity(const std::vector<Pose>& before, double seconds) {
  ProcessInput u;
  const std::size_t n = before.size();
  if (n < 2) {
    u.information = diagonalInformation(2.0, 0.1);
    return u;
  }
  u.T_from_to = before[n - 2].inverse() * before[n - 1];
  constexpr double kAcceleration = 3.0, kAngular = 1.0;
  u.information = diagonalInformation(kAcceleration * seconds * seconds, kAngular * seconds * seconds);
  return u;
}

void kitti(const std::string& name, const KittiTracks& data, std::size_t first, std::size_t last, int size,
           urban_nav_core::testing::BenchTable& table) {
  WindowOptions options;
  options.size = size;
  options.exact_undo = false;
  Window window(options, data.camera);
  std::vector<Pose> now, settled;
  for (std::size_t i = 0; i <= last; ++i) {
    const FrameId frame = static_cast<FrameId>(i);
    if (i == 0) window.start(0, Pose(), diagonalInformation(1e-6, 1e-6));
    else window.addPose(frame, constantVelocity(now, 0.1));
    window.removePoses();
    for (const SettledPose& pose : window.settled()) settled.push_back(pose.T_odom_camera.pose);
    for (const Observation& observation : data.frames[i]) {
      window.observe(observation);
      if (data.last.at(observation.landmark) == frame) window.endLandmark(observation.landmark);
    }
    window.update();
    now.push_back(window.newest().pose);
  }
  for (const SettledPose& pose : window.flush()) settled.push_back(pose.T_odom_camera.pose);
  const auto from = static_cast<std::ptrdiff_t>(first), to = static_cast<std::ptrdiff_t>(last) + 1;
  const std::vector<Pose> truth(data.truth.begin() + from, data.truth.begin() + to);
  const double length = urban_nav_core::pathLength(truth);
  for (const bool causal : {true, false}) {
    const std::vector<Pose>& all = causal ? now : settled;
    const std::vector<Pose> estimate(all.begin() + from, all.begin() + to);
    const double off =
        urban_nav_core::absoluteErrors(truth, estimate, urban_nav_core::TrajectoryAlignment::First).back();
    const auto relative = urban_nav_core::relativeError(truth, estimate, {urban_nav_core::Span::Unit::Frames, 10.0});
    table.add({name, "k = " + std::to_string(size) + (causal ? ", now" : ", settled"),
               cell(off, 2) + " m of " + cell(length, 0) + " m: " + cell(100.0 * off / length, 2) + " %",
               relative ? "10-frame spans " + cell(relative->percent, 2) + " %, " + cell(relative->deg_per_m, 4) +
                              " deg/m, length " + cell(100.0 * relative->step_ratio, 1) + " %"
                        : ""});
  }
}

}  // namespace

int main(int argc, char** argv) try {
  const char* environment = std::getenv("URBAN_NAV_DATA");
  const std::string data = std::string(environment != nullptr ? environment : "data") + "/stereo";
  const std::string output = argc > 2 && std::string(argv[1]) == "-o" ? argv[2] : "";
  urban_nav_core::testing::BenchTable table({"tracks", "window", "error", "inside 3 sigma, %, or relative error"}, argc,
                                            argv);
  starry(data + "/starry_night", table);
  std::puts(table.text().c_str());
  KittiTracks kitti00 = readTracks(data + "/kitti00_tracks", false, 1.0);
  kitti00.camera.left = {718.856, 718.856, 607.1928, 185.2157, 1241, 376};
  kitti00.camera.baseline = 0.53717;
  for (const int size : {1, 10, 100})
    for (const std::size_t first : {0U, 14U})
      kitti("kitti00_tracks, frames " + std::to_string(first) + "-76", kitti00, first, 76, size, table);
  std::puts(table.text().c_str());
  KittiTracks kitti07 = readTracks(data + "/kitti07_tracks_ucsd", true, 0.7);
  kitti07.camera.left = {707.0912, 707.0912, 601.8873, 183.1104, 1226, 370};
  kitti07.camera.baseline = 0.537151;
  for (const int size : {1, 10, 25}) kitti("kitti07_tracks_ucsd", kitti07, 0, 1100, size, table);
  table.note(
      "kitti00_tracks: the first 14 poses of its truth are inaccurate (its README). kitti07_tracks_ucsd: in 91 frames "
      "all tracks repeat the frame before; they end there, and no track spans that step.");
  return swf_vo::bench::show(table, output);
} catch (const std::exception& error) {
  return swf_vo::bench::complain(error);
}
