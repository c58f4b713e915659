// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/file_kind.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav_core {
namespace {

using namespace std::string_view_literals;

struct Signature {
  std::string_view bytes;
  const char* found;
};

// fbow: the number 55824124, DBoW3: 88877711233, both little endian (their sources).
constexpr std::array<Signature, 16> kSignatures = {{
    {"version https://git-lfs"sv, "is a pointer of Git LFS, not the file itself (`git lfs pull` fetches it)"},
    {"\xFC\xCE\x53\x03\0\0\0\0"sv, "is a vocabulary of fbow"},
    {"\x81\x3F\x86\xB1\x14\0\0\0"sv, "is a vocabulary of DBoW3"},
    {"SQLite format 3"sv, "is an SQLite database"},
    {"#ROSBAG"sv, "is a ROS 1 bag"},
    {"\x89MCAP"sv, "is an MCAP file"},
    {"\x1F\x8B"sv, "is compressed by gzip"},
    {"BZh"sv, "is compressed by bzip2"},
    {"\xFD"
     "7zXZ"sv,
     "is compressed by xz"},
    {"\x28\xB5\x2F\xFD"sv, "is compressed by zstd"},
    {"PK\x03\x04"sv, "is a ZIP archive"},
    {"\x89PNG"sv, "is an image (PNG)"},
    {"\xFF\xD8\xFF"sv, "is an image (JPEG)"},
    {"%PDF"sv, "is a PDF"},
    {"ply\n"sv, "is a point cloud (PLY)"},
    {"<!DOCTYPE html"sv, "is a page of HTML: a download that did not give the file"},
}};

/// Returns whether a text begins like a DBoW2 vocabulary: branching, depth, scoring and weighting in one line.
bool isDbow2Text(std::string_view content) {
  const auto words = splitBlanks(content.substr(0, std::min(content.find('\n'), content.size())));
  if (words.size() != 4 || content.find('\n') == std::string_view::npos) return false;
  constexpr std::array<std::pair<int, int>, 4> kRanges = {{{2, 50}, {1, 20}, {0, 5}, {0, 3}}};
  for (std::size_t i = 0; i < kRanges.size(); ++i) {
    const auto value = parseInteger(words[i]);
    if (!value || *value < kRanges[i].first || *value > kRanges[i].second) return false;
  }
  return true;
}

bool holds(std::string_view content, std::string_view word) { return content.find(word) != std::string_view::npos; }

}  // namespace

std::string describeForeignContent(std::string_view content) {
  if (content.empty()) return "is empty (0 bytes)";
  for (const Signature& each : kSignatures)
    if (content.substr(0, each.bytes.size()) == each.bytes) return each.found;
  if (isDbow2Text(content)) return "is a vocabulary of ORB-SLAM2 (DBoW2)";
  const std::string_view head = content.substr(0, 1024);
  if (holds(head, "vocabulary:") && holds(head, "k:")) return "is a vocabulary of DBoW2 or DBoW3 (YAML)";
  if (holds(head, "!!opencv-matrix"))
    return "is a matrix of OpenCV (YAML), such as openFABMAP's vocabularies and trees";
  if (holds(head, "%YAML")) return "is a YAML file";
  return {};
}

}  // namespace urban_nav_core
