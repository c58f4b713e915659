// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/georeference/map_projection.hpp"

#include <proj.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "urban_nav_core/types/error.hpp"

namespace laser_mapper {

using urban_nav_core::UserError;

namespace {

constexpr double kToDegrees = 180.0 / M_PI;
constexpr double kPolarLimit = 84.0;  // deg

struct DestroyProj {
  void operator()(PJ* object) const { proj_destroy(object); }
};
struct DestroyContext {
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
using ProjObject = std::unique_ptr<PJ, DestroyProj>;

bool isInMetres(PJ_CONTEXT* context, PJ* crs) {
  const ProjObject axes(proj_crs_get_coordinate_system(context, crs));
  if (!axes || proj_cs_get_axis_count(context, axes.get()) != 2) return false;
  for (int axis = 0; axis < 2; ++axis) {
    double metres = 0.0;
    if (proj_cs_get_axis_info(context, axes.get(), axis, nullptr, nullptr, nullptr, &metres, nullptr, nullptr,
                              nullptr) == 0 ||
        metres != 1.0)
      return false;
  }
  return true;
}

}  // namespace

struct MapProjection::Proj {
  std::unique_ptr<PJ_CONTEXT, DestroyContext> context{proj_context_create()};
  ProjObject transformation;
};

int utmZoneCode(const Geodetic& position) {
  const double latitude = kToDegrees * position.latitude;
  if (std::abs(latitude) > kPolarLimit) return 0;
  const double longitude = std::remainder(kToDegrees * position.longitude, 360.0);
  const int zone = std::min(60, static_cast<int>(std::floor((longitude + 180.0) / 6.0)) + 1);
  return (latitude < 0.0 ? 32700 : 32600) + zone;
}

MapProjection::MapProjection(int epsg, const std::string& option) : proj_(std::make_unique<Proj>()) {
  PJ_CONTEXT* context = proj_->context.get();
  proj_log_level(context, PJ_LOG_NONE);
  const std::string code = "EPSG:" + std::to_string(epsg);
  const ProjObject crs(proj_create(context, code.c_str()));
  if (!crs || proj_get_type(crs.get()) != PJ_TYPE_PROJECTED_CRS || !isInMetres(context, crs.get()))
    throw UserError(option, code + " is not a projected coordinate system in metres known to PROJ",
                    "auto, or the code of such a system: EPSG:32630");
  const char* text = proj_as_wkt(context, crs.get(), PJ_WKT1_GDAL, nullptr);
  const ProjObject raw(proj_create_crs_to_crs(context, "EPSG:4979", code.c_str(), nullptr));
  if (text == nullptr || !raw) throw UserError(option, code + " cannot be written as WKT", "another system");
  wkt_ = text;
  const char* esri_text = proj_as_wkt(context, crs.get(), PJ_WKT1_ESRI, nullptr);
  esri_wkt_ = esri_text == nullptr ? wkt_ : esri_text;
  name_ = proj_get_name(crs.get());
  proj_->transformation.reset(proj_normalize_for_visualization(context, raw.get()));
}

MapProjection::~MapProjection() = default;

Eigen::Vector3d MapProjection::project(const Geodetic& position) const {
  const PJ_COORD from = proj_coord(kToDegrees * position.longitude, kToDegrees * position.latitude, position.height,
                                   std::numeric_limits<double>::infinity());
  const PJ_COORD to = proj_trans(proj_->transformation.get(), PJ_FWD, from);
  if (!std::isfinite(to.xyz.x) || !std::isfinite(to.xyz.y))
    throw urban_nav_core::DataError("--crs " + name_, "the map lies outside the area of this system", "auto");
  return {to.xyz.x, to.xyz.y, position.height};
}

Geodetic MapProjection::unproject(const Eigen::Vector3d& p) const {
  const PJ_COORD from = proj_coord(p.x(), p.y(), p.z(), std::numeric_limits<double>::infinity());
  const PJ_COORD to = proj_trans(proj_->transformation.get(), PJ_INV, from);
  if (!std::isfinite(to.lpz.lam) || !std::isfinite(to.lpz.phi))
    throw urban_nav_core::DataError("--crs " + name_, "a point lies outside the area of this system", "");
  return {to.lpz.phi / kToDegrees, to.lpz.lam / kToDegrees, p.z()};
}

}  // namespace laser_mapper
