// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/camera/record_frames.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "segway_drivers/bumblebee2/camera.hpp"
#include "segway_drivers/ladybug2/camera.hpp"
#include "urban_nav_core/types/error.hpp"

namespace segway_drivers {

namespace {

constexpr TimeNs kRecordingWait = 100'000'000;  // ns
constexpr double kLongestSession = 1e8;         // s

bool configureCamera(SimSource& source, SimCameraOptions::Model model) {
  std::string error;
  if (model == SimCameraOptions::Model::Ladybug2) return LadybugCamera(source, {}).start(error);
  return Bb2Camera(source, {}).start(error);
}

/// Removes the padding of the container, as the driver does for ladybug/raw.
void cutPadding(Bytes& bytes, SimCameraOptions::Model model) {
  if (model == SimCameraOptions::Model::Bumblebee2 || bytes.size() < 0x0C) return;
  bytes.resize(std::min<std::size_t>(bytes.size(), bigWord32(bytes.data() + 0x08)));
}

std::uint32_t sequenceInFrame(const Bytes& bytes, SimCameraOptions::Model model) {
  if (model == SimCameraOptions::Model::Bumblebee2) return splitBb2Frame(bytes, false, Bb2Embedding::Raw).sequence;
  const auto frame = splitLadybugFrame(bytes, false);
  return frame ? frame->sequence : 0;
}

/// Returns the end of the current loss of the camera, s since the start of the session.
double endOfLoss(const std::vector<SimCameraFault>& faults, double t) {
  double end = t;
  for (const SimCameraFault& fault : faults) {
    const bool off = fault.kind == SimCameraFault::Kind::Unplug || fault.kind == SimCameraFault::Kind::Power;
    if (off && t >= fault.start) end = std::max(end, fault.start + fault.duration);
  }
  return end;
}

}  // namespace

std::int64_t recordFrames(const FrameReader& read, const SimCameraOptions& options,
                          const std::function<void(const RecordedFrame&)>& take, const std::function<bool()>& stop) {
  std::optional<SimFrame> first = read();
  if (!first) throw urban_nav_core::DataError("camera", "no complete frame", "images of all its imagers");
  const TimeNs begin = first->recorded;
  TimeNs now = begin, time = begin;
  const FrameReader next = [&] {
    std::optional<SimFrame> frame = first ? std::exchange(first, std::nullopt) : read();
    if (frame) time = frame->recorded;
    return frame;
  };
  SimSource source(next, options, {[&now] { return now; }, [&now](TimeNs until) { now = std::max(now, until); }});
  std::int64_t frames = 0;
  bool streams = configureCamera(source, options.model);
  while (!source.isFinished() && !stop()) {
    if (source.isGone()) {
      source.next(kRecordingWait);
      const double lost_until = endOfLoss(options.faults, 1e-9 * static_cast<double>(now - begin));
      if (lost_until > kLongestSession) break;
      now = std::max(now, begin + static_cast<TimeNs>(std::ceil(1e9 * lost_until)));
      streams = false;
    }
    if (!streams) streams = configureCamera(source, options.model);
    std::optional<CameraFrame> frame = source.next(kRecordingWait);
    if (!frame) continue;
    ++frames;
    cutPadding(frame->bytes, options.model);
    const std::uint32_t sequence = sequenceInFrame(frame->bytes, options.model);
    take({std::move(frame->bytes), sequence, time, frame->arrival, frame->corrupt});
  }
  return frames;
}

}  // namespace segway_drivers
