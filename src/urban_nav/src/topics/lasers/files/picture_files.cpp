// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/files/picture_files.hpp"

#include <opencv2/imgcodecs.hpp>

#include "topics/lasers/files/geotiff.hpp"
#include "topics/lasers/map_export.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_core::Vector3d;

namespace {

constexpr double kOrthoMargin = 30.0;  // m around the path, before cropping
constexpr int kLongestOrtho = 16000;   // px

}  // namespace

Orthophoto::Orthophoto(const MapAxes& axes, const std::vector<Vector3d>& path)
    : axes_(axes),
      view_(laser_mapper::viewFromAbove(axes.place(path), kOrthoMargin * axes.scale(), kLongestOrtho)),
      picture_(view_) {}

Vector3d Orthophoto::cornerAt(double u, double v) const {
  return view_.T_camera_map.inverse() *
         Vector3d((u - 0.5 * view_.width) / view_.px_per_m, (v - 0.5 * view_.height) / view_.px_per_m, 0.0);
}

void Orthophoto::writePng(const std::string& path) const {
  const laser_mapper::PictureBox box = picture_.shownBox();
  const urban_nav_registration::Picture picture = picture_.finish(box);
  const cv::Mat image(picture.height, picture.width, CV_8UC3, const_cast<std::uint8_t*>(picture.bgr.data()));
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".png", image, bytes)) throw urban_nav_core::DataError(path, "cannot be encoded", "");
  urban_nav_core::writeAtomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  writeWorldFile(path, axes_, 1.0 / view_.px_per_m, cornerAt(box.u0, box.v0));
}

void Orthophoto::writeTiff(const std::string& path) const {
  const laser_mapper::PictureBox box = picture_.shownBox();
  const Vector3d corner = cornerAt(box.u0, box.v0) + axes_.offset();
  ImagePlacement placement{box.width, box.height, corner.x(), corner.y(), 1.0 / view_.px_per_m};
  if (!axes_.areOfMap()) {
    placement.epsg = axes_.crs()->epsg();
    placement.crs = axes_.crs()->name();
  }
  writeGeoTiff(path, placement, picture_.finishRgba(box));
}

void writeWorldFile(const std::string& image, const MapAxes& axes, double pixel, const Vector3d& corner) {
  const Vector3d first = corner + axes.offset() + Vector3d(0.5 * pixel, -0.5 * pixel, 0.0);
  std::string world;
  for (const double value : {pixel, 0.0, 0.0, -pixel, first.x(), first.y()})
    world += urban_nav_core::printNumber(value) + "\n";
  urban_nav_core::writeAtomically(withExtension(image, ".pgw"), world);
  if (!axes.areOfMap()) urban_nav_core::writeAtomically(withExtension(image, ".prj"), axes.crs()->esriWkt() + "\n");
}

}  // namespace urban_nav
