// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace urban_nav_core {

/// YAML document as a plain tree; every node has its line number. Wraps yaml-cpp, which no other file includes.
struct YamlNode {
  enum class Kind { Null, Scalar, List, Map };
  Kind kind = Kind::Null;
  std::string scalar;
  std::vector<YamlNode> list;
  std::vector<std::pair<std::string, YamlNode>> map;  ///< in file order, including duplicate keys
  int line = 0;                                       ///< from 1

  /// Returns the value of the first such key of a map, or nullptr.
  const YamlNode* find(std::string_view key) const;
};

/// Reads a document. Throws UserError with file and line for invalid YAML, and for trees deeper than 32 or with more
/// than a million nodes.
YamlNode readYaml(const std::string& path);
YamlNode parseYaml(std::string_view text, const std::string& name);

/// Return the value of `key`: a node, a number, or a list of numbers. Throw UserError with file, line and key if it is
/// missing, not numeric, not finite, or of another length.
const YamlNode& require(const YamlNode& node, std::string_view key, const std::string& file);
double requireNumber(const YamlNode& node, std::string_view key, const std::string& file);
std::vector<double> requireNumbers(const YamlNode& node, std::string_view key, std::size_t count,
                                   const std::string& file);

}  // namespace urban_nav_core
