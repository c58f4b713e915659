// SPDX-License-Identifier: BSD-3-Clause
#include "camera_sessions.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

#include "segway_drivers/bumblebee2/camera.hpp"
#include "segway_drivers/camera/pack_frames.hpp"
#include "segway_drivers/camera/sim_source.hpp"
#include "segway_drivers/ladybug2/camera.hpp"

namespace urban_nav::bench {

namespace {

using segway_drivers::Bytes;
using segway_drivers::SimCameraOptions;
using segway_drivers::TimeNs;

cv::Mat makeScene(int seed, cv::Size size, int type) {
  cv::Mat noise(size.height / 16, size.width / 16, type), scene;
  cv::RNG random(static_cast<std::uint64_t>(seed));
  random.fill(noise, cv::RNG::UNIFORM, 30, 220);
  cv::resize(noise, scene, size, 0.0, 0.0, cv::INTER_CUBIC);
  return scene;
}

template <typename Camera>
class SteppedCamera {
 public:
  SteppedCamera(Bytes frame, SimCameraOptions options, double period)
      : source_(
            [this, period, bytes = std::move(frame)]() -> std::optional<segway_drivers::SimFrame> {
              return segway_drivers::SimFrame{period * sent_++, bytes};
            },
            std::move(options), {[this] { return now_; }, [this](TimeNs until) { now_ = std::max(now_, until); }}),
        camera_(source_, typename Camera::Options{}) {
    std::string error;
    if (!camera_.start(error)) throw std::runtime_error(error);
  }
  SteppedCamera(const SteppedCamera&) = delete;
  SteppedCamera& operator=(const SteppedCamera&) = delete;

  int runUntil(int frames) {
    int taken = 0;
    while (sent_ < frames) taken += camera_.next(100'000'000) ? 1 : 0;
    return taken;
  }

 private:
  TimeNs now_ = 5'000'000'000;
  int sent_ = 0;
  segway_drivers::SimSource source_;
  Camera camera_;
};

template <typename Camera>
CameraSession makeSession(const std::string& name, Bytes frame, SimCameraOptions::Model model, double period) {
  SimCameraOptions options;
  options.model = model;
  const auto camera = std::make_shared<SteppedCamera<Camera>>(std::move(frame), options, period);
  return {name, period, [camera](int frames) { return camera->runUntil(frames); }};
}

}  // namespace

void forEachCamera(const std::function<void(const CameraSession&)>& visit) {
  const cv::Size size(segway_drivers::kBb2Width, segway_drivers::kBb2Height);
  visit(makeSession<segway_drivers::Bb2Camera>(
      "bumblebee2", segway_drivers::packBb2Frame(makeScene(1, size, CV_8U), makeScene(2, size, CV_8U)),
      SimCameraOptions::Model::Bumblebee2, 0.05));
  std::array<cv::Mat, 5> pictures;
  for (int i = 0; i < 5; ++i) pictures[static_cast<std::size_t>(i)] = makeScene(i, {384, 512}, CV_8UC3);
  visit(makeSession<segway_drivers::LadybugCamera>("ladybug2", segway_drivers::packLadybugFrame(pictures, 60),
                                                   SimCameraOptions::Model::Ladybug2, 0.3));
}

}  // namespace urban_nav::bench
