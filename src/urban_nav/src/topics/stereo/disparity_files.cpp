// SPDX-License-Identifier: BSD-3-Clause
#include "topics/stereo/disparity_files.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "topics/stereo/disparity_picture.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/cloud/ply_writer.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using dense_stereo::DisparityImage;
using urban_nav_core::StereoCamera;
using urban_nav_core::UserError;

namespace {

std::string fileExtension(const std::string& path) { return std::filesystem::path(path).extension().string(); }

/// Portable float map: rows from the bottom up, little endian.
void writePfm(const std::string& path, const DisparityImage& image, const std::vector<float>& values) {
  std::string content = "Pf\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n-1.0\n";
  std::vector<float> row(static_cast<std::size_t>(image.width));
  for (int v = image.height - 1; v >= 0; --v) {
    for (int u = 0; u < image.width; ++u)
      row[static_cast<std::size_t>(u)] =
          image.isValid(u, v) ? values[image.index(u, v)] : std::numeric_limits<float>::quiet_NaN();
    content.append(reinterpret_cast<const char*>(row.data()), row.size() * sizeof(float));
  }
  urban_nav_core::writeAtomically(path, content);
}

void writeColours(const std::string& path, const DisparityImage& image) {
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".png", drawDisparities(image), bytes)) throw UserError(path, "cannot be encoded", "");
  urban_nav_core::writeAtomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

struct PlyVertex {
  float xyz[3];
  float sigma_z;
  std::uint8_t grey;
};

void writePoints(const std::string& path, const DisparityImage& image, const urban_nav_core::ImageView& left,
                 const StereoCamera& camera) {
  std::string body;
  std::size_t count = 0;
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u) {
      if (!image.isValid(u, v)) continue;
      const double d = static_cast<double>(image.disparity[image.index(u, v)]);
      const StereoCamera::Pixel pixel(u, v, u - d);
      const auto point = camera.triangulate(pixel);
      if (!point || !point->allFinite()) continue;
      const double sigma_d = std::sqrt(static_cast<double>(image.variance[image.index(u, v)]));
      const double sigma_z = sigma_d * point->z() / (d - camera.disparity_offset);
      const PlyVertex vertex{
          {static_cast<float>(point->x()), static_cast<float>(point->y()), static_cast<float>(point->z())},
          static_cast<float>(sigma_z),
          left.at(u, v)};
      body.append(reinterpret_cast<const char*>(vertex.xyz), sizeof vertex.xyz);
      body.append(reinterpret_cast<const char*>(&vertex.sigma_z), sizeof vertex.sigma_z);
      body.push_back(static_cast<char>(vertex.grey));
      ++count;
    }
  using urban_nav_core::PlyType;
  const urban_nav_core::PlyLayout layout{{{"x", PlyType::Float},
                                          {"y", PlyType::Float},
                                          {"z", PlyType::Float},
                                          {"sigma_z", PlyType::Float},
                                          {"intensity", PlyType::UChar}},
                                         {"left optical frame, m"}};
  urban_nav_core::writeAtomically(path, urban_nav_core::plyHeader(layout, count) + body);
}

}  // namespace

void checkDisparityName(const std::string& path, const std::string& option) {
  const std::string ending = fileExtension(path);
  if (ending != ".pfm" && ending != ".png" && ending != ".ply")
    throw UserError(option, path, "a name that ends in .pfm, .png or .ply");
}

void writeDisparity(const std::string& path, const DisparityImage& image, const urban_nav_core::ImageView& left,
                    const StereoCamera& camera) {
  const std::string ending = fileExtension(path);
  if (ending == ".pfm") writePfm(path, image, image.disparity);
  else if (ending == ".png") writeColours(path, image);
  else writePoints(path, image, left, camera);
}

void writeVariance(const std::string& path, const DisparityImage& image) { writePfm(path, image, image.variance); }

}  // namespace urban_nav
