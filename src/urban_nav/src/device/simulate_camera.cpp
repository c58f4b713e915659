// SPDX-License-Identifier: BSD-3-Clause
#include "device/simulate_camera.hpp"

#include <cmath>

#include "device/session_frames.hpp"
#include "segway_drivers/camera/bag_pictures.hpp"
#include "segway_drivers/camera/bus_time.hpp"
#include "segway_drivers/camera/record_frames.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using segway_drivers::SimCameraFault;
using segway_drivers::SimCameraOptions;
using urban_nav_core::UserError;
using urban_nav_sim::DeviceFaultKind;

namespace {

SimCameraFault::Kind toCameraFault(DeviceFaultKind kind) {
  switch (kind) {
    case DeviceFaultKind::Unplug: return SimCameraFault::Kind::Unplug;
    case DeviceFaultKind::Silence: return SimCameraFault::Kind::Silence;
    case DeviceFaultKind::Cut: return SimCameraFault::Kind::Corrupt;
    case DeviceFaultKind::Power: return SimCameraFault::Kind::Power;
    default: throw UserError("--fault", toString(kind), "for a camera: unplug, silence, cut, power");
  }
}

SimCameraOptions toCameraOptions(const SimulateCameraJob& job) {
  SimCameraOptions options;
  options.model = job.kind == "ladybug2" ? SimCameraOptions::Model::Ladybug2 : SimCameraOptions::Model::Bumblebee2;
  options.bus_begin = std::fmod(job.options.clock.offset, segway_drivers::kBusTimeWrap);
  if (options.bus_begin < 0.0) options.bus_begin += segway_drivers::kBusTimeWrap;
  options.bus_skew = job.options.clock.skew;
  for (const urban_nav_sim::DeviceFault& fault : job.options.faults)
    options.faults.push_back({toCameraFault(fault.kind), fault.start, fault.duration});
  return options;
}

segway_drivers::FrameReader readFrames(const SimulateCameraJob& job, SimCameraOptions::Model model) {
  if (job.bag.empty()) return simulateFrames(job.session, model);
  return model == SimCameraOptions::Model::Ladybug2 ? segway_drivers::readLadybugFrames(job.bag)
                                                    : segway_drivers::readStereoFrames(job.bag);
}

}  // namespace

bool isCamera(const std::string& kind) { return kind == "bumblebee2" || kind == "ladybug2"; }

std::int64_t simulateCamera(const SimulateCameraJob& job, const std::function<bool()>& stop) {
  const SimCameraOptions options = toCameraOptions(job);
  if (job.options.delay) throw UserError("--delay", job.kind, "a serial device: cameras are stamped by the bus");
  const segway_drivers::FrameReader read = readFrames(job, options.model);
  urban_nav_core::AtomicFile frames(job.source);
  std::string index = "offset,arrival_ns,sequence,bytes,corrupt\n", truth = "sequence,true_ns\n";
  std::size_t offset = 0;
  const auto take = [&](const segway_drivers::RecordedFrame& frame) {
    frames.write({reinterpret_cast<const char*>(frame.bytes.data()), frame.bytes.size()});
    index += std::to_string(offset) + "," + std::to_string(frame.arrival) + "," + std::to_string(frame.sequence) + "," +
             std::to_string(frame.bytes.size()) + "," + (frame.corrupt ? "1" : "0") + "\n";
    truth += std::to_string(frame.sequence) + "," + std::to_string(frame.time) + "\n";
    offset += frame.bytes.size();
  };
  const std::int64_t count = segway_drivers::recordFrames(read, options, take, stop);
  frames.commit();
  urban_nav_core::writeAtomically(job.source + ".csv", index);
  if (!job.truth.empty()) urban_nav_core::writeAtomically(job.truth, truth);
  return count;
}

}  // namespace urban_nav
