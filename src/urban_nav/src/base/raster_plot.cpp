// SPDX-License-Identifier: BSD-3-Clause
#include "base/raster_plot.hpp"
#include "urban_nav_core/io/format_number.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace urban_nav {

namespace {

constexpr int kScale = 2;  // pixels per px of the plot
constexpr int kTitleHeight = 44, kLeft = 62, kRight = 14, kTop = 12, kBottom = 44;
const cv::Scalar kGrid(226, 232, 235), kText(119, 104, 93);

cv::Scalar toColour(const std::string& name) {
  if (name == "a") return {235, 111, 31};
  if (name == "b") return {15, 72, 217};
  if (name == "c") return {153, 133, 12};
  if (name == "good") return {62, 138, 43};
  return {119, 104, 93};
}

struct Bounds {
  double x0 = HUGE_VAL, x1 = -HUGE_VAL, y0 = HUGE_VAL, y1 = -HUGE_VAL;
};

bool drawable(const Series& series) { return series.kind != Series::Kind::Band && series.kind != Series::Kind::Bars; }

Bounds computeBounds(const Plot& plot) {
  Bounds b;
  for (const Series& series : plot.series) {
    if (!drawable(series)) continue;
    for (const PlotPoint& p : series.points) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
      b = {std::min(b.x0, p.x), std::max(b.x1, p.x), std::min(b.y0, p.y), std::max(b.y1, p.y)};
    }
  }
  const double across = plot.width - kLeft - kRight, up = plot.height - kTop - kBottom;
  double width = std::max(1e-6, 1.06 * (b.x1 - b.x0)), height = std::max(1e-6, 1.1 * (b.y1 - b.y0));
  if (plot.equal_axes) {
    const double metre = std::max(width / across, height / up);
    width = metre * across;
    height = metre * up;
  }
  const double x = 0.5 * (b.x0 + b.x1), y = 0.5 * (b.y0 + b.y1);
  return {x - 0.5 * width, x + 0.5 * width, y - 0.5 * height, y + 0.5 * height};
}

void write(cv::Mat& canvas, const std::string& text, double u, double v, double size, const cv::Scalar& colour) {
  cv::putText(canvas, text, cv::Point(cvRound(kScale * u), cvRound(kScale * v)), cv::FONT_HERSHEY_SIMPLEX,
              kScale * size, colour, kScale, cv::LINE_AA);
}

void draw(cv::Mat& canvas, int top, const std::string& title, const Plot& plot) {
  const Bounds b = computeBounds(plot);
  write(canvas, title, kLeft, top + 20, 0.5, {48, 36, 29});
  if (!(b.x1 > b.x0) || !(b.y1 > b.y0)) return;
  const auto u = [&](double x) { return kLeft + (x - b.x0) / (b.x1 - b.x0) * (plot.width - kLeft - kRight); };
  const auto v = [&](double y) {
    return top + kTitleHeight + plot.height - kBottom - (y - b.y0) / (b.y1 - b.y0) * (plot.height - kTop - kBottom);
  };
  const auto line = [&](double u0, double v0, double u1, double v1, const cv::Scalar& colour, int thickness) {
    cv::line(canvas, {cvRound(kScale * u0), cvRound(kScale * v0)}, {cvRound(kScale * u1), cvRound(kScale * v1)}, colour,
             thickness, cv::LINE_AA);
  };
  for (const double tick : niceTicks(b.x0, b.x1, plot.width / 90)) {
    line(u(tick), v(b.y0), u(tick), v(b.y1), kGrid, kScale);
    write(canvas, urban_nav_core::formatNumber(tick, 6), u(tick) - 8, v(b.y0) + 16, 0.36, kText);
  }
  for (const double tick : niceTicks(b.y0, b.y1, plot.height / 55)) {
    line(u(b.x0), v(tick), u(b.x1), v(tick), kGrid, kScale);
    write(canvas, urban_nav_core::formatNumber(tick, 6), 14, v(tick) + 4, 0.36, kText);
  }
  write(canvas, plot.x_label + "  |  " + plot.y_label, kLeft, top + kTitleHeight + plot.height - 8, 0.4, kText);
  double name_at = kLeft;
  for (const Series& series : plot.series) {
    if (!drawable(series)) continue;
    write(canvas, series.name, name_at, top + 38, 0.4, toColour(series.colour));
    name_at += 24.0 + 8.0 * static_cast<double>(series.name.size());
    for (std::size_t i = 1; i < series.points.size(); ++i) {
      const PlotPoint &p = series.points[i - 1], &q = series.points[i];
      const bool finite = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(q.x) && std::isfinite(q.y);
      const bool gap = series.kind == Series::Kind::Dashed && i % 2 == 0;
      if (finite && !gap) line(u(p.x), v(p.y), u(q.x), v(q.y), toColour(series.colour), kScale + 1);
    }
  }
}

}  // namespace

std::vector<unsigned char> rasterPng(const std::vector<std::pair<std::string, Plot>>& plots) {
  int width = 1, height = 0;
  for (const auto& [title, plot] : plots) {
    width = std::max(width, plot.width);
    height += kTitleHeight + plot.height;
  }
  cv::Mat canvas(kScale * std::max(1, height), kScale * width, CV_8UC3, cv::Scalar(255, 255, 255));
  int top = 0;
  for (const auto& [title, plot] : plots) {
    draw(canvas, top, title, plot);
    top += kTitleHeight + plot.height;
  }
  std::vector<unsigned char> bytes;
  cv::imencode(".png", canvas, bytes);
  return bytes;
}

}  // namespace urban_nav
