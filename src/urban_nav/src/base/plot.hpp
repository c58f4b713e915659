// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace urban_nav {

struct PlotPoint {
  double x = 0.0, y = 0.0;
};

/// A series of a plot. Colours are names of the palette of the page ("a" estimate, "b" truth, "c", "d", "good",
/// "fair", "bad"), which differs between light and dark.
struct Series {
  enum class Kind { Line, Dashed, Faint, Dots, Band, Bars };  ///< Faint: one of many lines, drawn below others
  Kind kind = Kind::Line;
  std::string name;  ///< in the legend; empty: not in it
  std::string colour = "a";
  std::vector<PlotPoint> points;  ///< points that are not finite end a line
  std::vector<double> lower;      ///< Band: as many as points; the band is from lower to y. Bars: unused
  double bar_width = 0.0;         ///< Bars: in units of x
};

/// An interval of x with a coloured background.
struct Span {
  double from = 0.0, to = 0.0;
  std::string colour;
};

struct Plot {
  std::string x_label, y_label;  ///< without a y label the y axis has no numbers
  std::vector<Series> series;
  std::vector<Span> spans;
  bool equal_axes = false;  ///< same scale on both axes
  bool y_from_zero = false;
  std::optional<double> y_top;    ///< upper limit of y
  int width = 600, height = 280;  ///< px; scaled with the page
};

/// Returns the plot as an SVG element without fixed colours or fonts, optionally preceded by an HTML legend; empty
/// without finite points. Long series are thinned, keeping extremes.
std::string renderSvg(const Plot& plot, bool with_legend = true);

/// Returns about `count` round numbers (1, 2, 5 times a power of ten) within [low, high].
std::vector<double> niceTicks(double low, double high, int count);

/// Escapes `<`, `>`, `&` and quotes for HTML.
std::string escapeHtml(const std::string& text);

}  // namespace urban_nav
