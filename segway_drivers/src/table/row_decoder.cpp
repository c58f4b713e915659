// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/table/row_decoder.hpp"

#include <algorithm>

#include "table/rows.hpp"
#include "urban_nav_core/types/error.hpp"

namespace segway_drivers {

namespace {

using RowMaker = std::unique_ptr<RowDecoder> (*)(const Parameters& parameters, RowDecoder::Sink sink);
using ImageRowMaker = std::unique_ptr<RowDecoder> (*)(const Parameters& parameters, const ImageFolder& images,
                                                      RowDecoder::Sink sink);

struct RowKind {
  std::string name, columns;
  RowMaker make = nullptr;
  ImageRowMaker make_with_images = nullptr;  // instead of make
};

const std::vector<RowKind>& rowKinds() {
  static const std::vector<RowKind> kinds = {
      {"lms291", "index,status,ranges,reflectivities", makeLmsRows, nullptr},
      {"xsens_mti",
       "counter,sample_time_fine,ax,ay,az,gx,gy,gz,mx,my,mz,qw,qx,qy,qz,temperature_c,pressure_pa,latitude_deg,"
       "longitude_deg,height_m",
       makeMtiRows, nullptr},
      {"segway_rmp", "id,v0,v1,v2,v3", makeRmpRows, nullptr},
      {"segway_rmp_can", "id,v0,v1,v2,v3", makeCandumpRows, nullptr},
      {"gps",
       "utc,mode,latitude_deg,longitude_deg,height_ellipsoid_m,sigma_e_m,sigma_n_m,sigma_u_m,speed_mps,track_deg,"
       "climb_mps,satellites,source",
       makeGpsRows, nullptr},
      {"bumblebee2", "cycle_s,sequence,shutter_s,gain_db,left,right", nullptr, makeBb2Rows},
      {"ladybug2", "cycle_s,sequence,bad_channels,camera0,camera1,camera2,camera3,camera4", nullptr, makeLadybugRows}};
  return kinds;
}

const RowKind& findRowKind(const std::string& kind) {
  const auto& kinds = rowKinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const RowKind& each) { return each.name == kind; });
  if (found != kinds.end()) return *found;
  std::string allowed;
  for (const RowKind& each : kinds) allowed += (allowed.empty() ? "" : ", ") + each.name;
  throw urban_nav_core::UserError("KIND", kind, allowed);
}

}  // namespace

const std::vector<std::string>& deviceKinds() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const RowKind& each : rowKinds()) list.push_back(each.name);
    return list;
  }();
  return names;
}

std::string rowColumns(const std::string& kind) { return findRowKind(kind).columns; }

std::unique_ptr<RowDecoder> makeRowDecoder(const std::string& kind, const Parameters& parameters,
                                           const ImageFolder& images, RowDecoder::Sink sink) {
  const RowKind& found = findRowKind(kind);
  return found.make != nullptr ? found.make(parameters, std::move(sink))
                               : found.make_with_images(parameters, images, std::move(sink));
}

}  // namespace segway_drivers
