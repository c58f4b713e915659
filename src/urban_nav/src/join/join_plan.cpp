// SPDX-License-Identifier: BSD-3-Clause
#include "join/join_plan.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "map/closure_rows.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/parameters/print.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/digest.hpp"

namespace urban_nav {

using urban_nav_core::MetricClosure;
using urban_nav_core::UserError;

namespace {

using Parsed = nlohmann::json;

constexpr std::size_t kBlock = std::size_t{1} << 24;  // bytes of a file digested at a time
constexpr std::size_t kMostCandidates = 200;          // per piece: about 20 s
constexpr const char* kPlanFormat = "urban_nav join plan 1";
constexpr const char* kPieceFormat = "urban_nav join piece 1";

Json toJson(const PlannedStore& store) { return Json::object({{"path", store.path}, {"digest", store.digest}}); }

template <typename Element, typename Print>
Json listJson(const std::vector<Element>& elements, const Print& print) {
  Json list = Json::array();
  for (const Element& element : elements) list.append(print(element));
  return list;
}

Json listJson(const std::vector<std::string>& words) {
  return listJson(words, [](const std::string& word) { return Json(word); });
}

Json candidateJson(const MetricClosure& candidate) {
  return Json::object({{"session_a", candidate.a.session},
                       {"stamp_a_ns", candidate.a.stamp},
                       {"session_b", candidate.b.session},
                       {"stamp_b_ns", candidate.b.stamp},
                       {"probability", candidate.probability}});
}

void addContent(const PlanContent& content, Json& json) {
  json["stores"] = listJson(content.stores, [](const PlannedStore& store) { return toJson(store); });
  json["sessions"] = listJson(content.sessions, [](const PlannedSession& session) {
    return Json::object({{"id", session.id}, {"name", session.name}, {"store", session.store}});
  });
  json["parameters"] = listJson(content.parameters);
  json["camera"] = content.camera;
  json["candidates"] = listJson(content.candidates, candidateJson);
}

std::vector<std::string> readWords(const Parsed& list) {
  std::vector<std::string> words;
  for (const Parsed& word : list) words.push_back(word.get<std::string>());
  return words;
}

/// Throws the exception of nlohmann::json for a missing member or one of another type.
void readContent(const Parsed& json, PlanContent& content) {
  for (const Parsed& store : json.at("stores")) content.stores.push_back({store.at("path"), store.at("digest")});
  for (const Parsed& session : json.at("sessions")) {
    content.sessions.push_back({session.at("id"), session.at("name"), session.at("store").get<std::size_t>()});
    if (content.sessions.back().store >= content.stores.size()) throw std::out_of_range("no such store");
  }
  content.parameters = readWords(json.at("parameters"));
  content.camera = json.at("camera");
  for (const Parsed& row : json.at("candidates")) {
    urban_nav_core::TopologicalClosure closure;
    closure.a = {row.at("session_a"), row.at("stamp_a_ns").get<urban_nav_core::StampNs>()};
    closure.b = {row.at("session_b"), row.at("stamp_b_ns").get<urban_nav_core::StampNs>()};
    closure.probability = row.at("probability").get<double>();
    content.candidates.push_back(toCandidate(closure, "places"));
  }
}

/// Calls `read` with the parsed content of a file of this format.
template <typename Read>
void readFormat(const std::string& path, const char* format, const std::string& expected, const Read& read) {
  const std::string text = urban_nav_core::readBytes(path);
  try {
    const Parsed json = Parsed::parse(text);
    if (json.at("format") != format) throw std::out_of_range("another format");
    read(json);
  } catch (const std::exception& error) {  // of nlohmann::json, and those above
    throw UserError(path, std::string("cannot be read: ") + error.what(), expected);
  }
}

JoinPiece makePiece(const JoinPlan& plan, std::pair<std::size_t, std::size_t> stores) {
  JoinPiece piece;
  piece.stores.push_back(plan.stores[stores.first]);
  if (stores.second != stores.first) piece.stores.push_back(plan.stores[stores.second]);
  for (PlannedSession session : plan.sessions) {
    if (session.store != stores.first && session.store != stores.second) continue;
    session.store = session.store == stores.first ? 0 : 1;
    piece.sessions.push_back(std::move(session));
  }
  piece.parameters = plan.parameters;
  piece.camera = plan.camera;
  return piece;
}

}  // namespace

std::string digestOfFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw UserError(path, "cannot be read", "a file that can be read");
  std::string digests, block(kBlock, '\0');
  do {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    digests += urban_nav_store::sha256(std::string_view(block).substr(0, static_cast<std::size_t>(file.gcount())));
  } while (file);
  return urban_nav_store::sha256(digests);
}

std::vector<JoinPiece> splitPlan(JoinPlan& plan) {
  std::map<std::pair<std::size_t, std::size_t>, std::vector<MetricClosure>> by_stores;
  for (std::size_t a = 0; a < plan.stores.size(); ++a)
    for (std::size_t b = a + 1; b < plan.stores.size(); ++b) by_stores[{a, b}];
  std::map<std::string, std::size_t> store_of;
  for (const PlannedSession& session : plan.sessions) store_of[session.name] = session.store;
  for (const MetricClosure& candidate : plan.candidates)
    by_stores[std::minmax({store_of.at(candidate.a.session), store_of.at(candidate.b.session)})].push_back(candidate);
  std::vector<JoinPiece> pieces;
  for (const auto& [stores, candidates] : by_stores) {
    std::size_t first = 0;
    do {
      const std::size_t last = std::min(candidates.size(), first + kMostCandidates);
      pieces.push_back(makePiece(plan, stores));
      pieces.back().candidates.assign(candidates.begin() + static_cast<std::ptrdiff_t>(first),
                                      candidates.begin() + static_cast<std::ptrdiff_t>(last));
      first = last;
    } while (first < candidates.size());
  }
  std::string bytes;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    plan.pieces.push_back("piece_" + std::string(6 - std::min<std::size_t>(6, number.size()), '0') + number + ".json");
    bytes += toJson(pieces[i]).print();
  }
  plan.digest.clear();
  plan.digest = urban_nav_store::sha256(toJson(plan).print() + bytes);
  for (JoinPiece& piece : pieces) piece.plan = plan.digest;
  return pieces;
}

Json toJson(const JoinPlan& plan) {
  Json json = Json::object({{"format", kPlanFormat}, {"digest", plan.digest}});
  addContent(plan, json);
  json["pieces"] = listJson(plan.pieces);
  json["warnings"] = listJson(plan.warnings);
  return json;
}

Json toJson(const JoinPiece& piece) {
  Json json = Json::object({{"format", kPieceFormat}, {"plan", piece.plan}});
  addContent(piece, json);
  return json;
}

JoinPlan readPlan(const std::string& path) {
  JoinPlan plan;
  readFormat(path, kPlanFormat, "plan.json of urban_nav join --plan", [&](const Parsed& json) {
    plan.digest = json.at("digest");
    readContent(json, plan);
    plan.pieces = readWords(json.at("pieces"));
    plan.warnings = readWords(json.at("warnings"));
  });
  return plan;
}

JoinPiece readPiece(const std::string& path) {
  JoinPiece piece;
  readFormat(path, kPieceFormat, "a piece of urban_nav join --plan", [&](const Parsed& json) {
    piece.plan = json.at("plan");
    readContent(json, piece);
  });
  return piece;
}

std::vector<std::string> chosenParameters(const ParameterSet& parameters) {
  std::vector<std::string> chosen;
  for (const urban_nav_core::Setting& setting : parameters.settings())
    if (setting.origin != "default" && setting.name != "memory_mb")
      chosen.push_back(urban_nav_core::fullName(setting.stage, setting.name) + "=" +
                       urban_nav_core::printValue(setting.value));
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace urban_nav
