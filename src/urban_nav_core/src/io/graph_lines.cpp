// SPDX-License-Identifier: BSD-3-Clause
#include "io/graph_lines.hpp"

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {

std::string_view withoutByteOrderMark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  return text.substr(0, kMark.size()) == kMark ? text.substr(kMark.size()) : text;
}

GraphLines::GraphLines(std::string name, UnknownTags unknown, std::string known_tags, std::string two_kinds)
    : name_(std::move(name)), unknown_(unknown), known_tags_(std::move(known_tags)), two_kinds_(std::move(two_kinds)) {}

GraphLines::Words GraphLines::begin(std::string_view text, int number) {
  where_ = atLine(name_, number);
  const std::size_t comment = text.find('#');
  const bool after_words = comment != std::string_view::npos && text.find_first_not_of(" \t") < comment;
  return splitBlanks(after_words ? text.substr(0, comment) : text);
}

void GraphLines::demandColumns(const Words& words, std::size_t columns, int dimension) {
  if (words.size() != columns)
    refuse(std::string(words[0]) + " with " + std::to_string(words.size()) + " columns", std::to_string(columns));
  if (has_dimension_ && graph_.dimension != dimension) refuse(two_kinds_ + " in one file", "one of them");
  graph_.dimension = dimension;
  has_dimension_ = true;
}

G2oGraph::Id GraphLines::id(std::string_view word) const {
  const auto value = parseInteger(word);
  if (!value) refuse("vertex `" + std::string(word) + "`", "whole numbers");
  return *value;
}

double GraphLines::number(std::string_view word) const {
  const auto value = parseNumber(word);
  if (!value) refuse("`" + std::string(word) + "`", "a finite number");
  return *value;
}

void GraphLines::refuse(const std::string& what, const std::string& allowed) const {
  throw UserError(where_, what, allowed);
}

void GraphLines::add(const G2oGraph::Vertex& vertex) {
  if (!known_.insert(vertex.id).second) refuse("duplicate vertex " + std::to_string(vertex.id), "");
  graph_.lines.push_back({G2oGraph::Kind::Vertex, graph_.vertices.size()});
  graph_.vertices.push_back(vertex);
}

void GraphLines::add(const G2oGraph::Edge& edge) {
  graph_.lines.push_back({G2oGraph::Kind::Edge, graph_.edges.size()});
  graph_.edges.push_back(edge);
}

void GraphLines::add(const G2oGraph::Point& point) {
  if (!known_.insert(point.id).second) refuse("duplicate vertex " + std::to_string(point.id), "");
  graph_.lines.push_back({G2oGraph::Kind::Point, graph_.points.size()});
  graph_.points.push_back(point);
}

void GraphLines::add(const G2oGraph::PointEdge& edge) {
  graph_.lines.push_back({G2oGraph::Kind::PointEdge, graph_.point_edges.size()});
  graph_.point_edges.push_back(edge);
}

void GraphLines::add(const G2oGraph::Prior& prior) {
  graph_.lines.push_back({G2oGraph::Kind::Prior, graph_.priors.size()});
  graph_.priors.push_back(prior);
}

void GraphLines::add(const G2oGraph::Offset& offset) {
  if (!known_offsets_.insert(offset.id).second) refuse("duplicate parameter " + std::to_string(offset.id), "");
  graph_.lines.push_back({G2oGraph::Kind::Offset, graph_.offsets.size()});
  graph_.offsets.push_back(offset);
}

void GraphLines::fix(const Words& words) {
  if (words.size() == 1) refuse("FIX without a vertex", "FIX id");
  for (std::size_t i = 1; i < words.size(); ++i) {
    graph_.lines.push_back({G2oGraph::Kind::Fix, graph_.fixed.size()});
    graph_.fixed.push_back(id(words[i]));
  }
}

void GraphLines::other(std::string_view text, std::string_view tag) {
  if (unknown_ == UnknownTags::Refuse && tag.front() != '#') refuse("unknown tag " + std::string(tag), known_tags_);
  graph_.lines.push_back({G2oGraph::Kind::Other, graph_.others.size()});
  graph_.others.emplace_back(text);
}

}  // namespace urban_nav_core
