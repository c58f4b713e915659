// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "segway_drivers/bumblebee2/factory_calibration.hpp"
#include "segway_drivers/bumblebee2/frame.hpp"
#include "segway_drivers/ladybug2/frame.hpp"
#include "table/rows.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace segway_drivers {

namespace {

/// Writes numbered images to the folder of the table.
class RowImages {
 public:
  explicit RowImages(ImageFolder folder) : folder_(std::move(folder)) {}

  /// Returns the name of the file.
  std::string write(std::int64_t frame, const std::string& name, const cv::Mat& image) const {
    const std::string file = folder_.stem + "_" + std::to_string(frame) + "_" + name + ".png";
    std::vector<std::uint8_t> png;
    cv::imencode(".png", image, png, {cv::IMWRITE_PNG_COMPRESSION, 1});
    urban_nav_core::writeAtomically((std::filesystem::path(folder_.folder) / file).string(),
                                    {reinterpret_cast<const char*>(png.data()), png.size()});
    return file;
  }

 private:
  ImageFolder folder_;
};

std::string busTimeCell(std::optional<double> time) {
  std::string cell;
  if (time) appendCell(cell, *time);
  return cell;
}

class Bb2Rows : public RowDecoder {
 public:
  Bb2Rows(const Parameters& parameters, ImageFolder images, Sink sink)
      : frames_(kBb2FrameSize + 1, probeBb2Frame),
        images_(std::move(images)),
        sink_(std::move(sink)),
        swap_(parameters.bumblebee2_swap_images),
        pattern_(parseMosaicPattern(parameters.bumblebee2_pattern).value_or(MosaicPattern::Bggr)) {
    if (parameters.bumblebee2_rectify != "factory") return;
    const std::string& file = parameters.bumblebee2_calibration;
    if (file.empty())
      throw urban_nav_core::UserError("segway_drivers.bumblebee2.calibration", "empty",
                                      "the file of the factory calibration");
    const FactoryCalibration calibration = parseFactoryCalibration(urban_nav_core::readTextFile(file), file);
    left_ = makeRectifyingMap(calibration.left, {kBb2Width, kBb2Height});
    right_ = makeRectifyingMap(calibration.right, {kBb2Width, kBb2Height});
  }
  void feed(ByteView chunk, const ChunkArrival& arrival) override {
    frames_.feed(chunk, arrival, [this](const StreamFrame& frame) { take(frame); });
  }
  void finish() override {
    frames_.finish([this](const StreamFrame& frame) { take(frame); });
  }
  DeviceCounters counters() const override { return frames_.counters(); }

 private:
  cv::Mat process(const cv::Mat& raw, const RectifyingMap& map) const {
    const cv::Mat image = demosaic(raw, pattern_);
    if (map.x.empty()) return image;
    cv::Mat rectified;
    cv::remap(image, rectified, map.x, map.y, cv::INTER_LINEAR);
    return rectified;
  }
  void take(const StreamFrame& raw) {
    const Bb2Frame frame = splitBb2Frame(raw.bytes, swap_, Bb2Embedding::Raw);
    // Counts of gain and shutter have no unit without the absolute registers of the camera.
    std::string cells = busTimeCell(frame.bus_time) + "," + std::to_string(frame.sequence) + ",,";
    cells += "," + images_.write(number_, "left", process(frame.left, left_));
    cells += "," + images_.write(number_, "right", process(frame.right, right_));
    ++number_;
    sink_({raw.offset, {}, cells});
  }

  FrameStream frames_;
  RowImages images_;
  Sink sink_;
  bool swap_;
  MosaicPattern pattern_;
  RectifyingMap left_, right_;
  std::int64_t number_ = 0;
};

class LadybugRows : public RowDecoder {
 public:
  LadybugRows(const Parameters& parameters, ImageFolder images, Sink sink)
      : frames_(kLadybugMaxFrame + 1, probeLadybugFrame),
        images_(std::move(images)),
        sink_(std::move(sink)),
        backward_(parameters.ladybug2_camera_order == "backward"),
        pattern_(parseMosaicPattern(parameters.ladybug2_pattern)) {}
  void feed(ByteView chunk, const ChunkArrival& arrival) override {
    frames_.feed(chunk, arrival, [this](const StreamFrame& frame) { take(frame); });
  }
  void finish() override {
    frames_.finish([this](const StreamFrame& frame) { take(frame); });
  }
  DeviceCounters counters() const override { return frames_.counters(); }

 private:
  void take(const StreamFrame& raw) {
    const auto frame = splitLadybugFrame(raw.bytes, backward_);
    if (!frame) return;
    const MosaicPattern pattern = pattern_ ? *pattern_ : frame->pattern.value_or(MosaicPattern::Bggr);
    std::string cells = busTimeCell(frame->bus_time) + "," + std::to_string(frame->sequence) + "," +
                        std::to_string(frame->bad_channels);
    for (std::size_t camera = 0; camera + 1 < kLadybugCameras; ++camera) {
      const cv::Mat image = decodeLadybugCamera(*frame, camera, pattern);
      cells += ",";
      if (!image.empty()) cells += images_.write(number_, "camera" + std::to_string(camera), image);
    }
    ++number_;
    sink_({raw.offset, {}, cells});
  }

  FrameStream frames_;
  RowImages images_;
  Sink sink_;
  bool backward_;
  std::optional<MosaicPattern> pattern_;
  std::int64_t number_ = 0;
};

}  // namespace

std::unique_ptr<RowDecoder> makeBb2Rows(const Parameters& parameters, const ImageFolder& images,
                                        RowDecoder::Sink sink) {
  return std::make_unique<Bb2Rows>(parameters, images, std::move(sink));
}

std::unique_ptr<RowDecoder> makeLadybugRows(const Parameters& parameters, const ImageFolder& images,
                                            RowDecoder::Sink sink) {
  return std::make_unique<LadybugRows>(parameters, images, std::move(sink));
}

}  // namespace segway_drivers
