// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/folder/new_college_files.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <optional>

#include "urban_nav_core/io/text.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/folder/image_file.hpp"

namespace urban_nav_input {

namespace fs = std::filesystem;
using urban_nav_core::StampNs;
using urban_nav_core::UserError;

namespace {

constexpr int kDepth = 3;
constexpr int kLadybugCameras = 5;

/// Returns "left" or "right" for "...-left.pnm"; empty for other names.
std::string findSide(const fs::path& path) {
  const std::string stem = path.stem().string();
  for (const char* side : {"left", "right"}) {
    if (urban_nav_core::endsWith(stem, side) && isImageName(path.filename().string())) return side;
  }
  return "";
}

/// Returns K of "ladybug_TIME-K.jpg"; -1 for other names.
int ladybugCamera(const fs::path& path) {
  const std::string name = path.filename().string(), stem = path.stem().string();
  if (name.rfind("ladybug_", 0) != 0 || stem.size() < 3 || stem[stem.size() - 2] != '-' || !isImageName(name))
    return -1;
  const int camera = stem.back() - '0';
  return camera >= 0 && camera < kLadybugCameras ? camera : -1;
}

}  // namespace

std::optional<StampNs> stampOfName(const std::string& name) {
  std::string stem = fs::path(name).stem().string();
  const std::size_t dash = stem.rfind('-');
  if (dash != std::string::npos) stem.resize(dash);
  std::size_t begin = stem.size();
  while (begin > 0 && (std::isdigit(static_cast<unsigned char>(stem[begin - 1])) != 0 || stem[begin - 1] == '.'))
    --begin;
  return urban_nav_core::parseStamp(std::string_view(stem).substr(begin));
}

NewCollegeFiles findNewCollege(const std::string& source) {
  NewCollegeFiles files;
  fs::path folder(source);
  if (!fs::exists(folder))
    throw UserError(source, "does not exist", "a folder of the New College data set, or its .alog file");
  if (!fs::is_directory(folder)) {
    files.alog = source;
    folder = fs::absolute(folder).parent_path();
  }
  std::map<StampNs, NewCollegeFiles::Pair> pairs;
  for (auto entry = fs::recursive_directory_iterator(folder); entry != fs::recursive_directory_iterator(); ++entry) {
    if (entry.depth() >= kDepth) entry.disable_recursion_pending();
    if (!entry->is_regular_file()) continue;
    const fs::path& path = entry->path();
    if (path.extension() == ".alog" && fs::is_directory(source)) {
      if (!files.alog.empty())
        throw UserError(source, "holds " + files.alog + " and " + path.string(),
                        "one log at a time: give the .alog file itself");
      files.alog = path.string();
    }
    const std::string side = findSide(path);
    const int camera = ladybugCamera(path);
    if (side.empty() && camera < 0) continue;
    const std::optional<StampNs> stamp = stampOfName(path.filename().string());
    if (!stamp) continue;
    if (camera >= 0) {
      files.panorama.push_back({*stamp, path.string(), camera});
    } else {
      NewCollegeFiles::Pair& pair = pairs[*stamp];
      pair.stamp = *stamp;
      (side == "left" ? pair.left : pair.right) = path.string();
    }
  }
  for (const auto& [stamp, pair] : pairs) files.stereo.push_back(pair);
  std::sort(files.panorama.begin(), files.panorama.end(),
            [](const auto& a, const auto& b) { return std::pair(a.stamp, a.camera) < std::pair(b.stamp, b.camera); });
  if (files.alog.empty() && files.panorama.empty() && files.stereo.empty()) {
    throw UserError(source, "contains no files of the New College data set",
                    "*.alog, ladybug_TIME-K.jpg, StereoImage__TIME-left.pnm");
  }
  return files;
}

}  // namespace urban_nav_input
