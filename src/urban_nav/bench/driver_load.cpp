// SPDX-License-Identifier: BSD-3-Clause
// Processor time of each driver: of serial devices with their transport behind pseudo-terminals in real time, of
// cameras from frames in memory.
//
//   urban_nav-bench-driver_load [-o FILE.json] [--seconds 20]
#include <ctime>

#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <string>
#include <thread>

#include "segway_drivers/bumblebee2/camera.hpp"
#include "segway_drivers/camera/pack_frames.hpp"
#include "segway_drivers/camera/sim_source.hpp"
#include "segway_drivers/driver/run_device.hpp"
#include "segway_drivers/ladybug2/camera.hpp"
#include "support/device_sessions.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_sim/device/device_server.hpp"

namespace {

using segway_drivers::TimeNs;
using urban_nav_core::testing::cell;

double threadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Load {
  double share = 0.0;  ///< of a core
  double rate = 0.0;   ///< messages a second
};

/// Runs a driver as its nodelet does, with waits of 2 ms, while the device is served in another thread.
Load runSerial(urban_nav::bench::DeviceSession& session, double seconds, const std::string& folder) {
  const std::string port = folder + "/port";
  const auto link = urban_nav_sim::openPseudoTerminal(port);
  std::atomic<bool> stop{false};
  std::thread server([&] { serveDevice(*session.device, *link, [&] { return stop.load(); }); });
  segway_drivers::DriverLoop loop(*session.driver, port);
  loop.open();
  const auto runUntil = [&](TimeNs end) {
    while (segway_drivers::steadyTime() < end) loop.step(2'000'000);
  };
  const TimeNs second = 1'000'000'000, begin = segway_drivers::steadyTime() + 4 * second;  // identified by then
  runUntil(begin);
  const double before = threadSeconds();
  const std::int64_t messages = *session.messages;
  runUntil(begin + static_cast<TimeNs>(1e9 * seconds));
  Load load{(threadSeconds() - before) / seconds, static_cast<double>(*session.messages - messages) / seconds};
  stop = true;
  server.join();
  return load;
}

cv::Mat makeScene(int seed, cv::Size size, int type) {
  cv::Mat noise(size.height / 16, size.width / 16, type), scene;
  cv::RNG random(static_cast<std::uint64_t>(seed));
  random.fill(noise, cv::RNG::UNIFORM, 30, 220);
  cv::resize(noise, scene, size, 0.0, 0.0, cv::INTER_CUBIC);
  return scene;
}

/// A camera whose frames lie in memory: what it takes to hand one out is the copy that a ring of buffers costs too.
template <typename Camera>
Load runCamera(const segway_drivers::Bytes& frame, segway_drivers::SimCameraOptions options, double period, int frames,
               const typename Camera::Options& camera_options) {
  TimeNs now = 5'000'000'000;
  int sent = 0;
  segway_drivers::SimSource source(
      [&]() -> std::optional<segway_drivers::SimFrame> {
        return segway_drivers::SimFrame{period * sent++, frame};
      },
      std::move(options), {[&] { return now; }, [&](TimeNs until) { now = std::max(now, until); }});
  Camera camera(source, camera_options);
  std::string error;
  if (!camera.start(error)) return {};
  const double before = threadSeconds();
  int taken = 0;
  while (sent < frames) taken += camera.next(100'000'000) ? 1 : 0;
  const double duration = period * frames;
  return {(threadSeconds() - before) / duration, taken / duration};
}

}  // namespace

int main(int argc, char** argv) {
  urban_nav_core::testing::BenchTable table({"driver", "messages a second", "share of a core, %"}, argc, argv);
  std::string output;
  double seconds = 20.0;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::string(argv[i]) == "-o") output = argv[i + 1];
    if (std::string(argv[i]) == "--seconds") seconds = std::max(std::atof(argv[i + 1]), 2.0);
  }
  const std::string folder = (std::filesystem::temp_directory_path() / "urban_nav_driver_load").string();
  double total = 0.0;
  const auto add = [&](const std::string& name, const Load& load) {
    total += load.share;
    table.add({name, cell(load.rate, 1), cell(100.0 * load.share, 2)});
  };
  urban_nav::bench::forEachSerialDevice(seconds + 10.0, [&](urban_nav::bench::DeviceSession& session) {
    add(session.name, runSerial(session, seconds, folder));
  });
  const cv::Size size(segway_drivers::bb2_width, segway_drivers::bb2_height);
  add("bumblebee2",
      runCamera<segway_drivers::Bb2Camera>(
          segway_drivers::packBb2Frame(makeScene(1, size, CV_8U), makeScene(2, size, CV_8U)), {}, 0.05, 400, {}));
  std::array<cv::Mat, 5> pictures;
  for (int i = 0; i < 5; ++i) pictures[static_cast<std::size_t>(i)] = makeScene(i, {384, 512}, CV_8UC3);
  segway_drivers::SimCameraOptions ladybug;
  ladybug.model = segway_drivers::SimCameraOptions::Model::Ladybug2;
  add("ladybug2",
      runCamera<segway_drivers::LadybugCamera>(segway_drivers::packLadybugFrame(pictures, 60), ladybug, 0.1, 200, {}));
  table.add({"all", "", cell(100.0 * total, 2)});
  table.note(
      "Processor time of the reading thread, with transport, checks and clock; without ROS. Cameras with the copy of each frame.");
  std::filesystem::remove_all(folder);
  std::fputs(table.text().c_str(), stdout);
  if (!output.empty()) table.write(output);
  return 0;
}
