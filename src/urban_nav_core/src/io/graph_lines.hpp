// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/io/g2o.hpp"

namespace urban_nav_core {

/// Returns the text without a byte order mark.
std::string_view withoutByteOrderMark(std::string_view text);

/// Common parser of the text formats of pose graphs: lines of a tag, vertex ids and numbers. All members throw
/// UserError naming file and line for invalid input.
class GraphLines {
 public:
  using Words = std::vector<std::string_view>;

  /// `two_kinds`: names the two dimensions in errors ("SE2 and SE3").
  GraphLines(std::string name, UnknownTags unknown, std::string known_tags, std::string two_kinds);

  /// Returns the words of the next line, without a trailing comment; empty for a blank line. A line that is entirely a
  /// comment is returned as words.
  Words begin(std::string_view text, int number);

  void demandColumns(const Words& words, std::size_t columns, int dimension);
  G2oGraph::Id id(std::string_view word) const;
  double number(std::string_view word) const;
  [[noreturn]] void refuse(const std::string& what, const std::string& allowed) const;

  void add(const G2oGraph::Vertex& vertex);
  void add(const G2oGraph::Edge& edge);
  void add(const G2oGraph::Point& point);
  void add(const G2oGraph::PointEdge& edge);
  void add(const G2oGraph::Prior& prior);
  void add(const G2oGraph::Offset& offset);
  void fix(const Words& words);
  /// Handles a line with an unknown tag.
  void other(std::string_view text, std::string_view tag);

  G2oGraph take() { return std::move(graph_); }

 private:
  std::string name_, where_;
  UnknownTags unknown_;
  std::string known_tags_, two_kinds_;
  bool has_dimension_ = false;
  std::set<G2oGraph::Id> known_, known_offsets_;
  G2oGraph graph_;
};

}  // namespace urban_nav_core
