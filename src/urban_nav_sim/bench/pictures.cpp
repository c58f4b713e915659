// SPDX-License-Identifier: BSD-3-Clause
// Renders the pictures of the READMEs: simulated_above.jpg, simulated_cloud.jpg, and simulated.jpg with the views of
// the robot.
//   pictures [--folder DIR] [--seen S] [--again S]
#include <array>
#include <cmath>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "camera/heads.hpp"
#include "camera/sky.hpp"
#include "laser/lms291.hpp"
#include "motion/simulate_drive.hpp"
#include "ray_tracing/tracer.hpp"
#include "rig/sensor_poses.hpp"
#include "support/free_camera.hpp"
#include "support/panorama.hpp"
#include "support/point_view.hpp"
#include "support/program.hpp"
#include "urban_nav_core/types/frames.hpp"

namespace {

using namespace urban_nav_sim;
using namespace urban_nav_sim::bench;
using Eigen::Vector3d;

constexpr int kWidth = 1600, kGap = 8;  // px
constexpr double kDuration = 300.0;     // s
constexpr std::uint32_t kSeed = 7;
const cv::Scalar kWhite = cv::Scalar::all(255.0);

/// A world on one day, and a motion through it.
struct Scene {
  World world;
  Tracer tracer;
  Sky sky;
  std::unique_ptr<Motion> motion;

  Scene(const std::string& name, int day) : world(buildWorld(name, kSeed, day)), tracer(world), sky(world.day, kSeed) {
    DriveOptions options;
    options.duration = kDuration;
    options.seed = kSeed;
    motion = simulateDrive(world, makeRoute(name, kSeed, "loops"), options);
  }
};

/// Returns pictures of one height side by side, scaled to the width of a page.
cv::Mat beside(const std::vector<cv::Mat>& images) {
  const int width = (kWidth - kGap * (static_cast<int>(images.size()) - 1)) / static_cast<int>(images.size());
  std::vector<cv::Mat> row;
  for (const cv::Mat& image : images) {
    if (!row.empty()) row.emplace_back(row.front().rows, kGap, CV_8UC3, kWhite);
    cv::Mat colour = image, scaled;
    if (image.channels() == 1) cv::cvtColor(image, colour, cv::COLOR_GRAY2BGR);
    cv::resize(colour, scaled, cv::Size(width, width * image.rows / image.cols), 0.0, 0.0, cv::INTER_AREA);
    row.push_back(scaled);
  }
  cv::Mat result;
  cv::hconcat(row, result);
  return result;
}

cv::Mat above(const std::vector<cv::Mat>& rows) {
  std::vector<cv::Mat> column;
  for (const cv::Mat& row : rows) {
    if (!column.empty()) column.emplace_back(kGap, row.cols, CV_8UC3, kWhite);
    column.push_back(row);
  }
  cv::Mat result;
  cv::vconcat(column, result);
  return result;
}

/// Returns the points of both lasers, each beam at its time on the true path.
std::vector<Return> scanCloud(const Scene& scene) {
  std::vector<Return> cloud;
  const Lms291::Settings settings;
  for (const char* frame : {urban_nav_core::frames::kLaserLeft, urban_nav_core::frames::kLaserRight}) {
    const urban_nav_core::Pose T_base_laser = sensorPose(frame);
    const Lms291 laser(scene.tracer, T_base_laser, kSeed, frame, settings);
    const auto turns = static_cast<std::uint64_t>(scene.motion->duration() / settings.period);
    for (std::uint64_t turn = 0; turn < turns; ++turn) {
      const double t = static_cast<double>(turn) * settings.period;
      for (const urban_nav_core::Beam& beam : urban_nav_core::toScan(laser.scan(*scene.motion, t, 0, turn)).beams) {
        const double then = t + 1e-9 * static_cast<double>(beam.stamp);
        const Vector3d p_laser = static_cast<double>(beam.range) * beam.direction.cast<double>();
        const Vector3d p_world = scene.motion->at(then).T_world_base * (T_base_laser * p_laser);
        cloud.push_back({p_world.cast<float>(), beam.intensity});
      }
    }
  }
  return cloud;
}

std::array<cv::Mat, 2> renderStereo(const Scene& scene, double t) {
  return StereoHead(scene.tracer, scene.sky, StereoImages::Rectified, sensorPose(urban_nav_core::frames::kStereoLeft),
                    kSeed)
      .take(*scene.motion, t);
}

/// Returns a wide-angle view from the head of the robot.
cv::Mat ahead(const Scene& scene, double t) {
  const urban_nav_core::Pose T_world_base = scene.motion->at(t).T_world_base;
  FreeCamera camera;
  camera.from = T_world_base * Vector3d(0.1, 0.0, 1.4);
  camera.to = camera.from + T_world_base.q() * Vector3d(1.0, 0.0, 0.02);
  camera.field = 1.35, camera.width = 528, camera.height = 330;
  return photograph(scene.tracer, scene.sky, camera, t);
}

void write(const std::string& path, const cv::Mat& image) {
  if (!cv::imwrite(path, image, {cv::IMWRITE_JPEG_QUALITY, 80})) throw std::runtime_error(path + ": not written");
}

}  // namespace

int main(int argc, char** argv) try {
  const Options options(argc, argv);
  const std::string folder = options.text("--folder", ".");
  const double seen = options.number("--seen", 24.0), again = options.number("--again", 48.0);  // s of the motion
  const Scene quad("quad", 1);

  const FreeCamera bird{{-50, 2, 38}, {14, 14, 0}, 0.95};
  write(folder + "/simulated_above.jpg", photograph(quad.tracer, quad.sky, bird));
  FreeCamera over_cloud{{-42, -40, 42}, {24, 10, 0}, 1.0};
  over_cloud.height = 800;
  write(folder + "/simulated_cloud.jpg", drawCloud(scanCloud(quad), over_cloud, 11.0F));

  const auto [left, right] = renderStereo(quad, seen);
  LadybugHead head(quad.tracer, quad.sky, ladybugPlace(), kSeed);
  const cv::Mat round = panorama(head.cameras(), head.take(*quad.motion, seen), kWidth);
  std::vector<cv::Mat> pairs = {left, right}, days = {ahead(quad, again)};
  for (const char* name : {"street", "begbroke"}) pairs.push_back(renderStereo(Scene(name, 1), seen)[0]);
  for (const int day : {2, 3}) days.push_back(ahead(Scene("quad", day), again));
  write(folder + "/simulated.jpg", above({beside(pairs), round, beside(days)}));
  return 0;
} catch (const std::exception& error) {
  return urban_nav_sim::bench::complain(error);
}
