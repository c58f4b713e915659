// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>

#include "base/standalone_svg.hpp"
#include "topics/places/confusion_picture.hpp"
#include "topics/places/place_evaluation.hpp"
#include "topics/places/place_pair_picture.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav {

namespace {

constexpr std::size_t kPicturesOfAKind = 4;
constexpr double kShownAsClosure = 0.99;

std::vector<PlotPoint> toPoints(const RankingScore& score) {
  std::vector<PlotPoint> points;
  for (const RankingScore::RecallPoint& point : score.curve) points.push_back({point.recall, point.precision});
  return points;
}

Series namedSeries(const std::string& name, const std::string& colour, Series::Kind kind,
                   std::vector<PlotPoint> points) {
  Series series;
  series.name = name;
  series.colour = colour;
  series.kind = kind;
  series.points = std::move(points);
  return series;
}

Plot precisionRecallPlot(const PlaceEvaluation& evaluation) {
  Plot plot;
  plot.x_label = "recall";
  plot.y_label = "precision";
  plot.y_from_zero = true;
  plot.y_top = 1.0;
  plot.series.push_back(namedSeries("", "plain", Series::Kind::Faint, {{0.0, 1.0}, {1.0, 1.0}}));
  constexpr std::array<const char*, 3> kColours = {"a", "b", "c"};
  for (std::size_t i = 0; i < evaluation.words.size(); ++i)
    plot.series.push_back(namedSeries("words: " + evaluation.words[i].name, kColours[i % 3], Series::Kind::Line,
                                      toPoints(evaluation.words[i].score)));
  plot.series.push_back(
      namedSeries("all evidence, by probability", "d", Series::Kind::Dashed, toPoints(evaluation.score.ranking)));
  return plot;
}

Plot reliabilityPlot(const PlaceScore& score) {
  Plot plot;
  plot.x_label = "stated probability";
  plot.y_label = "share of correct ones";
  plot.y_from_zero = true;
  plot.y_top = 1.0;
  plot.series.push_back(namedSeries("as stated", "plain", Series::Kind::Dashed, {{0.0, 0.0}, {1.0, 1.0}}));
  std::vector<PlotPoint> points;
  for (const ReliabilityBin& bin : score.reliability)
    points.push_back({bin.stated, static_cast<double>(bin.right) / static_cast<double>(bin.claims)});
  plot.series.push_back(namedSeries("measured", "a", Series::Kind::Line, points));
  plot.series.push_back(namedSeries("", "a", Series::Kind::Dots, points));
  return plot;
}

/// Plots the path from above with the reported closures (Newman et al. 2009, Fig. 9).
Plot closuresPlot(const PlaceEvaluation& evaluation) {
  const PlaceTruth& truth = evaluation.truth;
  Plot plot;
  plot.x_label = "x (m)";
  plot.y_label = "y (m)";
  plot.equal_axes = true;
  plot.height = 420;
  Series path = namedSeries("path", "plain", Series::Kind::Line, {}),
         right = namedSeries("announced, right", "good", Series::Kind::Line, {}),
         wrong = namedSeries("announced, wrong", "b", Series::Kind::Line, {});
  const double gap = std::numeric_limits<double>::quiet_NaN();
  const auto at = [&](std::size_t row) { return PlotPoint{truth.positions[row]->x(), truth.positions[row]->y()}; };
  for (std::size_t row = 0; row < evaluation.query.rows.size(); ++row) {
    if (row > 0 && evaluation.query.rows[row].session != evaluation.query.rows[row - 1].session)
      path.points.push_back({gap, gap});
    if (truth.positions[row]) path.points.push_back(at(row));
  }
  for (const RankedMatch& match : rankedMatches(evaluation.query)) {
    const auto verdict = judgeMatch(truth, match);
    if (!verdict || match.score <= kShownAsClosure) continue;
    Series& series = *verdict == MatchTruth::Wrong ? wrong : right;
    for (const PlotPoint& point : {at(match.matched_row), at(match.row), PlotPoint{gap, gap}})
      series.points.push_back(point);
  }
  for (Series* series : {&path, &right, &wrong})
    if (!series->points.empty()) plot.series.push_back(std::move(*series));
  return plot;
}

std::string verdictWord(const std::optional<MatchTruth>& verdict) {
  if (!verdict) return "";
  return *verdict == MatchTruth::Right ? "right" : *verdict == MatchTruth::Wrong ? "wrong" : "neither";
}

std::string printMatches(const PlaceEvaluation& evaluation) {
  std::string text =
      "image,session,stamp_ns,place,place_session,place_stamp_ns,probability,verdict,distance,word_ratio,word_margin,"
      "look,look_margin,sequence,agreeing\n";
  for (const RankedMatch& match : rankedMatches(evaluation.query)) {
    const PlaceQueryRow &row = evaluation.query.rows[match.row], &place = evaluation.query.rows[match.matched_row];
    const auto &a = evaluation.truth.positions[match.row], &b = evaluation.truth.positions[match.matched_row];
    std::vector<std::string> cells = {std::to_string(match.row),
                                      evaluation.query.sessions[row.session],
                                      std::to_string(row.stamp),
                                      std::to_string(match.matched_row),
                                      evaluation.query.sessions[place.session],
                                      std::to_string(place.stamp),
                                      urban_nav_core::printNumber(match.score),
                                      verdictWord(judgeMatch(evaluation.truth, match)),
                                      a && b ? urban_nav_core::printNumber((*a - *b).norm()) : ""};
    for (const double value : row.recognition.match->evidence.values())
      cells.push_back(urban_nav_core::printNumber(value));
    cells.push_back(std::to_string(row.recognition.match->agreeing));
    text += urban_nav_core::printCsvRow(cells);
  }
  return text;
}

std::string printConfusion(const PlaceEvaluation& evaluation) {
  std::string text = "image,place,probability\n";
  for (const WordProbability& entry : evaluation.confusion)
    text += std::to_string(entry.row) + "," + std::to_string(entry.place_row) + "," +
            urban_nav_core::printNumber(entry.probability) + "\n";
  return text;
}

/// Returns the correct and wrong matches of highest probability, and the correct ones of lowest probability.
std::vector<PagePicture> matchPictures(const PlaceEvaluation& evaluation, const PlaceRecording& recording) {
  std::vector<RankedMatch> right, wrong;
  for (const RankedMatch& match : rankedMatches(evaluation.query)) {
    const auto verdict = judgeMatch(evaluation.truth, match);
    if (verdict == MatchTruth::Right) right.push_back(match);
    if (verdict == MatchTruth::Wrong) wrong.push_back(match);
  }
  const auto surer = [](const RankedMatch& a, const RankedMatch& b) { return a.score > b.score; };
  std::stable_sort(right.begin(), right.end(), surer);
  std::stable_sort(wrong.begin(), wrong.end(), surer);
  std::vector<PagePicture> pictures;
  const auto add = [&](const std::string& kind, const std::vector<RankedMatch>& matches, bool from_the_end) {
    for (std::size_t i = 0; i < std::min(kPicturesOfAKind, matches.size()); ++i) {
      const RankedMatch& match = from_the_end ? matches[matches.size() - 1 - i] : matches[i];
      const auto &place = recording.places[match.matched_row], &query = recording.places[match.row];
      const auto label = [&](const PlaceRecording::Place& one, std::size_t row) {
        return recording.sessions[one.session] + ", image " + std::to_string(row);
      };
      if (auto picture = placePairPicture(place.thumbnail, query.thumbnail,
                                          kind + ", probability " + urban_nav_core::formatNumber(match.score, 4) +
                                              ". Above: " + label(place, match.matched_row) +
                                              "; below: " + label(query, match.row) + "."))
        pictures.push_back(std::move(*picture));
    }
  };
  add("Right", right, false);
  add("Wrong", wrong, false);
  if (right.size() > 2 * kPicturesOfAKind) add("Correct, with the lowest probability", right, true);
  return pictures;
}

std::string countText(std::size_t part, std::size_t whole) {
  return std::to_string(part) + " of " + std::to_string(whole);
}

PageTable evidenceTable(const PlaceEvaluation& evaluation) {
  PageTable table{"Evidence",
                  {"", "correct place ranked first", "recall at 100 % precision", "above 0.99: correct",
                   "0.9 to 0.99: correct", "revisits reported, or next to one", "calibration error"},
                  {},
                  "Mask " + urban_nav_core::formatNumber(static_cast<double>(evaluation.mask) * 1e-9, 6) +
                      " s; right within " + urban_nav_core::formatNumber(evaluation.truth.radius) + " " +
                      evaluation.truth.unit + ", wrong beyond " +
                      urban_nav_core::formatNumber(evaluation.truth.elsewhere) +
                      "; probabilities are calibrated for all evidence."};
  for (const PlaceEvaluation::Row& row : evaluation.rows)
    table.rows.push_back({row.name, countText(row.score.ranking.first, row.score.ranking.revisits),
                          countText(row.score.ranking.found, row.score.ranking.revisits),
                          countText(row.score.sure_right, row.score.sure),
                          countText(row.score.nearly_right, row.score.nearly),
                          countText(row.score.near_sure, row.score.ranking.revisits),
                          urban_nav_core::formatNumber(row.score.calibration_error, 2)});
  for (const PlaceEvaluation::Curve& curve : evaluation.words)
    table.rows.push_back({"words alone, by " + curve.name, countText(curve.score.first, curve.score.revisits),
                          countText(curve.score.found, curve.score.revisits), "", "", "", ""});
  return table;
}

PageTable reliabilityTable(const PlaceScore& score) {
  PageTable table{"Reliability", {"stated", "mean", "claims", "right"}, {}, ""};
  for (const ReliabilityBin& bin : score.reliability)
    table.rows.push_back({urban_nav_core::formatNumber(bin.from) + " to " + urban_nav_core::formatNumber(bin.to),
                          urban_nav_core::formatNumber(bin.stated, 3), std::to_string(bin.claims),
                          std::to_string(bin.right)});
  return table;
}

Page evaluationPage(const PlaceEvaluation& evaluation, const PlaceRecording& recording, const std::string& model) {
  Page page;
  page.title = "Places: model " + model;
  page.subtitle = std::to_string(recording.places.size()) + " images of " + std::to_string(recording.sessions.size()) +
                  " sessions, " + std::to_string(evaluation.score.ranking.revisits) + " revisits.";
  Section section{"places", "Place recognition against the truth", "", {}, {}, {}};
  section.figures.push_back({"Precision and recall", renderSvg(precisionRecallPlot(evaluation)),
                             "Words alone by three formulas, and all evidence.", false});
  section.figures.push_back({"Reliability", renderSvg(reliabilityPlot(evaluation.score)),
                             "Observations by stated probability, and the share of correct ones.", false});
  if (evaluation.truth.unit == "m")
    section.figures.push_back({"Closures announced above 0.99", renderSvg(closuresPlot(evaluation)), "", true});
  section.tables = {evidenceTable(evaluation), reliabilityTable(evaluation.score)};
  section.pictures = matchPictures(evaluation, recording);
  section.pictures.insert(section.pictures.begin(), confusionPagePicture(evaluation));
  page.sections.push_back(std::move(section));
  page.footer = "urban_nav places evaluate";
  return page;
}

}  // namespace

void writeEvaluation(const PlaceEvaluation& evaluation, const PlaceRecording& recording, const std::string& model,
                     const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const auto write = [&](const char* name, const std::string& content) {
    urban_nav_core::writeAtomically((std::filesystem::path(folder) / name).string(), content);
  };
  write("precision_recall.svg", standaloneSvg({{"Precision and recall", precisionRecallPlot(evaluation)}}));
  write("reliability.svg", standaloneSvg({{"Reliability", reliabilityPlot(evaluation.score)}}));
  write("confusion.csv", printConfusion(evaluation));
  write("confusion.png", confusionPng(evaluation));
  write("matches.csv", printMatches(evaluation));
  write("report.html", renderPage(evaluationPage(evaluation, recording, model)));
}

}  // namespace urban_nav
