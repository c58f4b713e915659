// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace urban_nav_core {

/// A YAML document as a plain tree; every node knows its line. The only door to yaml-cpp, so that no other file
/// includes it.
struct YamlNode {
  enum class Kind { Null, Scalar, List, Map };
  Kind kind = Kind::Null;
  std::string scalar;
  std::vector<YamlNode> list;
  std::vector<std::pair<std::string, YamlNode>> map;  ///< in the order of the file, doubled keys included
  int line = 0;                                       ///< from 1

  /// The value of the first such key of a map, or nullptr.
  const YamlNode* find(std::string_view key) const;
};

/// Throws UserError with file and line for what is not YAML, and for trees deeper than 32 or of more than a million
/// nodes.
YamlNode readYaml(const std::string& path);
YamlNode parseYaml(std::string_view text, const std::string& name);

/// The value below `key`, a number, or several in a list. Throws UserError with file, line and key where it is missing,
/// no number, not finite, or of another length.
const YamlNode& require(const YamlNode& node, std::string_view key, const std::string& file);
double requireNumber(const YamlNode& node, std::string_view key, const std::string& file);
std::vector<double> requireNumbers(const YamlNode& node, std::string_view key, std::size_t count,
                                   const std::string& file);

}  // namespace urban_nav_core
