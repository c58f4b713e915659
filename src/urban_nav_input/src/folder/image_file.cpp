// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/folder/image_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <string_view>
#include <vector>

#include "urban_nav_core/io/image_header.hpp"
#include "urban_nav_core/io/memory_limit.hpp"

namespace urban_nav_input {

using urban_nav_ros::GreyImage;

namespace {

std::string_view asText(const std::vector<char>& bytes) { return {bytes.data(), bytes.size()}; }

bool startsWith(const std::vector<char>& bytes, std::string_view magic) {
  return asText(bytes).substr(0, magic.size()) == magic;
}

/// Returns whether a PNG or JPEG has its end marker. (Cameras may append a few bytes to a JPEG: the marker is searched
/// in the last kilobyte.)
bool isComplete(const std::vector<char>& bytes) {
  const std::string_view text = asText(bytes);
  const std::string_view tail = text.substr(text.size() > 1024 ? text.size() - 1024 : 0);
  if (startsWith(bytes, "\x89PNG")) return tail.find("IEND") != std::string_view::npos;
  if (startsWith(bytes, "\xff\xd8")) return tail.find("\xff\xd9") != std::string_view::npos;
  return true;
}

}  // namespace

GreyImage readPixels(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) return {{}, path + ": cannot be opened"};
  std::error_code no_size;
  if (std::filesystem::file_size(path, no_size) > urban_nav_core::largestPiece() && !no_size)
    return {{}, path + ": a file of more than " + std::to_string(urban_nav_core::largestPiece() >> 20U) + " MB"};
  const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (bytes.empty()) return {{}, path + ": empty file"};
  if (!isComplete(bytes)) return {{}, path + ": ends early (" + std::to_string(bytes.size()) + " bytes)"};
  if (const std::string fault = urban_nav_core::imageFault(asText(bytes)); !fault.empty())
    return {{}, path + ": not a decodable image: " + fault};
  try {
    cv::Mat pixels = cv::imdecode(bytes, cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR);
    if (pixels.empty()) return {{}, path + ": not a decodable image"};
    return {pixels, {}};
  } catch (const cv::Exception& error) {
    return {{}, path + ": not a decodable image (" + error.err + ")"};
  }
}

urban_nav_ros::GreyScale sampleGreyScale(const std::vector<std::string>& paths) {
  constexpr std::size_t kSampled = 40;
  urban_nav_ros::GreyRange range;
  for (std::size_t i = 0; i < std::min(kSampled, paths.size()); ++i) {
    const GreyImage image = readPixels(paths[i]);
    if (image.pixels.empty()) continue;
    if (image.pixels.depth() != CV_16U) break;  // then usually the others are not either
    range.add(urban_nav_ros::toDeepGrey(image.pixels).pixels);
  }
  return range.scale();
}

GreyImage readGrey(const std::string& path, const urban_nav_ros::GreyScale& scale) {
  GreyImage image = readPixels(path);
  if (image.pixels.empty()) return image;
  GreyImage grey = urban_nav_ros::toGrey(image.pixels, scale);
  if (!grey.fault.empty()) grey.fault = path + ": " + grey.fault;
  return grey;
}

std::pair<urban_nav_core::ImageView, std::shared_ptr<const void>> sharedView(const cv::Mat& grey) {
  if (grey.empty()) return {};
  auto owner = std::make_shared<const cv::Mat>(grey);
  return {urban_nav_ros::toView(*owner), owner};
}

bool isImageName(const std::string& name) {
  static constexpr std::array<std::string_view, 9> kKnown = {".png", ".jpg", ".jpeg", ".pgm", ".pnm",
                                                             ".ppm", ".bmp", ".tif",  ".tiff"};
  std::string extension = std::filesystem::path(name).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(kKnown.begin(), kKnown.end(), extension) != kKnown.end();
}

}  // namespace urban_nav_input
