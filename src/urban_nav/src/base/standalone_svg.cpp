// SPDX-License-Identifier: BSD-3-Clause
#include "base/standalone_svg.hpp"

#include <algorithm>

namespace urban_nav {

namespace {

constexpr int kSvgTitleHeight = 44;
constexpr const char* kStyle =
    "svg{font-family:sans-serif;background:#fff}.c-a{color:#1f6feb}.c-b{color:#d9480f}.c-c{color:#0c8599}.c-d{color:#"
    "9c36b5}.c-good{color:#2b8a3e}.c-plain{color:#5d6877}.grid{stroke:#ebe8e2}.tick{fill:#5d6877;font-size:11px}.label{"
    "fill:#5d6877;font-size:12px}.title{font-size:15px;font-weight:bold;fill:#1d2430}.name{font-size:12px;fill:"
    "currentColor}.line{fill:none;stroke:currentColor;stroke-width:1.9}.faint{stroke-width:0.8;opacity:0.4}.dashed{"
    "stroke-dasharray:6 "
    "4}.band{fill:currentColor;opacity:.18}.bar,.dot{fill:currentColor}";

std::string names(const Plot& plot, int y) {
  std::string svg;
  int x = 62;
  for (const Series& series : plot.series) {
    if (series.name.empty()) continue;
    svg += "<text class=\"name c-" + series.colour + "\" x=\"" + std::to_string(x) + "\" y=\"" + std::to_string(y) +
           "\">" + escapeHtml(series.name) + "</text>";
    x += 24 + 7 * static_cast<int>(series.name.size());
  }
  return svg;
}

}  // namespace

std::string standaloneSvg(const std::vector<std::pair<std::string, Plot>>& plots) {
  std::string body;
  int y = 0, width = 0;
  for (const auto& [title, plot] : plots) {
    body += "<text class=\"title\" x=\"62\" y=\"" + std::to_string(y + 20) + "\">" + escapeHtml(title) + "</text>" +
            names(plot, y + 38);
    body += "<g transform=\"translate(0 " + std::to_string(y + kSvgTitleHeight) + ")\"><svg width=\"" +
            std::to_string(plot.width) + "\" height=\"" + std::to_string(plot.height) + "\">" + renderSvg(plot, false) +
            "</svg></g>";
    y += kSvgTitleHeight + plot.height;
    width = std::max(width, plot.width);
  }
  const std::string size = std::to_string(width) + " " + std::to_string(y);
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + size +
         "\" width=\"" + std::to_string(width) + "\" height=\"" + std::to_string(y) + "\"><style>" + kStyle +
         "</style><rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>" + body + "</svg>\n";
}

}  // namespace urban_nav
