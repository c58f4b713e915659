// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/files/geotiff.hpp"

#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_core::UserError;

namespace {

// Tags of GeoTIFF and of GDAL, https://gdal.org/drivers/raster/gtiff.html.
constexpr std::uint32_t kPixelScale = 33550, kTiepoint = 33922, kGeoKeys = 34735, kGeoAscii = 34737;
constexpr std::uint32_t kGdalMetadata = 42112, kGdalNoData = 42113;
// Keys of GeoTIFF and their values.
constexpr std::uint16_t kModelType = 1024, kRasterType = 1025, kCitation = 1026, kProjectedCrs = 3072,
                        kLinearUnits = 3076;
constexpr std::uint16_t kProjected = 1, kUserDefined = 32767, kPixelIsArea = 1, kMetre = 9001;
constexpr int kLargestCode = 65535;        // a GeoKey is 16 bits wide
constexpr std::uint32_t kStripRows = 32;   // rows per strip
constexpr double kLargestClassic = 2.0e9;  // bytes, of pixels; beyond, offsets may not fit into 32 bits
constexpr int kDeflateLevel = 6;

struct CloseTiff {
  void operator()(TIFF* file) const { TIFFClose(file); }
};
using TiffFile = std::unique_ptr<TIFF, CloseTiff>;

[[noreturn]] void throwUnwritable(const std::string& path) {
  throw UserError(path, std::string("cannot be written: ") + (errno != 0 ? std::strerror(errno) : "libtiff failed"),
                  "");
}

void addFields(TIFF* file) {
  static std::array<char, 6> names[] = {{"scale"}, {"tie"}, {"keys"}, {"text"}, {"meta"}, {"nodat"}};
  static const TIFFFieldInfo fields[] = {{kPixelScale, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, names[0].data()},
                                         {kTiepoint, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, names[1].data()},
                                         {kGeoKeys, -1, -1, TIFF_SHORT, FIELD_CUSTOM, 1, 1, names[2].data()},
                                         {kGeoAscii, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, names[3].data()},
                                         {kGdalMetadata, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, names[4].data()},
                                         {kGdalNoData, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, names[5].data()}};
  TIFFMergeFieldInfo(file, fields, static_cast<std::uint32_t>(std::size(fields)));
}

void setPlacement(TIFF* file, const ImagePlacement& placement) {
  const std::array<double, 3> scale = {placement.pixel, placement.pixel, 0.0};
  const std::array<double, 6> tie = {0.0, 0.0, 0.0, placement.west, placement.north, 0.0};
  const std::string citation = (placement.epsg > 0 ? placement.crs : "frame map of urban_nav, metres") + "|";
  std::vector<std::array<std::uint16_t, 4>> keys = {
      {kModelType, 0, 1, placement.epsg > 0 ? kProjected : kUserDefined},
      {kRasterType, 0, 1, kPixelIsArea},
      {kCitation, static_cast<std::uint16_t>(kGeoAscii), static_cast<std::uint16_t>(citation.size()), 0}};
  if (placement.epsg > 0) keys.push_back({kProjectedCrs, 0, 1, static_cast<std::uint16_t>(placement.epsg)});
  keys.push_back({kLinearUnits, 0, 1, kMetre});
  std::vector<std::uint16_t> directory = {1, 1, 0, static_cast<std::uint16_t>(keys.size())};
  for (const auto& key : keys) directory.insert(directory.end(), key.begin(), key.end());
  TIFFSetField(file, kPixelScale, static_cast<int>(scale.size()), scale.data());
  TIFFSetField(file, kTiepoint, static_cast<int>(tie.size()), tie.data());
  TIFFSetField(file, kGeoKeys, static_cast<int>(directory.size()), directory.data());
  TIFFSetField(file, kGeoAscii, citation.c_str());
}

/// Opens a file and sets the tags that all images have.
TiffFile openTiff(const std::string& path, const ImagePlacement& placement, int samples, int bits) {
  TIFFSetErrorHandler(nullptr);  // errors are thrown
  TIFFSetWarningHandler(nullptr);
  errno = 0;
  const double bytes = static_cast<double>(placement.width) * placement.height * samples * (bits / 8.0);
  TiffFile file(TIFFOpen(path.c_str(), bytes > kLargestClassic ? "w8" : "w"));
  if (!file) throwUnwritable(path);
  addFields(file.get());
  TIFFSetField(file.get(), TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(placement.width));
  TIFFSetField(file.get(), TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(placement.height));
  TIFFSetField(file.get(), TIFFTAG_SAMPLESPERPIXEL, samples);
  TIFFSetField(file.get(), TIFFTAG_BITSPERSAMPLE, bits);
  TIFFSetField(file.get(), TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(file.get(), TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  TIFFSetField(file.get(), TIFFTAG_ROWSPERSTRIP, kStripRows);
  TIFFSetField(file.get(), TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
  TIFFSetField(file.get(), TIFFTAG_ZIPQUALITY, kDeflateLevel);
  setPlacement(file.get(), placement);
  return file;
}

/// Writes rows of equal size; the predictor of libtiff changes them in place.
template <typename Value>
void writeRows(TIFF* file, const std::string& path, const ImagePlacement& placement, const std::vector<Value>& values) {
  const std::size_t width = values.size() / static_cast<std::size_t>(placement.height);
  std::vector<Value> row(width);
  for (int v = 0; v < placement.height; ++v) {
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(width * static_cast<std::size_t>(v)), width, row.begin());
    if (TIFFWriteScanline(file, row.data(), static_cast<std::uint32_t>(v), 0) != 1) throwUnwritable(path);
  }
  if (TIFFFlush(file) != 1) throwUnwritable(path);
}

void checkCode(const ImagePlacement& placement) {
  if (placement.epsg > kLargestCode)
    throw UserError("--crs", "EPSG:" + std::to_string(placement.epsg), "for GeoTIFF a code up to 65535");
}

}  // namespace

void writeGeoTiff(const std::string& path, const ImagePlacement& placement, const std::vector<std::uint8_t>& rgba) {
  checkCode(placement);
  urban_nav_core::PartialFile partial(path);
  {
    const TiffFile file = openTiff(partial.path(), placement, 4, 8);
    const std::uint16_t alpha = EXTRASAMPLE_UNASSALPHA;
    TIFFSetField(file.get(), TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
    TIFFSetField(file.get(), TIFFTAG_EXTRASAMPLES, 1, &alpha);
    TIFFSetField(file.get(), TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL);
    writeRows(file.get(), path, placement, rgba);
  }
  partial.commit();
}

void writeGeoTiff(const std::string& path, const ImagePlacement& placement, const std::vector<float>& rows,
                  const std::string& layer, const std::string& unit) {
  checkCode(placement);
  urban_nav_core::PartialFile partial(path);
  {
    const TiffFile file = openTiff(partial.path(), placement, 1, 32);
    TIFFSetField(file.get(), TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    TIFFSetField(file.get(), TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
    TIFFSetField(file.get(), TIFFTAG_PREDICTOR, PREDICTOR_FLOATINGPOINT);
    TIFFSetField(file.get(), kGdalNoData,
                 urban_nav_core::printNumber(static_cast<double>(laser_mapper::kNoValue)).c_str());
    const std::string metadata = "<GDALMetadata>\n  <Item name=\"DESCRIPTION\" sample=\"0\" role=\"description\">" +
                                 layer + "</Item>\n  <Item name=\"UNITTYPE\" sample=\"0\" role=\"unittype\">" + unit +
                                 "</Item>\n</GDALMetadata>\n";
    TIFFSetField(file.get(), kGdalMetadata, metadata.c_str());
    writeRows(file.get(), path, placement, rows);
  }
  partial.commit();
}

}  // namespace urban_nav
