// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/yaml.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cstddef>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

constexpr int kDepth = 32;
constexpr std::size_t kNodes = 1000000;

class Converter {
 public:
  explicit Converter(std::string file) : file_(std::move(file)) {}

  // An alias is a node that occurs several times in the tree: the limits also stop documents with exponential or
  // recursive expansion.
  YamlNode convert(const YAML::Node& node, int depth) {
    YamlNode out;
    out.line = node.Mark().line + 1;
    if (depth > kDepth)
      throw UserError(atLine(file_, out.line), "nested too deeply", std::to_string(kDepth) + " levels");
    if (++count_ > kNodes) throw UserError(file_, "too many values", std::to_string(kNodes));
    if (node.IsScalar()) {
      out.kind = YamlNode::Kind::Scalar;
      out.scalar = node.Scalar();
    } else if (node.IsSequence()) {
      out.kind = YamlNode::Kind::List;
      for (const YAML::Node& each : node) out.list.push_back(convert(each, depth + 1));
    } else if (node.IsMap()) {
      out.kind = YamlNode::Kind::Map;
      for (const auto& each : node) append(out, each.first, each.second, depth);
    }
    return out;
  }

 private:
  void append(YamlNode& out, const YAML::Node& key, const YAML::Node& value, int depth) {
    const int line = key.Mark().line + 1;
    if (!key.IsScalar())
      throw UserError(atLine(file_, line), "a key that is not a word", "a word in front of the colon");
    out.map.emplace_back(key.Scalar(), convert(value, depth + 1));
    out.map.back().second.line = line;
  }

  std::string file_;
  std::size_t count_ = 0;
};

}  // namespace

const YamlNode* YamlNode::find(std::string_view key) const {
  for (const auto& [name, node] : map) {
    if (name == key) return &node;
  }
  return nullptr;
}

YamlNode readYaml(const std::string& path) { return parseYaml(readTextFile(path), path); }

YamlNode parseYaml(std::string_view text, const std::string& name) {
  std::string content(text);
  // Files of OpenCV and EuRoC begin with %YAML:1.0, which is not a valid directive. Blanks preserve line numbers.
  if (content.rfind("%YAML", 0) == 0) std::fill_n(content.begin(), std::min(content.find('\n'), content.size()), ' ');
  try {
    return Converter(name).convert(YAML::Load(content), 0);
  } catch (const YAML::Exception& error) {
    throw UserError(atLine(name, error.mark.is_null() ? 0 : error.mark.line + 1), "not YAML: " + error.msg, "");
  }
}

const YamlNode& require(const YamlNode& node, std::string_view key, const std::string& file) {
  const YamlNode* found = node.find(key);
  if (found == nullptr) throw UserError(atLine(file, node.line), "no key `" + std::string(key) + "`", "");
  return *found;
}

double requireNumber(const YamlNode& node, std::string_view key, const std::string& file) {
  const YamlNode& found = require(node, key, file);
  const auto number = found.kind == YamlNode::Kind::Scalar ? parseNumber(found.scalar) : std::nullopt;
  if (!number) throw UserError(atLine(file, found.line), std::string(key) + " = " + found.scalar, "a number");
  return *number;
}

std::vector<double> requireNumbers(const YamlNode& node, std::string_view key, std::size_t count,
                                   const std::string& file) {
  const YamlNode& found = require(node, key, file);
  const std::string wanted = std::to_string(count) + " numbers in a list";
  if (found.kind != YamlNode::Kind::List || found.list.size() != count) {
    throw UserError(atLine(file, found.line),
                    std::string(key) + " has " + std::to_string(found.list.size()) + " elements", wanted);
  }
  std::vector<double> numbers;
  for (const YamlNode& each : found.list) {
    const auto number = each.kind == YamlNode::Kind::Scalar ? parseNumber(each.scalar) : std::nullopt;
    if (!number) throw UserError(atLine(file, each.line), std::string(key) + " holds `" + each.scalar + "`", wanted);
    numbers.push_back(*number);
  }
  return numbers;
}

}  // namespace urban_nav_core
