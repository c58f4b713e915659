// SPDX-License-Identifier: BSD-3-Clause
#include "base/plot.hpp"
#include "urban_nav_core/io/format_number.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace urban_nav {

namespace {

constexpr std::size_t kMostPoints = 1200;  // per line: about two per pixel at full width
constexpr double kPlotLeft = 62, kPlotRight = 14, kPlotTop = 12, kPlotBottom = 44;

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool empty() const { return !(low <= high); }
  double span() const { return high - low; }
};

struct PlotFrame {  // maps values to px
  Range x, y;
  double width = 0, height = 0;
  double u(double value) const { return kPlotLeft + (value - x.low) / x.span() * (width - kPlotLeft - kPlotRight); }
  double v(double value) const {
    return height - kPlotBottom - (value - y.low) / y.span() * (height - kPlotTop - kPlotBottom);
  }
};

std::string px(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

bool finite(const PlotPoint& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

/// Returns at most kMostPoints indices: the first, lowest and highest point of each bucket, in order.
std::vector<std::size_t> thinned(const std::vector<PlotPoint>& points) {
  std::vector<std::size_t> kept;
  if (points.size() <= kMostPoints) {
    for (std::size_t i = 0; i < points.size(); ++i) kept.push_back(i);
    return kept;
  }
  const std::size_t buckets = kMostPoints / 3;
  for (std::size_t b = 0; b < buckets; ++b) {
    const std::size_t begin = b * points.size() / buckets, end = (b + 1) * points.size() / buckets;
    std::size_t low = begin, high = begin;
    for (std::size_t i = begin; i < end; ++i) {
      if (!(points[i].y >= points[low].y)) low = i;
      if (!(points[i].y <= points[high].y)) high = i;
    }
    std::vector<std::size_t> some = {begin, low, high};
    std::sort(some.begin(), some.end());
    some.erase(std::unique(some.begin(), some.end()), some.end());
    kept.insert(kept.end(), some.begin(), some.end());
  }
  kept.push_back(points.size() - 1);
  return kept;
}

PlotFrame makePlotFrame(const Plot& plot) {
  PlotFrame frame;
  frame.width = plot.width;
  frame.height = plot.height;
  for (const Series& series : plot.series) {
    for (std::size_t i = 0; i < series.points.size(); ++i) {
      const PlotPoint& p = series.points[i];
      if (!finite(p)) continue;
      frame.x.add(p.x - 0.5 * series.bar_width);
      frame.x.add(p.x + 0.5 * series.bar_width);
      frame.y.add(p.y);
      if (i < series.lower.size()) frame.y.add(series.lower[i]);
      if (series.kind == Series::Kind::Bars) frame.y.add(0.0);
    }
  }
  if (frame.x.empty()) return frame;
  if (plot.y_from_zero) frame.y.add(0.0);
  if (plot.y_top) frame.y.high = std::max(frame.y.low + 1e-9, std::min(frame.y.high, *plot.y_top));
  const auto widen = [](Range& range, double least) {
    if (range.span() < least) {
      const double middle = 0.5 * (range.low + range.high);
      range.low = middle - 0.5 * least;
      range.high = middle + 0.5 * least;
    }
  };
  widen(frame.x, 1e-6);
  widen(frame.y, 1e-9);
  const bool bottom_fixed = plot.y_from_zero && frame.y.low == 0.0;
  const double margin = 0.06 * frame.y.span();
  frame.y.high += margin;
  if (!bottom_fixed) frame.y.low -= margin;
  if (plot.equal_axes) {
    const double margin_x = 0.04 * frame.x.span();
    frame.x.low -= margin_x;
    frame.x.high += margin_x;
    const double across = frame.width - kPlotLeft - kPlotRight, up = frame.height - kPlotTop - kPlotBottom;
    const double metre = std::max({frame.x.span() / across, frame.y.span() / up, 1e-6});
    widen(frame.x, metre * across);
    widen(frame.y, metre * up);
  }
  return frame;
}

std::string axes(const Plot& plot, const PlotFrame& f) {
  std::string svg;
  const double bottom = f.height - kPlotBottom, right = f.width - kPlotRight;
  for (const double tick : niceTicks(f.x.low, f.x.high, plot.width / 90)) {
    const std::string u = px(f.u(tick));
    svg += "<line class=\"grid\" x1=\"" + u + "\" y1=\"" + px(kPlotTop) + "\" x2=\"" + u + "\" y2=\"" + px(bottom) +
           "\"/>";
    svg += "<text class=\"tick\" x=\"" + u + "\" y=\"" + px(bottom + 16) + "\" text-anchor=\"middle\">" +
           urban_nav_core::formatNumber(tick, 6) + "</text>";
  }
  for (const double tick : niceTicks(f.y.low, f.y.high, plot.y_label.empty() ? 0 : plot.height / 55)) {
    const std::string v = px(f.v(tick));
    svg += "<line class=\"grid\" x1=\"" + px(kPlotLeft) + "\" y1=\"" + v + "\" x2=\"" + px(right) + "\" y2=\"" + v +
           "\"/>";
    svg += "<text class=\"tick\" x=\"" + px(kPlotLeft - 7) + "\" y=\"" + px(f.v(tick) + 4) + "\" text-anchor=\"end\">" +
           urban_nav_core::formatNumber(tick, 6) + "</text>";
  }
  svg += "<text class=\"label\" x=\"" + px(0.5 * (kPlotLeft + right)) + "\" y=\"" + px(f.height - 8) +
         "\" text-anchor=\"middle\">" + escapeHtml(plot.x_label) + "</text>";
  svg += "<text class=\"label\" transform=\"translate(14 " + px(0.5 * (kPlotTop + bottom)) +
         ") rotate(-90)\" text-anchor=\"middle\">" + escapeHtml(plot.y_label) + "</text>";
  return svg;
}

std::string makePath(const Series& series, const PlotFrame& f) {
  std::string d;
  bool pen_down = false;
  for (const std::size_t i : thinned(series.points)) {
    const PlotPoint& p = series.points[i];
    if (!finite(p)) {
      pen_down = false;
      continue;
    }
    d += (pen_down ? "L" : "M") + px(f.u(p.x)) + " " + px(f.v(p.y));
    pen_down = true;
  }
  return d;
}

std::string drawBand(const Series& series, const PlotFrame& f) {
  std::string there, back;
  for (const std::size_t i : thinned(series.points)) {
    const PlotPoint& p = series.points[i];
    if (!finite(p) || i >= series.lower.size() || !std::isfinite(series.lower[i])) continue;
    there += (there.empty() ? "M" : "L") + px(f.u(p.x)) + " " + px(f.v(p.y));
    back = "L" + px(f.u(p.x)) + " " + px(f.v(series.lower[i])) + back;
  }
  return there.empty() ? "" : "<path class=\"band c-" + series.colour + "\" d=\"" + there + back + "Z\"/>";
}

std::string drawBars(const Series& series, const PlotFrame& f) {
  std::string svg;
  for (const PlotPoint& p : series.points) {
    if (!finite(p) || p.y <= 0.0) continue;
    const double left = f.u(p.x - 0.5 * series.bar_width), right = f.u(p.x + 0.5 * series.bar_width);
    svg += "<rect class=\"bar c-" + series.colour + "\" x=\"" + px(left + 0.5) + "\" y=\"" + px(f.v(p.y)) +
           "\" width=\"" + px(std::max(0.5, right - left - 1.0)) + "\" height=\"" + px(f.v(0.0) - f.v(p.y)) + "\"/>";
  }
  return svg;
}

std::string drawDots(const Series& series, const PlotFrame& f) {
  std::string svg;
  for (const std::size_t i : thinned(series.points)) {
    const PlotPoint& p = series.points[i];
    if (finite(p))
      svg += "<circle class=\"dot c-" + series.colour + "\" cx=\"" + px(f.u(p.x)) + "\" cy=\"" + px(f.v(p.y)) +
             "\" r=\"3\"/>";
  }
  return svg;
}

std::string draw(const Series& series, const PlotFrame& f) {
  switch (series.kind) {
    case Series::Kind::Band: return drawBand(series, f);
    case Series::Kind::Bars: return drawBars(series, f);
    case Series::Kind::Dots: return drawDots(series, f);
    case Series::Kind::Line:
    case Series::Kind::Dashed:
    case Series::Kind::Faint: break;
  }
  const std::string dashed = series.kind == Series::Kind::Dashed  ? " dashed"
                             : series.kind == Series::Kind::Faint ? " faint"
                                                                  : "";
  return "<path class=\"line c-" + series.colour + dashed + "\" data-name=\"" + escapeHtml(series.name) + "\" d=\"" +
         makePath(series, f) + "\"/>";
}

std::string legend(const Plot& plot) {
  std::string html;
  for (const Series& series : plot.series) {
    if (series.name.empty()) continue;
    const char* shape = series.kind == Series::Kind::Band     ? "block"
                        : series.kind == Series::Kind::Dots   ? "round"
                        : series.kind == Series::Kind::Dashed ? "dash"
                                                              : "stroke";
    html += "<span class=\"key\"><i class=\"" + std::string(shape) + " c-" + series.colour + "\"></i>" +
            escapeHtml(series.name) + "</span>";
  }
  return html.empty() ? "" : "<div class=\"legend\">" + html + "</div>";
}

}  // namespace

std::string renderSvg(const Plot& plot, bool with_legend) {
  const PlotFrame f = makePlotFrame(plot);
  if (f.x.empty() || f.y.empty()) return {};
  const auto attribute = [](const char* name, double value) {
    return std::string(" data-") + name + "=\"" + urban_nav_core::formatNumber(value, 9) + "\"";
  };
  std::string svg = (with_legend ? legend(plot) : "") + "<svg class=\"plot\" viewBox=\"0 0 " +
                    std::to_string(plot.width) + " " + std::to_string(plot.height) + "\" role=\"img\"" +
                    attribute("x0", f.x.low) + attribute("x1", f.x.high) + attribute("y0", f.y.low) +
                    attribute("y1", f.y.high) + " data-xl=\"" + escapeHtml(plot.x_label) + "\" data-yl=\"" +
                    escapeHtml(plot.y_label) + "\">";
  const std::string area = px(kPlotLeft) + " " + px(kPlotTop) + " " + px(f.width - kPlotLeft - kPlotRight) + " " +
                           px(f.height - kPlotTop - kPlotBottom);
  svg += axes(plot, f) + "<svg class=\"area\" x=\"" + px(kPlotLeft) + "\" y=\"" + px(kPlotTop) + "\" width=\"" +
         px(f.width - kPlotLeft - kPlotRight) + "\" height=\"" + px(f.height - kPlotTop - kPlotBottom) +
         "\" viewBox=\"" + area + "\">";  // a viewport of its own clips without an id
  for (const Span& span : plot.spans) {
    const double left = f.u(std::max(span.from, f.x.low)), right = f.u(std::min(span.to, f.x.high));
    if (right >= left)
      svg += "<rect class=\"span c-" + span.colour + "\" x=\"" + px(left) + "\" y=\"" + px(kPlotTop) + "\" width=\"" +
             px(std::max(1.0, right - left)) + "\" height=\"" + px(f.height - kPlotTop - kPlotBottom) + "\"/>";
  }
  for (const Series& series : plot.series) svg += draw(series, f);
  return svg + "</svg></svg>";
}

std::vector<double> niceTicks(double low, double high, int count) {
  std::vector<double> ticks;
  if (!(high > low) || count < 1 || !std::isfinite(high - low)) return ticks;
  const double rough = (high - low) / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * power >= rough) step = factor * power;
  }
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i += 1.0)
    ticks.push_back(i == 0.0 ? 0.0 : i * step);
  return ticks;
}

std::string escapeHtml(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&': escaped += "&amp;"; break;
      case '<': escaped += "&lt;"; break;
      case '>': escaped += "&gt;"; break;
      case '"': escaped += "&quot;"; break;
      case '\'': escaped += "&#39;"; break;
      default: escaped += c;
    }
  }
  return escaped;
}

}  // namespace urban_nav
