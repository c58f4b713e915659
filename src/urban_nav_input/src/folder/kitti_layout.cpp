// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/folder/kitti_layout.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <set>

#include "folder/text_lines.hpp"
#include "urban_nav_core/io/calibration.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/folder/image_file.hpp"

namespace urban_nav_input {

namespace fs = std::filesystem;
using urban_nav_core::atLine;
using urban_nav_core::KittiPair;
using urban_nav_core::StampNs;
using urban_nav_core::StereoCamera;
using urban_nav_core::UserError;

namespace {

constexpr double kUsualRate = 10.0;          // Hz, of the cameras of KITTI
constexpr std::int64_t kMostMissing = 1000;  // frames: more than that is another naming scheme

StampNs daysSince1970(int year, int month, int day) {  // Howard Hinnant, "chrono-compatible low-level date algorithms"
  year -= month <= 2 ? 1 : 0;
  const int era = (year >= 0 ? year : year - 399) / 400;
  const int year_of_era = year - era * 400;
  const int day_of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  const int day_of_era = year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year;
  return static_cast<StampNs>(era) * 146097 + day_of_era - 719468;
}

}  // namespace

std::optional<KittiLayout> findKittiLayout(const std::string& folder) {
  struct Names {
    const char *left, *right;
    KittiPair pair;
  };
  static constexpr std::array<Names, 4> kAll = {{{"image_0", "image_1", KittiPair::Grey},
                                                 {"image_00", "image_01", KittiPair::Grey},
                                                 {"image_2", "image_3", KittiPair::Colour},
                                                 {"image_02", "image_03", KittiPair::Colour}}};
  for (const Names& names : kAll) {
    const fs::path left = fs::path(folder) / names.left;
    const fs::path right = fs::path(folder) / names.right;
    if (!fs::is_directory(left) && !fs::is_directory(right)) continue;
    std::string inside;
    for (const char* name : {"data", "data_rect"})  // KITTI raw, KITTI-360
      if (inside.empty() && (fs::is_directory(left / name) || fs::is_directory(right / name))) inside = name;
    return KittiLayout{folder, (left / inside).string(), (right / inside).string(), names.pair};
  }
  return std::nullopt;
}

std::map<std::int64_t, std::string> listFrames(const std::string& folder) {
  std::map<std::int64_t, std::string> frames;
  if (!fs::is_directory(folder)) return frames;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string stem = entry.path().stem().string();
    const bool digits =
        !stem.empty() && std::all_of(stem.begin(), stem.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    const std::optional<std::int64_t> number = digits ? urban_nav_core::parseInteger(stem) : std::nullopt;
    if (number && isImageName(entry.path().filename().string())) frames[*number] = entry.path().string();
  }
  return frames;
}

std::string findKittiCalibration(const std::string& at) {
  const fs::path folder(at);
  const fs::path above = fs::absolute(folder / ".").lexically_normal().parent_path().parent_path();
  for (const fs::path& path : {folder / "calib.txt", folder / "calib_cam_to_cam.txt", above / "calib_cam_to_cam.txt",
                               folder / "perspective.txt", above.parent_path() / "calibration" / "perspective.txt"})
    if (fs::exists(path)) return path.string();
  return {};
}

StereoCamera readKittiCamera(const KittiLayout& layout, int width, int height) {
  const std::string path = findKittiCalibration(layout.folder);
  if (!path.empty()) return urban_nav_core::readKittiCalibration(path, width, height, layout.pair);
  throw UserError(
      (fs::path(layout.folder) / "calib.txt").string(), "does not exist",
      "calib.txt with rows P0 and P1, calib_cam_to_cam.txt, KITTI-360's calibration/perspective.txt, or --calibration "
      "FILE");
}

urban_nav_core::Vector3d readKittiOffset(const std::string& folder, KittiPair pair) {
  const std::string path = findKittiCalibration(folder);
  if (path.empty()) return urban_nav_core::Vector3d::Zero();
  return urban_nav_core::parseKittiOffset(urban_nav_core::readTextFile(path), path, pair)
      .value_or(urban_nav_core::Vector3d::Zero());
}

KittiTimes readKittiTimes(const KittiLayout& layout) {
  const fs::path folder(layout.folder);
  KittiTimes times;
  if (fs::exists(folder / "times.txt")) {
    times.path = (folder / "times.txt").string();
    urban_nav_core::forEachTime(urban_nav_core::readTextFile(times.path), times.path,
                                [&times](std::string_view /*word*/, StampNs stamp, const std::string& /*where*/) {
                                  times.stamps.push_back(stamp);
                                });
    return times;
  }
  const fs::path images(layout.left);
  for (const fs::path& path : {images / "timestamps.txt", images.parent_path() / "timestamps.txt"}) {
    if (!fs::exists(path)) continue;
    times.path = path.string();
    for (const TextLine& line : readLines(times.path)) {
      const std::optional<StampNs> stamp = parseDateTime(line.text);
      if (!stamp)
        throw UserError(atLine(times.path, line.number), "\"" + line.text + "\" is not a date and time",
                        "2011-09-26 13:02:25.964389445");
      times.stamps.push_back(*stamp);
    }
    return times;
  }
  return times;
}

void requireNumberedFrames(const std::string& folder, std::pair<std::int64_t, std::int64_t> numbers,
                           std::size_t count) {
  const auto [first, last] = numbers;
  if (last - first <= kMostMissing + 2 * static_cast<std::int64_t>(count)) return;
  throw UserError(folder,
                  "frames " + std::to_string(first) + " to " + std::to_string(last) + ", of which " +
                      std::to_string(count) + " are there",
                  "frames numbered one by one");
}

std::vector<StampNs> stampKittiFrames(const KittiLayout& layout, const std::string& what,
                                      std::pair<std::int64_t, std::int64_t> numbers, double rate,
                                      std::vector<std::string>& notes) {
  const auto [first, last] = numbers;
  const KittiTimes times = readKittiTimes(layout);
  const auto rows = static_cast<std::int64_t>(times.stamps.size());
  std::int64_t row_of_first = first;
  if (!times.path.empty() && last >= rows) {
    if (last - first + 1 != rows)
      throw UserError(
          times.path,
          std::to_string(rows) + " stamps for " + what + " " + std::to_string(first) + " to " + std::to_string(last),
          "one line for each image");
    row_of_first = 0;
  }
  const double step = 1e9 / (rate > 0.0 ? rate : kUsualRate);
  std::vector<StampNs> stamps;
  for (std::int64_t i = 0; i <= last - first; ++i)
    stamps.push_back(times.path.empty() ? static_cast<StampNs>(std::llround(static_cast<double>(i) * step))
                                        : times.stamps[static_cast<std::size_t>(row_of_first + i)]);
  if (times.path.empty() && rate <= 0.0) notes.push_back("no times.txt: taken as 10 Hz (override with --rate)");
  if (!times.path.empty() && row_of_first == first && last + 1 < rows)
    notes.push_back(times.path + " has " + std::to_string(rows) + " stamps, the " + what + " end at number " +
                    std::to_string(last));
  return stamps;
}

KittiFrames listKittiFrames(const KittiLayout& layout, double rate) {
  KittiFrames frames;
  frames.left = listFrames(layout.left);
  frames.right = listFrames(layout.right);
  if (frames.left.empty() && frames.right.empty())
    throw UserError(layout.left, "holds no images named by numbers", "000000.png, 000001.png, ...");
  std::set<std::int64_t> all;
  for (const auto& [number, path] : frames.left) all.insert(number);
  for (const auto& [number, path] : frames.right) all.insert(number);
  const std::int64_t first = *all.begin(), last = *all.rbegin();
  requireNumberedFrames(layout.left, {first, last}, all.size());
  for (std::int64_t number = first; number <= last; ++number) frames.numbers.push_back(number);
  frames.stamps = stampKittiFrames(layout, "images", {first, last}, rate, frames.notes);
  return frames;
}

std::optional<StampNs> parseDateTime(const std::string& text) {
  if (text.size() < 19 || text[4] != '-' || text[7] != '-' || (text[10] != ' ' && text[10] != 'T') || text[13] != ':' ||
      text[16] != ':')
    return std::nullopt;
  const auto field = [&](std::size_t begin, std::size_t size) {
    return urban_nav_core::parseInteger(std::string_view(text).substr(begin, size)).value_or(-1);
  };
  const std::int64_t year = field(0, 4), month = field(5, 2), day = field(8, 2), hour = field(11, 2),
                     minute = field(14, 2);
  const std::optional<StampNs> seconds = urban_nav_core::parseStamp(std::string_view(text).substr(17));
  if (year < 1900 || month < 1 || month > 12 || day < 1 || day > 31 || hour < 0 || hour > 23 || minute < 0 ||
      minute > 59 || !seconds)
    return std::nullopt;
  const StampNs days = daysSince1970(static_cast<int>(year), static_cast<int>(month), static_cast<int>(day));
  constexpr StampNs kMinuteNs = 60'000'000'000;
  return ((days * 24 + hour) * 60 + minute) * kMinuteNs + *seconds;
}

}  // namespace urban_nav_input
