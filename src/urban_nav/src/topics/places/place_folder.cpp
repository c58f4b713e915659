// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <filesystem>

#include "topics/places/place_source.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/io/text.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/folder/image_file.hpp"
#include "urban_nav_input/recording/recording.hpp"

namespace urban_nav {

namespace fs = std::filesystem;
using urban_nav_core::StampNs;
using urban_nav_core::UserError;

namespace {

/// Subfolders of the left images in stereo folders.
constexpr std::array<const char*, 4> kLeftFolders = {"image_0", "image_00/data", "image_00", "mav0/cam0/data"};

std::vector<std::string> imagesIn(const fs::path& folder) {
  std::vector<std::string> paths;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (urban_nav_input::isImageName(entry.path().filename().string())) paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end(), [](const std::string& a, const std::string& b) {
    return urban_nav_core::isNaturallyLess(fs::path(a).filename().string(), fs::path(b).filename().string());
  });
  return paths;
}

std::vector<StampNs> readTimes(const std::string& path, std::size_t images) {
  std::vector<StampNs> stamps;
  urban_nav_core::forEachTime(urban_nav_core::readTextFile(path), path,
                              [&stamps](std::string_view, StampNs stamp, const std::string& where) {
                                if (!stamps.empty() && stamp < stamps.back())
                                  throw UserError(where, "a time before the previous one", "times in ascending order");
                                stamps.push_back(stamp);
                              });
  if (stamps.size() != images)
    throw UserError(path, std::to_string(stamps.size()) + " times", std::to_string(images) + ", one for each image");
  return stamps;
}

class PlaceFolder : public PlaceSource {
 public:
  explicit PlaceFolder(const std::string& path) : path_(path), images_(imagesIn(path)) {
    fs::path times = fs::path(path) / "times.txt";
    for (const char* left : kLeftFolders) {
      if (!images_.empty()) break;
      images_ = imagesIn(fs::path(path) / left);
      if (!images_.empty()) notes_.push_back(path + ": left images, " + left);
    }
    if (images_.empty())
      throw UserError(path, "no images",
                      "a folder of images (png, jpg, pgm, ppm, bmp, tif), a stereo folder, or a bag");
    scale_ = urban_nav_input::sampleGreyScale(images_);
    if (fs::exists(times)) stamps_ = readTimes(times.string(), images_.size());
    for (std::size_t i = stamps_.size(); i < images_.size(); ++i)
      stamps_.push_back(static_cast<StampNs>(i) * 1'000'000'000);
  }

  const std::string& path() const override { return path_; }
  std::size_t expected() const override { return images_.size(); }
  const std::vector<std::string>& notes() const override { return notes_; }

  std::optional<PlaceImages> next() override {
    if (at_ == images_.size()) return std::nullopt;
    urban_nav_ros::GreyImage image = urban_nav_input::readGrey(images_[at_], scale_);
    if (!image.fault.empty()) notes_.push_back(image.fault);
    return PlaceImages{stamps_[at_++], {std::move(image.pixels)}};
  }

 private:
  std::string path_;
  std::vector<std::string> images_;
  std::vector<StampNs> stamps_;
  std::vector<std::string> notes_;
  urban_nav_ros::GreyScale scale_;
  std::size_t at_ = 0;
};

}  // namespace

std::unique_ptr<PlaceSource> openPlaceFolder(const std::string& path) { return std::make_unique<PlaceFolder>(path); }

std::unique_ptr<PlaceSource> openPlaceSource(const std::string& path, const std::vector<std::string>& topics) {
  if (!fs::exists(path)) throw UserError(path, "does not exist", "a folder of images or a recording");
  if (fs::is_directory(path) && !urban_nav_input::isRecording(path)) return openPlaceFolder(path);
  return openPlaceBag(path, topics);
}

}  // namespace urban_nav
