// SPDX-License-Identifier: BSD-3-Clause
#include "base/plot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "base/page.hpp"
#include "base/raster_plot.hpp"
#include "base/standalone_svg.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Series line(std::vector<PlotPoint> points) {
  Series series;
  series.name = "a <b>";
  series.points = std::move(points);
  return series;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(Plot, DrawsNothingOutOfNothing) {
  EXPECT_EQ(renderSvg({}), "");
  Plot plot;
  plot.series.push_back(line({{kNan, 1.0}, {0.0, kNan}}));
  EXPECT_EQ(renderSvg(plot), "");
}

TEST(Plot, BreaksALineAtWhatIsNotFinite) {
  Plot plot;
  plot.series.push_back(line({{0, 0}, {1, 1}, {2, kNan}, {3, 1}, {4, 0}}));
  const std::string svg = renderSvg(plot, false);
  const std::size_t begin = svg.find(" d=\"");
  ASSERT_NE(begin, std::string::npos);
  EXPECT_EQ(count(svg.substr(begin, svg.find("\"/>", begin) - begin), "M"), 2U);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(Plot, KeepsExtremesOfALongLine) {
  std::vector<PlotPoint> points;
  for (int i = 0; i < 100000; ++i) points.push_back({0.001 * i, i == 77777 ? 50.0 : std::sin(0.01 * i)});
  Plot plot;
  plot.series.push_back(line(points));
  const std::string svg = renderSvg(plot);
  EXPECT_LT(svg.size(), 60000U);
  // Heights of the line: the sine fills a few pixels at the bottom, the spike goes to the top.
  const std::size_t begin = svg.find(" d=\"", svg.find("class=\"line")) + 4;
  std::string path = svg.substr(begin, svg.find('"', begin) - begin);
  for (char& c : path)
    if (c == 'M' || c == 'L' || c == ',') c = ' ';
  std::istringstream numbers(path);
  double highest = 1e9, lowest = -1e9;
  for (double x = 0.0, y = 0.0; numbers >> x >> y;) highest = std::min(highest, y), lowest = std::max(lowest, y);
  EXPECT_GT(lowest - highest, 100.0) << "the spike is lost";
}

TEST(Plot, SurvivesASinglePoint) {
  Plot plot;
  plot.equal_axes = true;
  plot.series.push_back(line({{5.0, 5.0}}));
  EXPECT_EQ(renderSvg(plot).find("nan"), std::string::npos);
}

TEST(Plot, BecomesAPicture) {
  Plot plot;
  plot.series.push_back(line({{0, 0}, {1, kNan}, {2, 3}, {4, 1}}));
  const std::vector<unsigned char> png = rasterPng({{"one", plot}, {"nothing", {}}});
  ASSERT_GT(png.size(), 1000U);
  EXPECT_EQ(std::string(png.begin() + 1, png.begin() + 4), "PNG");
}

TEST(Plot, EscapesNames) {
  Plot plot;
  plot.series.push_back(line({{0, 0}, {1, 1}}));
  EXPECT_EQ(renderSvg(plot).find("<b>"), std::string::npos);
  EXPECT_NE(standaloneSvg({{"x & y", plot}}).find("x &amp; y"), std::string::npos);
}

TEST(NiceTicks, AreRoundAndInside) {
  EXPECT_EQ(niceTicks(0.0, 10.0, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  for (const double tick : niceTicks(-0.37, 1.2e6, 7)) {
    EXPECT_GE(tick, -0.37);
    EXPECT_LE(tick, 1.2e6);
  }
  EXPECT_TRUE(niceTicks(1.0, 1.0, 5).empty());
  EXPECT_TRUE(niceTicks(kNan, 1.0, 5).empty());
}

TEST(ForPerson, WritesWhatPeopleWrite) {
  EXPECT_EQ(urban_nav_core::formatNumber(0.0), "0");
  EXPECT_EQ(urban_nav_core::formatNumber(59.8612, 4), "59.86");
  EXPECT_EQ(urban_nav_core::formatNumber(1234567.0, 3), "1234567");
  EXPECT_EQ(urban_nav_core::formatNumber(0.0012345, 3), "0.00123");
  EXPECT_EQ(urban_nav_core::formatNumber(-2.50, 3), "-2.5");
  EXPECT_EQ(urban_nav_core::formatNumber(kNan), "–");
}

TEST(Page, IsOneFileThatRefreshesOnlyWhileItRuns) {
  Page page;
  page.title = "<script>alert(1)</script>";
  page.running = true;
  page.progress = 0.5;
  EXPECT_NE(renderPage(page).find("http-equiv=\"refresh\""), std::string::npos);
  EXPECT_EQ(renderPage(page).find("<script>alert"), std::string::npos);
  page.running = false;
  EXPECT_EQ(renderPage(page).find("http-equiv=\"refresh\""), std::string::npos);
}

TEST(Base64, AgreesWithTheStandard) {  // RFC 4648, section 10
  const auto of = [](const std::string& text) { return base64({text.begin(), text.end()}); };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace urban_nav
