// SPDX-License-Identifier: BSD-3-Clause
#include "base/plot.hpp"
#include "topics/places/place_pair.hpp"
#include "topics/places/place_pair_picture.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav {

namespace {

std::string printEnd(const PlacePair::End& end) {
  return end.name + " +" + urban_nav_core::formatNumber(end.since, 6) + " s (" +
         urban_nav_core::printStamp(end.row.stamp) + ")";
}

/// Returns rows of name and value.
std::vector<std::vector<std::string>> placeFigures(const PlacePair& pair) {
  std::vector<std::vector<std::string>> rows = {{"words", std::to_string(pair.earlier.words) + " and " +
                                                              std::to_string(pair.query.words) + ", shared " +
                                                              std::to_string(pair.shared_words)}};
  if (!pair.comparison) return rows;
  const fabmap_node::PlaceComparison& comparison = *pair.comparison;
  const fabmap_node::PlaceMatch& match = comparison.match;
  const std::string rank = pair.is_masked ? ""
                                          : "; rank " + std::to_string(comparison.rank_by_words) + " of " +
                                                std::to_string(comparison.candidates) + " places";
  rows.push_back(
      {"log likelihood at the place", urban_nav_core::formatNumber(match.log_likelihood, 6) + " nats" + rank});
  rows.push_back(
      {"log likelihood at a new place", urban_nav_core::formatNumber(match.log_likelihood_new, 6) + " nats"});
  rows.push_back(
      {"ratio to a new place, per word", urban_nav_core::formatNumber(match.evidence.word_ratio, 3) + " nats"});
  rows.push_back({"ratio to the likeliest place elsewhere, per word",
                  urban_nav_core::formatNumber(match.evidence.word_margin, 3) + " nats"});
  rows.push_back({"descriptors", std::to_string(comparison.look.matches) + " match, " +
                                     std::to_string(comparison.look.agreeing) + " of them agree"});
  rows.push_back({"share that agrees, square root", urban_nav_core::formatNumber(match.evidence.look, 3) +
                                                        "; beyond the best place elsewhere " +
                                                        urban_nav_core::formatNumber(match.evidence.look_margin, 3)});
  rows.push_back({"probability, from this observation only",
                  urban_nav_core::formatNumber(pair.probability, 4) + "; proposed above " +
                      urban_nav_core::formatNumber(pair.closure_probability)});
  return rows;
}

}  // namespace

std::string explain(const PlacePair& pair) {
  std::string text = "no closure was proposed between " + printEnd(pair.earlier) + " and " + printEnd(pair.query) +
                     "\n  " + pair.reason + "\n";
  for (const std::vector<std::string>& row : placeFigures(pair)) text += "    " + row[0] + ": " + row[1] + "\n";
  return text;
}

Page explainOnPage(const PlacePair& pair, const std::string& store_path) {
  Page page;
  page.title = "Why: no closure";
  page.subtitle = printEnd(pair.earlier) + " and " + printEnd(pair.query);
  page.verdicts.push_back({Grade::Plain, "Not proposed.", pair.reason + "."});
  Section section{"places", "Place recognition", "", {}, {}, {{"Evidence", {"", ""}, placeFigures(pair), ""}}};
  if (auto picture =
          placePairPicture(pair.earlier.row.thumbnail, pair.query.row.thumbnail, "Above: the place; below: the query."))
    section.pictures.push_back(std::move(*picture));
  page.sections.push_back(std::move(section));
  page.footer = "urban_nav why, from the places in " + store_path + ".";
  return page;
}

Json explainAsJson(const PlacePair& pair) {
  Json json = Json::object();
  json["session_a"] = pair.earlier.name;
  json["stamp_a_ns"] = pair.earlier.row.stamp;
  json["session_b"] = pair.query.name;
  json["stamp_b_ns"] = pair.query.row.stamp;
  json["proposed"] = false;
  json["reason"] = pair.reason;
  json["words_a"] = static_cast<std::int64_t>(pair.earlier.words);
  json["words_b"] = static_cast<std::int64_t>(pair.query.words);
  json["words_shared"] = static_cast<std::int64_t>(pair.shared_words);
  json["closure_probability"] = pair.closure_probability;
  if (!pair.comparison) return json;
  const fabmap_node::PlaceComparison& comparison = *pair.comparison;
  json["log_likelihood"] = comparison.match.log_likelihood;
  json["log_likelihood_new"] = comparison.match.log_likelihood_new;
  json["rank_by_words"] = static_cast<std::int64_t>(comparison.rank_by_words);
  json["candidates"] = static_cast<std::int64_t>(comparison.candidates);
  json["descriptors_matched"] = static_cast<std::int64_t>(comparison.look.matches);
  json["descriptors_agreeing"] = static_cast<std::int64_t>(comparison.look.agreeing);
  json["probability"] = pair.probability;
  return json;
}

}  // namespace urban_nav
