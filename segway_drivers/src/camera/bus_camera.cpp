// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/camera/frame_source.hpp"

#ifdef SEGWAY_DRIVERS_DC1394

#include <dc1394/dc1394.h>
#include <poll.h>

#include <cstdio>
#include <cstdlib>

#include "segway_drivers/camera/bus_time.hpp"
#include "segway_drivers/transport/port.hpp"

namespace segway_drivers {

namespace {

constexpr unsigned kDmaBuffers = 8;

/// Wraps libdc1394.
class BusCamera : public FrameSource {
 public:
  BusCamera(const std::string& guid, std::string model)
      : guid_(std::strtoull(guid.c_str(), nullptr, 16)), model_(std::move(model)), library_(dc1394_new()) {}
  ~BusCamera() override {
    close();
    if (library_ != nullptr) dc1394_free(library_);
  }
  BusCamera(const BusCamera&) = delete;
  BusCamera& operator=(const BusCamera&) = delete;

  bool open(std::string& error) override {
    close();
    dc1394camera_list_t* list = nullptr;
    if (library_ == nullptr || dc1394_camera_enumerate(library_, &list) != DC1394_SUCCESS) {
      error = "no IEEE 1394 bus";
      return false;
    }
    std::string found;
    for (std::uint32_t i = 0; i < list->num && camera_ == nullptr; ++i) {
      dc1394camera_t* camera = dc1394_camera_new(library_, list->ids[i].guid);
      if (camera == nullptr) continue;
      char text[32];
      std::snprintf(text, sizeof(text), "%016llx", static_cast<unsigned long long>(camera->guid));
      found += (found.empty() ? "" : ", ") + std::string(text) + " " + camera->model;
      const bool fits = guid_ != 0 ? camera->guid == guid_ : std::string(camera->model).rfind(model_, 0) == 0;
      if (fits) camera_ = camera;
      else dc1394_camera_free(camera);
    }
    dc1394_camera_free_list(list);
    gone_ = camera_ == nullptr;
    if (gone_) error = "camera not found; available: " + (found.empty() ? "none" : found);
    return !gone_;
  }
  std::optional<std::uint32_t> readRegister(std::uint64_t address) override {
    std::uint32_t value = 0;
    return camera_ != nullptr && dc1394_get_control_register(camera_, address, &value) == DC1394_SUCCESS
               ? std::optional<std::uint32_t>(value)
               : std::nullopt;
  }
  bool writeRegister(std::uint64_t address, std::uint32_t value) override {
    return camera_ != nullptr && dc1394_set_control_register(camera_, address, value) == DC1394_SUCCESS;
  }
  bool start(const CameraFormat& format, std::string& error) override {
    if (camera_ == nullptr) return false;
    const auto mode = static_cast<dc1394video_mode_t>(DC1394_VIDEO_MODE_FORMAT7_0 + format.mode);
    dc1394_iso_release_all(camera_);
    dc1394_video_set_transmission(camera_, DC1394_OFF);
    if (format.speed > 400) dc1394_video_set_operation_mode(camera_, DC1394_OPERATION_MODE_1394B);
    const bool good =
        dc1394_video_set_iso_speed(camera_, format.speed > 400 ? DC1394_ISO_SPEED_800 : DC1394_ISO_SPEED_400) ==
            DC1394_SUCCESS &&
        dc1394_video_set_mode(camera_, mode) == DC1394_SUCCESS &&
        dc1394_format7_set_roi(camera_, mode, format.raw16 ? DC1394_COLOR_CODING_RAW16 : DC1394_COLOR_CODING_MONO8,
                               format.packet, 0, 0, format.width, format.height) == DC1394_SUCCESS &&
        dc1394_capture_setup(camera_, kDmaBuffers, DC1394_CAPTURE_FLAGS_DEFAULT) == DC1394_SUCCESS &&
        dc1394_video_set_transmission(camera_, DC1394_ON) == DC1394_SUCCESS;
    if (!good) error = "the camera or the bus rejects the format";
    return good;
  }
  std::optional<CameraFrame> next(TimeNs timeout) override {
    if (camera_ == nullptr) return std::nullopt;
    pollfd waiting{dc1394_capture_get_fileno(camera_), POLLIN, 0};
    if (::poll(&waiting, 1, static_cast<int>(timeout / 1'000'000)) <= 0) return std::nullopt;
    if ((waiting.revents & (POLLHUP | POLLERR)) != 0) {
      gone_ = true;
      return std::nullopt;
    }
    dc1394video_frame_t* image = nullptr;
    if (dc1394_capture_dequeue(camera_, DC1394_CAPTURE_POLICY_POLL, &image) != DC1394_SUCCESS) gone_ = true;
    if (image == nullptr) return std::nullopt;
    CameraFrame frame;
    frame.arrival = steadyTime();
    frame.corrupt = dc1394_capture_is_frame_corrupt(camera_, image) == DC1394_TRUE;
    frame.bytes.assign(image->image, image->image + image->total_bytes);
    dc1394_capture_enqueue(camera_, image);
    return frame;
  }
  std::optional<CameraCycle> readCycle() override {
    std::uint32_t cycle = 0;
    std::uint64_t local_us = 0;
    if (camera_ == nullptr || dc1394_read_cycle_timer(camera_, &cycle, &local_us) != DC1394_SUCCESS)
      return std::nullopt;
    const auto bus = parseBusTime(cycle);
    if (!bus) return std::nullopt;
    return CameraCycle{*bus, static_cast<TimeNs>(local_us) * 1000 - realTimeOffset()};
  }
  void stop() override { close(); }
  bool isGone() const override { return gone_; }

 private:
  void close() {
    if (camera_ == nullptr) return;
    dc1394_video_set_transmission(camera_, DC1394_OFF);
    dc1394_capture_stop(camera_);
    dc1394_camera_free(camera_);
    camera_ = nullptr;
  }

  std::uint64_t guid_;
  std::string model_;
  dc1394_t* library_;
  dc1394camera_t* camera_ = nullptr;
  bool gone_ = true;
};

}  // namespace

std::unique_ptr<FrameSource> makeBusCamera(const std::string& guid, const std::string& model, std::string& /*error*/) {
  return std::make_unique<BusCamera>(guid, model);
}

}  // namespace segway_drivers

#else

namespace segway_drivers {

std::unique_ptr<FrameSource> makeBusCamera(const std::string& /*guid*/, const std::string& /*model*/,
                                           std::string& error) {
  error = "built without libdc1394";
  return nullptr;
}

}  // namespace segway_drivers

#endif
