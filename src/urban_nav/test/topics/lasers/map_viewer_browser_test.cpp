// SPDX-License-Identifier: BSD-3-Clause
// The map in three dimensions as a browser draws it: from disk, without network, WebGL by software.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <tuple>

#include "base/map_layer.hpp"
#include "base/page.hpp"
#include "edits/circle_store.hpp"
#include "topics/lasers/map_viewer.hpp"
#include "topics/lasers/report_tiles.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "view/tiled_store.hpp"

namespace urban_nav {
namespace {

constexpr const char* kModes[] = {"pictures", "reflectance", "height", "pass", "sensor", "sigma", "quality"};
constexpr int kBelowControls = 80;  // px

std::string findBrowser() {
  const char* path = std::getenv("PATH");
  std::string rest = path == nullptr ? "/usr/bin" : path;
  for (const char* name : {"chromium-headless-shell", "chromium", "chromium-browser", "google-chrome"})
    for (std::size_t begin = 0; begin <= rest.size();) {
      const std::size_t end = std::min(rest.find(':', begin), rest.size());
      const std::filesystem::path candidate = std::filesystem::path(rest.substr(begin, end - begin)) / name;
      if (std::filesystem::exists(candidate)) return candidate.string();
      begin = end + 1;
    }
  return "";
}

/// A floor and a wall of which every column that the view shows varies.
std::vector<laser_mapper::MapPoint> shownPoints() {
  std::vector<laser_mapper::MapPoint> points;
  for (int i = 0; i < 120; ++i)
    for (int j = 0; j < 160; ++j) {
      laser_mapper::MapPoint point;
      point.p = i < 60 ? Eigen::Vector3f(0.1F * static_cast<float>(j), 0.1F * static_cast<float>(i), 0.0F)
                       : Eigen::Vector3f(0.1F * static_cast<float>(j), 6.0F, 0.1F * static_cast<float>(i - 60));
      point.red = static_cast<std::uint8_t>(200 - j);
      point.green = static_cast<std::uint8_t>(2 * i);
      point.blue = static_cast<std::uint8_t>(j);
      point.intensity = static_cast<std::uint8_t>(40 + j);
      point.pass = static_cast<std::uint16_t>(j / 40);
      point.laser = static_cast<std::uint8_t>(i / 60);
      point.sigma = 0.001F + 0.0002F * static_cast<float>(i);
      point.displacement = j < 80 ? -1.0F : 0.0005F * static_cast<float>(j);
      point.stamp = 1'225'719'872'000'000'000 + j * 1'000'000LL;
      points.push_back(point);
    }
  return points;
}

class MapInABrowser : public ::testing::Test {
 protected:
  void SetUp() override {
    browser_ = findBrowser();
    if (browser_.empty()) GTEST_SKIP() << "no Chromium here: the view in three dimensions is not looked at";
    viewer_.add(shownPoints());
    viewer_.addPath({{0.0, 3.0, 0.1}, {15.0, 3.0, 0.1}});
  }

  /// Opens a page; returns its log. `output`: --screenshot=FILE or --dump-dom.
  std::string open(const std::string& html, const std::string& output) {
    urban_nav_input::testing::writeFile(folder_.file("page.html"), html);
    const std::string log = folder_.file("log");
    const std::string command = "'" + browser_ +
                                "' --headless --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader"
                                " --host-resolver-rules='MAP * ~NOTFOUND' --enable-logging=stderr --window-size=800,600"
                                " --virtual-time-budget=8000 --user-data-dir='" +
                                folder_.file("profile") + "' " + output + " 'file://" + folder_.file("page.html") +
                                "' >'" + folder_.file("dom") + "' 2>'" + log + "'";
    const int status = std::system(command.c_str());
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << urban_nav_input::testing::readFile(log);
    return urban_nav_input::testing::readFile(log);
  }
  static void expectNoErrors(const std::string& log) {
    for (std::size_t at = 0; at < log.size();) {
      const std::size_t end = std::min(log.find('\n', at), log.size());
      const std::string line = log.substr(at, end - at);
      const bool is_error = line.find("Uncaught") != std::string::npos || line.find("Error") != std::string::npos;
      EXPECT_FALSE(line.find("CONSOLE") != std::string::npos && is_error) << line;
      at = end + 1;
    }
  }

  std::string browser_;
  const urban_nav_input::testing::TemporaryFolder folder_;
  MapViewer viewer_{0};
};

TEST_F(MapInABrowser, EachColouringShowsPointsInItsColours) {
  const std::string view = viewer_.render();
  std::map<std::string, cv::Mat> pictures;
  for (const std::string mode : kModes) {
    const std::string option = "<option value=\"" + mode + "\"";
    std::string html = view;
    ASSERT_NE(html.find(option), std::string::npos) << mode;
    html.insert(html.find(option) + option.size(), " selected");
    expectNoErrors(open("<!DOCTYPE html><body>" + html, "--screenshot='" + folder_.file("picture.png") + "'"));
    const cv::Mat whole = cv::imread(folder_.file("picture.png"));
    ASSERT_GT(whole.rows, 2 * kBelowControls) << mode;
    const cv::Mat picture = whole.rowRange(kBelowControls, whole.rows - kBelowControls).clone();
    std::set<std::tuple<int, int, int>> colours;
    int drawn = 0;
    for (int v = 0; v < picture.rows; ++v)
      for (int u = 0; u < picture.cols; ++u) {
        const auto& pixel = picture.at<cv::Vec3b>(v, u);
        if (pixel[0] > 245 && pixel[1] > 245 && pixel[2] > 245) continue;
        ++drawn;
        colours.insert({pixel[0], pixel[1], pixel[2]});
      }
    EXPECT_GT(drawn, picture.rows * picture.cols / 20) << mode << ": the canvas is blank";
    EXPECT_GE(colours.size(), 3U) << mode << ": two kinds and the path at least";
    for (const auto& [other, before] : pictures)
      EXPECT_GT(cv::norm(picture, before, cv::NORM_L1), 1e5) << mode << " looks like " << other;
    pictures[mode] = picture;
  }
}

TEST_F(MapInABrowser, ALayerIsAChoiceIfItHasAsManyValuesAsThereArePoints) {
  const std::vector<unsigned char> kinds(shownPoints().size(), 1), few(10, 1);
  const std::string layers = renderMapLayer(0, "class", kinds, {{250, 0, 0}, {0, 0, 250}}) +
                             renderMapLayer(0, "few", few, {{250, 0, 0}, {0, 0, 250}}) +
                             renderMapLayer(7, "elsewhere", kinds, {{250, 0, 0}, {0, 0, 250}});
  expectNoErrors(open("<!DOCTYPE html><body>" + viewer_.render() + layers, "--dump-dom"));
  const std::string dom = urban_nav_input::testing::readFile(folder_.file("dom"));
  EXPECT_NE(dom.find("<option value=\"class\">"), std::string::npos);
  EXPECT_EQ(dom.find("<option value=\"few\">"), std::string::npos);
  EXPECT_EQ(dom.find("<option value=\"elsewhere\">"), std::string::npos);
}

TEST_F(MapInABrowser, FinerLevelsAreLoadedFromTheFolderNextToTheReportIfItIsThere) {
  const std::string path = folder_.file("s.db"), tiles = folder_.file(kReportTiles);
  testing::writeCircleStore(path);
  testing::addTiles(path);
  urban_nav_store::Store store(path, urban_nav_store::Access::Read);
  viewer_.setTiles(writeReportTiles(store, testing::kMondayId, tiles, 0));
  const std::string html = "<!DOCTYPE html><body>" + viewer_.render();
  std::string dom;
  // A browser that lacks processor time may end before the tiles are drawn.
  for (int i = 0; i < 5 && dom.find("data-complete=\"1\"") == std::string::npos; ++i) {
    expectNoErrors(open(html, "--dump-dom"));
    dom = urban_nav_input::testing::readFile(folder_.file("dom"));
  }
  EXPECT_NE(dom.find("data-complete=\"1\""), std::string::npos);
  EXPECT_EQ(dom.find("data-points=\"0\""), std::string::npos) << "tiles of the map are in view";
  removeReportTiles(tiles, 1);
  EXPECT_TRUE(std::filesystem::exists(tiles)) << "those of another view";
  removeReportTiles(tiles, 0);
  EXPECT_FALSE(std::filesystem::exists(tiles));
  expectNoErrors(open(html, "--screenshot='" + folder_.file("picture.png") + "'"));
  const cv::Mat whole = cv::imread(folder_.file("picture.png"), cv::IMREAD_GRAYSCALE);
  const cv::Mat picture = whole.rowRange(kBelowControls, whole.rows - kBelowControls);
  EXPECT_GT(cv::countNonZero(picture < 245), picture.rows * picture.cols / 20) << "the points in the report";
}

TEST_F(MapInABrowser, TheReportHoldsTheViewAndHasNoErrors) {
  Page page;
  page.title = "Map";
  Section section;
  section.id = "map";
  section.title = "The map";
  section.figures.push_back({"In three dimensions", viewer_.render(), "A click names a point.", true});
  page.sections.push_back(section);
  expectNoErrors(open(renderPage(page), "--dump-dom"));
  const std::string dom = urban_nav_input::testing::readFile(folder_.file("dom"));
  EXPECT_NE(dom.find("<canvas"), std::string::npos);
  EXPECT_EQ(dom.find("style=\"display: none"), std::string::npos) << "the view hides itself without WebGL";
}

}  // namespace
}  // namespace urban_nav
