// SPDX-License-Identifier: BSD-3-Clause
#include "topics/places/place_truth.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "urban_nav_core/io/column_names.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/io/text_table.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_core::StampNs;
using urban_nav_core::UserError;

namespace {

constexpr StampNs kLongestGap = 1'000'000'000;  // ns between poses of the truth
constexpr double kRadiusOfPositions = 3.0,
                 kElsewhereOfPositions = 20.0;     // images, as for data sets with positions
constexpr double kElsewherePerRadius = 4.0 / 3.0;  // of metres: 10 m for 7.5 m
constexpr double kCertain = 0.99, kNearlyCertain = 0.9;
constexpr double kNearMetres = 2.0, kNearImages = 1.0;  // between a pose and a reported closure
constexpr std::array<double, 12> kClaimLimits = {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.99, 1.0};

bool isPositionTable(const std::string& text, const std::string& path) {
  const urban_nav_core::TextTable table(text, path);
  return std::any_of(table.header().begin(), table.header().end(),
                     [](const std::string& name) { return urban_nav_core::plainName(name) == "position"; });
}

PlaceTruth truthOfPositions(const std::string& text, const std::string& path, const PlaceQuery& query) {
  const urban_nav_core::CsvTable table = urban_nav_core::CsvTable::parse(text, path);
  const std::size_t column = table.column("position");
  if (table.rows() != query.rows.size())
    throw UserError(path, std::to_string(table.rows()) + " rows",
                    std::to_string(query.rows.size()) + ", one for each image");
  PlaceTruth truth;
  for (std::size_t i = 0; i < table.rows(); ++i)
    truth.positions.emplace_back(Eigen::Vector3d(table.number(i, column), 0.0, 0.0));
  truth.radius = kRadiusOfPositions;
  truth.elsewhere = kElsewhereOfPositions;
  truth.unit = "images";
  return truth;
}

/// Returns the distance of two rows in the truth; nullopt if one is outside the truth.
std::optional<double> distanceBetween(const PlaceTruth& truth, std::size_t a, std::size_t b) {
  if (!truth.positions[a] || !truth.positions[b]) return std::nullopt;
  return (*truth.positions[a] - *truth.positions[b]).norm();
}

bool isRevisit(const PlaceQuery& query, const PlaceTruth& truth, StampNs mask, std::size_t row) {
  for (std::size_t i = 0; i < row; ++i) {
    const bool is_masked =
        query.rows[i].session == query.rows[row].session && query.rows[i].stamp > query.rows[row].stamp - mask;
    const auto distance = is_masked ? std::nullopt : distanceBetween(truth, i, row);
    if (distance && *distance <= truth.radius) return true;
  }
  return false;
}

void addClaim(double probability, bool is_right, PlaceScore& score) {
  for (ReliabilityBin& bin : score.reliability) {
    if (probability > bin.to || (probability <= bin.from && bin.from > 0.0)) continue;
    ++bin.claims;
    bin.right += is_right ? 1u : 0u;
    bin.stated += probability;
    break;
  }
  if (probability > kCertain) {
    ++score.sure;
    score.sure_right += is_right ? 1u : 0u;
  } else if (probability > kNearlyCertain) {
    ++score.nearly;
    score.nearly_right += is_right ? 1u : 0u;
  }
}

std::vector<ReliabilityBin> emptyBins() {
  std::vector<ReliabilityBin> bins(kClaimLimits.size() - 1);
  for (std::size_t i = 0; i < bins.size(); ++i) {
    bins[i].from = kClaimLimits[i];
    bins[i].to = kClaimLimits[i + 1];
  }
  return bins;
}

/// Converts sums to means, and removes empty bins.
void finishBins(PlaceScore& score) {
  auto& bins = score.reliability;
  bins.erase(std::remove_if(bins.begin(), bins.end(), [](const ReliabilityBin& bin) { return bin.claims == 0; }),
             bins.end());
  double claims = 0.0;
  for (ReliabilityBin& bin : bins) {
    const auto number = static_cast<double>(bin.claims);
    bin.stated /= number;
    if (bin.from < 0.5) continue;
    claims += number;
    score.calibration_error += number * std::abs(bin.stated - static_cast<double>(bin.right) / number);
  }
  if (claims > 0.0) score.calibration_error /= claims;
}

}  // namespace

PlaceTruth readPlaceTruth(const std::string& path, const PlaceQuery& query, const std::optional<double>& radius) {
  const std::string text = urban_nav_core::readTextFile(path);
  PlaceTruth truth;
  if (isPositionTable(text, path)) {
    truth = truthOfPositions(text, path, query);
  } else {
    const urban_nav_core::Trajectory trajectory = urban_nav_core::parseTum(text, path);
    for (const PlaceQueryRow& row : query.rows) {
      const auto pose = trajectory.at(row.stamp, kLongestGap);
      truth.positions.push_back(pose ? std::optional<Eigen::Vector3d>(pose->t()) : std::nullopt);
    }
  }
  if (radius) {
    truth.elsewhere = *radius * (truth.unit == "m" ? kElsewherePerRadius : kElsewhereOfPositions / kRadiusOfPositions);
    truth.radius = *radius;
  }
  return truth;
}

std::vector<RankedMatch> rankedMatches(const PlaceQuery& query) {
  std::vector<RankedMatch> matches;
  for (std::size_t row = 0; row < query.rows.size(); ++row)
    if (query.rows[row].recognition.match)
      matches.push_back({row, query.rows[row].matched_row, query.rows[row].recognition.probability});
  return matches;
}

std::optional<MatchTruth> judgeMatch(const PlaceTruth& truth, const RankedMatch& match) {
  const auto distance = distanceBetween(truth, match.matched_row, match.row);
  if (!distance) return std::nullopt;
  if (*distance <= truth.radius) return MatchTruth::Right;
  return *distance > truth.elsewhere ? MatchTruth::Wrong : MatchTruth::Neither;
}

std::vector<bool> findRevisits(const PlaceQuery& query, const PlaceTruth& truth, StampNs mask) {
  std::vector<bool> revisits(query.rows.size());
  for (std::size_t row = 0; row < query.rows.size(); ++row)
    revisits[row] = truth.positions[row] && isRevisit(query, truth, mask, row);
  return revisits;
}

RankingScore scoreRanking(const std::vector<RankedMatch>& matches, const PlaceTruth& truth,
                          const std::vector<bool>& revisits) {
  RankingScore score;
  score.revisits = static_cast<std::size_t>(std::count(revisits.begin(), revisits.end(), true));
  std::vector<std::pair<double, bool>> judged;
  for (const RankedMatch& match : matches) {
    const auto verdict = judgeMatch(truth, match);
    if (!verdict || *verdict == MatchTruth::Neither) continue;
    const bool is_right = *verdict == MatchTruth::Right;
    score.first += is_right && revisits[match.row] ? 1u : 0u;
    judged.emplace_back(match.score, is_right);
  }
  // Of equal scores, wrong matches come first, so that ties do not improve the result.
  std::sort(judged.begin(), judged.end(),
            [](const auto& a, const auto& b) { return a.first != b.first ? a.first > b.first : a.second < b.second; });
  std::size_t right = 0, wrong = 0;
  for (const auto& [value, is_right] : judged) {
    ++(is_right ? right : wrong);
    if (wrong == 0) score.found = right;
    score.curve.push_back(
        {value, static_cast<double>(right) / static_cast<double>(right + wrong),
         score.revisits > 0 ? static_cast<double>(right) / static_cast<double>(score.revisits) : 0.0});
  }
  return score;
}

PlaceScore scorePlaces(const PlaceQuery& query, const PlaceTruth& truth, StampNs mask) {
  PlaceScore score;
  score.reliability = emptyBins();
  const std::vector<bool> revisits = findRevisits(query, truth, mask);
  const std::vector<RankedMatch> matches = rankedMatches(query);
  score.ranking = scoreRanking(matches, truth, revisits);
  std::vector<std::size_t> announced;
  for (const RankedMatch& match : matches) {
    const auto verdict = judgeMatch(truth, match);
    if (!verdict || *verdict == MatchTruth::Neither) continue;
    addClaim(match.score, *verdict == MatchTruth::Right, score);
    if (*verdict == MatchTruth::Right && match.score > kCertain) announced.push_back(match.row);
  }
  for (std::size_t row = 0; row < revisits.size(); ++row)
    if (revisits[row] && std::any_of(announced.begin(), announced.end(), [&](std::size_t other) {
          const auto distance = distanceBetween(truth, row, other);
          return distance && *distance <= (truth.unit == "m" ? kNearMetres : kNearImages);
        }))
      ++score.near_sure;
  finishBins(score);
  return score;
}

}  // namespace urban_nav
