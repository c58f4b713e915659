// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace urban_nav {

struct PlotPoint {
  double x = 0.0, y = 0.0;
};

/// One thing in a plot. Colours are names of the page's palette ("a" the estimate, "b" the truth, "c", "d", "good",
/// "fair", "bad"), so that they change with the page's light.
struct Series {
  enum class Kind { Line, Dashed, Faint, Dots, Band, Bars };  ///< Faint: of many lines, drawn below others
  Kind kind = Kind::Line;
  std::string name;  ///< in the legend; empty: not in it
  std::string colour = "a";
  std::vector<PlotPoint> points;  ///< points that are not finite end a line
  std::vector<double> lower;      ///< Band: as many as points; the band is from lower to y. Bars: unused
  double bar_width = 0.0;         ///< Bars: in units of x
};

/// A stretch of x in another colour, drawn below everything else.
struct Span {
  double from = 0.0, to = 0.0;
  std::string colour;
};

struct Plot {
  std::string x_label, y_label;  ///< without the latter the y axis has no numbers
  std::vector<Series> series;
  std::vector<Span> spans;
  bool equal_axes = false;  ///< a metre is a metre in both directions
  bool y_from_zero = false;
  std::optional<double> y_top;    ///< cut off above
  int width = 600, height = 280;  ///< px at the plot's own size; it scales with the page
};

/// The plot as an SVG element without fixed colours or fonts, after a legend in HTML if wanted; empty if there is
/// nothing finite to draw. Long series are thinned so that extremes stay.
std::string renderSvg(const Plot& plot, bool with_legend = true);

/// Round numbers (1, 2, 5 times a power of ten), about `count` of them, within [low, high].
std::vector<double> niceTicks(double low, double high, int count);

/// `<`, `>`, `&`, quotes for use in HTML.
std::string escapeHtml(const std::string& text);

}  // namespace urban_nav
