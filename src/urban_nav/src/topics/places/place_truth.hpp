// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "topics/places/place_query.hpp"

namespace urban_nav {

/// True position of each image of a query, and the distance within which two images show the same place.
struct PlaceTruth {
  std::vector<std::optional<Eigen::Vector3d>> positions;  ///< per row of the query; nullopt outside the truth
  double radius = 7.5;                                    ///< largest distance of the same place
  double elsewhere = 10.0;  ///< smallest distance of different places; matches in between are not counted
  std::string unit = "m";
};

/// Reads the truth at `path` for the rows of a query: a CSV with columns image and position (one row per image, in
/// their order; positions in units of images: the same within 3, elsewhere beyond 20), or a TUM trajectory. `radius`:
/// as given by the user; nullopt: 3 for a CSV, 7.5 m for a trajectory. Throws UserError with file and line for other
/// files, or another number of rows.
PlaceTruth readPlaceTruth(const std::string& path, const PlaceQuery& query, const std::optional<double>& radius);

/// Truth of a match; Neither: between `radius` and `elsewhere`.
enum class MatchTruth { Right, Wrong, Neither };

/// Match of a row of a query with an earlier row; `score` ranks matches: a probability, or a similarity of any unit.
struct RankedMatch {
  std::size_t row = 0, matched_row = 0;
  double score = 0.0;
};

/// Returns the matches of a query by their probabilities.
std::vector<RankedMatch> rankedMatches(const PlaceQuery& query);

/// Compares a match with the truth; nullopt if one of its rows is outside the truth.
std::optional<MatchTruth> judgeMatch(const PlaceTruth& truth, const RankedMatch& match);

/// Returns per row whether an earlier row outside the mask (ns) shows the same place.
std::vector<bool> findRevisits(const PlaceQuery& query, const PlaceTruth& truth, urban_nav_core::StampNs mask);

/// Precision and recall of ranked matches.
struct RankingScore {
  std::size_t revisits = 0;  ///< images with an earlier place of the query outside the mask within the radius
  std::size_t first = 0;     ///< of these, with a correct place ranked first
  std::size_t found = 0;     ///< of these, above every wrong match: recall at 100 % precision
  struct RecallPoint {
    double score = 0.0, precision = 1.0, recall = 0.0;
  };
  std::vector<RecallPoint> curve;  ///< by descending score
};
/// `revisits`: of findRevisits().
RankingScore scoreRanking(const std::vector<RankedMatch>& matches, const PlaceTruth& truth,
                          const std::vector<bool>& revisits);

/// Matches within a range of stated probabilities.
struct ReliabilityBin {
  double from = 0.0, to = 0.0;
  std::size_t claims = 0, right = 0;  ///< matches that are right or wrong
  double stated = 0.0;                ///< mean probability of these matches
};

/// Figures of a query against the truth.
struct PlaceScore {
  RankingScore ranking;
  std::size_t sure = 0;  ///< matches above 0.99 that are right or wrong
  std::size_t sure_right = 0;
  std::size_t nearly = 0;  ///< matches above 0.9 up to 0.99 that are right or wrong
  std::size_t nearly_right = 0;
  std::size_t near_sure = 0;                ///< revisits within 2 m of a correct one reported above 0.99 (Newman et al.
                                            ///< 2009, Fig. 10); positions in images: within 1
  std::vector<ReliabilityBin> reliability;  ///< ascending, without empty bins
  double calibration_error = 0.0;  ///< of matches above 0.5: mean of |stated - right| over bins, weighted by matches
};

/// `mask`: of the query, ns.
PlaceScore scorePlaces(const PlaceQuery& query, const PlaceTruth& truth, urban_nav_core::StampNs mask);

}  // namespace urban_nav
