// SPDX-License-Identifier: BSD-3-Clause
#include "places/place_truth.hpp"

#include <algorithm>

#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_core::StampNs;
using urban_nav_core::UserError;

namespace {

constexpr StampNs longest_gap = 1'000'000'000;  // ns between poses of the truth
constexpr double radius_of_positions = 3.0,
                 elsewhere_of_positions = 20.0;     // images: as data sets with positions state it
constexpr double elsewhere_per_radius = 4.0 / 3.0;  // of metres: 10 m for 7.5 m
constexpr double certain = 0.99, nearly_certain = 0.9;

bool isPositionTable(const std::string& text) {
  const std::string header = text.substr(0, text.find('\n'));
  return header.find(',') != std::string::npos && header.find("position") != std::string::npos;
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
  truth.radius = radius_of_positions;
  truth.elsewhere = elsewhere_of_positions;
  truth.unit = "images";
  return truth;
}

struct ScoredMatch {
  double probability = 0.0, distance = 0.0;
};

/// Distance of two rows in the truth; nullopt if it does not reach one of them.
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

void addCurve(std::vector<ScoredMatch> matches, const PlaceTruth& truth, PlaceScore& score) {
  std::sort(matches.begin(), matches.end(), [](const ScoredMatch& a, const ScoredMatch& b) {
    return a.probability != b.probability ? a.probability > b.probability : a.distance > b.distance;
  });
  std::size_t right = 0, wrong = 0;
  for (const ScoredMatch& match : matches) {
    if (match.distance <= truth.radius) ++right;
    else if (match.distance > truth.elsewhere) ++wrong;
    else continue;
    if (wrong == 0) score.found = right;
    score.curve.push_back(
        {match.probability, static_cast<double>(right) / static_cast<double>(right + wrong),
         score.revisits > 0 ? static_cast<double>(right) / static_cast<double>(score.revisits) : 0.0});
  }
}

}  // namespace

PlaceTruth readPlaceTruth(const std::string& path, const PlaceQuery& query, const std::optional<double>& radius) {
  const std::string text = urban_nav_core::readTextFile(path);
  PlaceTruth truth;
  if (isPositionTable(text)) {
    truth = truthOfPositions(text, path, query);
  } else {
    const urban_nav_core::Trajectory trajectory = urban_nav_core::parseTum(text, path);
    for (const PlaceQueryRow& row : query.rows) {
      const auto pose = trajectory.at(row.stamp, longest_gap);
      truth.positions.push_back(pose ? std::optional<Eigen::Vector3d>(pose->t()) : std::nullopt);
    }
  }
  if (radius) {
    truth.elsewhere =
        *radius * (truth.unit == "m" ? elsewhere_per_radius : elsewhere_of_positions / radius_of_positions);
    truth.radius = *radius;
  }
  return truth;
}

PlaceScore scorePlaces(const PlaceQuery& query, const PlaceTruth& truth, StampNs mask) {
  PlaceScore score;
  std::vector<ScoredMatch> matches;
  for (std::size_t row = 0; row < query.rows.size(); ++row) {
    const bool is_revisit = truth.positions[row] && isRevisit(query, truth, mask, row);
    score.revisits += is_revisit ? 1u : 0u;
    const fabmap_node::PlaceRecognition& recognition = query.rows[row].recognition;
    if (!recognition.match) continue;
    const auto distance = distanceBetween(truth, query.rows[row].matched_row, row);
    if (!distance) continue;
    const bool is_right = *distance <= truth.radius;
    score.first += is_revisit && is_right ? 1u : 0u;
    matches.push_back({recognition.probability, *distance});
    if (!is_right && *distance <= truth.elsewhere) continue;
    if (recognition.probability > certain) {
      ++score.sure;
      score.sure_right += is_right ? 1u : 0u;
    } else if (recognition.probability > nearly_certain) {
      ++score.nearly;
      score.nearly_right += is_right ? 1u : 0u;
    }
  }
  addCurve(std::move(matches), truth, score);
  return score;
}

}  // namespace urban_nav
