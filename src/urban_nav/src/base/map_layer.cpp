// SPDX-License-Identifier: BSD-3-Clause
#include "base/map_layer.hpp"

#include "base/page.hpp"

namespace urban_nav {

std::string renderMapLayer(std::size_t number, const std::string& name, const std::vector<unsigned char>& kinds,
                           const std::vector<std::array<int, 3>>& colours) {
  std::string list;
  for (const std::array<int, 3>& colour : colours)
    list += (list.empty() ? "[" : ",[") + std::to_string(colour[0]) + "," + std::to_string(colour[1]) + "," +
            std::to_string(colour[2]) + "]";
  const std::string id = "map-layer-" + std::to_string(number) + "-" + name;
  return "<script type=\"application/octet-stream\" id=\"" + id + "\">" + base64(kinds) +
         "</script>\n<script>((view, layer) => { if (view && view.addLayer) view.addLayer(\"" + name +
         "\", layer.textContent, [" + list + "]); })(document.getElementById(\"map-view-" + std::to_string(number) +
         "\"), document.getElementById(\"" + id + "\"));</script>";
}

}  // namespace urban_nav
