// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/recording/message_definition.hpp"

#include <algorithm>
#include <boost/uuid/detail/md5.hpp>
#include <cctype>
#include <cstdint>
#include <map>
#include <sstream>
#include <stdexcept>

namespace urban_nav_input {

namespace {

constexpr std::size_t kDeepest = 64;            // messages within messages
constexpr std::size_t kLargestArray = 1 << 24;  // members of a fixed array

const std::map<std::string, FieldKind>& builtinKinds() {
  static const std::map<std::string, FieldKind> kinds = {{"bool", FieldKind::Number1},
                                                         {"byte", FieldKind::Number1},
                                                         {"char", FieldKind::Number1},
                                                         {"int8", FieldKind::Number1},
                                                         {"uint8", FieldKind::Number1},
                                                         {"int16", FieldKind::Number2},
                                                         {"uint16", FieldKind::Number2},
                                                         {"int32", FieldKind::Number4},
                                                         {"uint32", FieldKind::Number4},
                                                         {"float32", FieldKind::Number4},
                                                         {"int64", FieldKind::Number8},
                                                         {"uint64", FieldKind::Number8},
                                                         {"float64", FieldKind::Number8},
                                                         {"string", FieldKind::Text},
                                                         {"time", FieldKind::Time},
                                                         {"duration", FieldKind::Time},
                                                         {"builtin_interfaces/Time", FieldKind::Time},
                                                         {"builtin_interfaces/Duration", FieldKind::Time}};
  return kinds;
}

std::string withoutBlanks(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

/// Parses the text of each type when a member of this type is found.
class DefinitionParser {
 public:
  DefinitionParser(const std::string& type, const std::string& text) {
    std::istringstream lines(text);
    std::string current = toRos1Type(type), line;
    texts_[current];
    while (std::getline(lines, line)) {
      const std::string bare = withoutBlanks(line);
      if (bare.size() > 3 && bare.find_first_not_of('=') == std::string::npos) {
        current.clear();
      } else if (current.empty() && bare.compare(0, 4, "MSG:") == 0) {
        current = toRos1Type(withoutBlanks(bare.substr(4)));
        texts_[current].clear();
      } else if (current.empty() && bare.compare(0, 4, "IDL:") == 0) {
        throw std::invalid_argument("its definition is in IDL");
      } else {
        texts_[current] += line + "\n";
      }
    }
  }

  MessageDefinition parse(const std::string& type) {
    findLayout(toRos1Type(type), 0);
    return std::move(definition_);
  }

 private:
  std::size_t findLayout(const std::string& type, std::size_t depth) {
    if (const auto known = places_.find(type); known != places_.end()) return known->second;
    const auto text = texts_.find(type);
    if (text == texts_.end()) throw std::invalid_argument("the definition of " + type + " is missing");
    if (depth > kDeepest) throw std::invalid_argument(type + " is nested too deeply");
    const std::size_t place = definition_.layouts.size();
    definition_.layouts.push_back({type, {}, {}});
    if (!open_.insert({type, true}).second) throw std::invalid_argument(type + " contains itself");
    std::istringstream lines(text->second);
    std::string line;
    while (std::getline(lines, line)) parseLine(line, place, depth);
    open_.erase(type);
    places_[type] = place;
    return place;
  }

  void parseLine(const std::string& line, std::size_t place, std::size_t depth) {
    const std::string bare = withoutBlanks(line.substr(0, line.find('#')));
    const auto blank = bare.find_first_of(" \t");
    if (bare.empty() || blank == std::string::npos || bare[0] == '@') return;
    std::string type = bare.substr(0, blank);
    const std::string rest = withoutBlanks(bare.substr(blank));
    if (const auto equals = rest.find('='); equals != std::string::npos) {
      const bool is_text = type == "string";  // a # belongs to it
      const std::string value = is_text ? line.substr(line.find('=') + 1) : rest.substr(equals + 1);
      definition_.layouts[place].constants.push_back(type + " " + withoutBlanks(rest.substr(0, equals)) + "=" +
                                                     withoutBlanks(value));
      return;
    }
    MessageField field;
    field.name = rest.substr(0, rest.find_first_of(" \t"));  // a default value may follow
    parseArray(type, field);
    field.type = type.substr(0, type.find("<="));
    findKind(definition_.layouts[place].type, field, depth);
    definition_.layouts[place].fields.push_back(field);
  }

  static void parseArray(std::string& type, MessageField& field) {
    const auto bracket = type.find('[');
    if (bracket == std::string::npos) return;
    const std::string size = type.substr(bracket + 1, type.find(']', bracket) - bracket - 1);
    type.resize(bracket);
    field.array = MessageField::Array::Sequence;
    if (size.empty() || size.compare(0, 2, "<=") == 0) return;
    field.array = MessageField::Array::Fixed;
    field.count = 0;
    for (const char digit : size) {
      if (std::isdigit(static_cast<unsigned char>(digit)) == 0 || field.count > kLargestArray)
        throw std::invalid_argument("the size of an array, [" + size + "], is not a number");
      field.count = 10 * field.count + static_cast<std::size_t>(digit - '0');
    }
  }

  void findKind(const std::string& enclosing, MessageField& field, std::size_t depth) {
    std::string type = toRos1Type(field.type);
    if (const auto builtin = builtinKinds().find(type); builtin != builtinKinds().end()) {
      field.kind = builtin->second;
      return;
    }
    if (type == "wstring") throw std::invalid_argument("it holds a wstring");
    if (type == "Header") type = "std_msgs/Header";
    else if (type.find('/') == std::string::npos) type = enclosing.substr(0, enclosing.find('/') + 1) + type;
    field.kind = FieldKind::Message;
    field.type = type;
    field.layout = findLayout(type, depth + 1);
  }

  std::map<std::string, std::string> texts_;   // definition by type
  std::map<std::string, std::size_t> places_;  // in layouts, by type
  std::map<std::string, bool> open_;           // types being parsed
  MessageDefinition definition_;
};

std::string brackets(const MessageField& field) {
  if (field.array == MessageField::Array::None) return {};
  return field.array == MessageField::Array::Fixed ? "[" + std::to_string(field.count) + "]" : "[]";
}

std::string hash(const std::string& text) {
  boost::uuids::detail::md5 sum;
  sum.process_bytes(text.data(), text.size());
  boost::uuids::detail::md5::digest_type digest;
  sum.get_digest(digest);
  std::string hex;
  for (const auto part : digest) {  // words of 32 bits, or bytes since Boost 1.86: the highest bits come first
    constexpr const char* kDigits = "0123456789abcdef";
    for (std::size_t digit = 2 * sizeof(part); digit-- > 0;) hex += kDigits[part >> 4U * digit & 15U];
  }
  return hex;
}

std::string hashLayout(const MessageDefinition& definition, std::size_t place) {
  std::string text;
  const auto append = [&](const std::string& line) { text += (text.empty() ? "" : "\n") + line; };
  for (const std::string& constant : definition.layouts[place].constants) append(constant);
  for (const MessageField& field : definition.layouts[place].fields)
    append((field.kind == FieldKind::Message ? hashLayout(definition, field.layout) : field.type + brackets(field)) +
           " " + field.name);
  return hash(text);
}

template <typename PrintLayout>
std::string printAll(const MessageDefinition& definition, const PrintLayout& print) {
  std::string text;
  for (std::size_t i = 0; i < definition.layouts.size(); ++i) {
    if (i > 0) text += std::string(80, '=') + "\nMSG: " + definition.layouts[i].type + "\n";
    for (const std::string& constant : definition.layouts[i].constants) text += constant + "\n";
    for (const MessageField& field : definition.layouts[i].fields) text += print(definition.layouts[i], field);
  }
  return text;
}

std::string lowered(std::string text) {
  for (char& letter : text) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return text;
}

}  // namespace

std::size_t numberSize(FieldKind kind) {
  switch (kind) {
    case FieldKind::Number2: return 2;
    case FieldKind::Number4:
    case FieldKind::Time: return 4;
    case FieldKind::Number8: return 8;
    default: return 1;
  }
}

std::string toRos1Type(const std::string& type) {
  const auto middle = type.find("/msg/");
  return middle == std::string::npos ? type : type.substr(0, middle) + type.substr(middle + 4);
}

std::string toRos2Type(const std::string& type) {
  const auto slash = type.find('/');
  if (slash == std::string::npos || type.find('/', slash + 1) != std::string::npos) return type;
  return type.substr(0, slash) + "/msg" + type.substr(slash);
}

MessageDefinition parseDefinition(const std::string& type, const std::string& text) {
  return DefinitionParser(type, text).parse(type);
}

std::string computeMd5(const MessageDefinition& definition) { return hashLayout(definition, 0); }

std::string printRos1(const MessageDefinition& definition) {
  const auto print = [](const MessageLayout&, const MessageField& field) {
    std::string type = field.type;
    if (field.kind == FieldKind::Time) type = lowered(type).find("duration") != std::string::npos ? "duration" : "time";
    return type + brackets(field) + " " + field.name + "\n";
  };
  return printAll(definition, print);
}

std::string printRos2(const MessageDefinition& definition) {
  const auto print = [](const MessageLayout& layout, const MessageField& field) -> std::string {
    if (layout.type == "std_msgs/Header" && field.name == "seq") return {};
    std::string type = field.type;
    if (field.kind == FieldKind::Time)
      type = lowered(type).find("duration") != std::string::npos ? "builtin_interfaces/Duration"
                                                                 : "builtin_interfaces/Time";
    if (type == "byte") type = "int8";  // ROS 1 gives it a sign
    if (type == "char") type = "uint8";
    return type + brackets(field) + " " + lowered(field.name) + "\n";
  };
  std::string text = printAll(definition, print);
  const auto holds = [&](const char* type) { return text.find(type) != std::string::npos; };
  const auto append = [&](const char* type, const char* seconds) {
    text += std::string(80, '=') + "\nMSG: " + type + "\n" + seconds + " sec\nuint32 nanosec\n";
  };
  const bool has_time = holds("builtin_interfaces/Time"), has_duration = holds("builtin_interfaces/Duration");
  if (has_time) append("builtin_interfaces/Time", "int32");
  if (has_duration) append("builtin_interfaces/Duration", "int32");
  return text;
}

MessageDefinition withSequence(MessageDefinition definition) {
  for (MessageLayout& layout : definition.layouts) {
    if (layout.type != "std_msgs/Header" || layout.fields.empty() || layout.fields.front().name == "seq") continue;
    MessageField sequence;
    sequence.type = "uint32";
    sequence.name = "seq";
    sequence.kind = FieldKind::Number4;
    layout.fields.insert(layout.fields.begin(), sequence);
  }
  return definition;
}

MessageDefinition withoutSequence(MessageDefinition definition) {
  for (MessageLayout& layout : definition.layouts)
    if (layout.type == "std_msgs/Header" && !layout.fields.empty() && layout.fields.front().name == "seq")
      layout.fields.erase(layout.fields.begin());
  return definition;
}

}  // namespace urban_nav_input
