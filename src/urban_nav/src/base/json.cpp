// SPDX-License-Identifier: BSD-3-Clause
#include "base/json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace urban_nav {

struct JsonPrinter {
  static nlohmann::ordered_json convert(const Json& json) {
    return std::visit([](const auto& value) { return of(value); }, json.value_);
  }
  static nlohmann::ordered_json of(const std::monostate&) { return nullptr; }
  template <typename Plain>
  static nlohmann::ordered_json of(const Plain& value) {
    return value;
  }
  static nlohmann::ordered_json of(const Json::Elements& elements) {
    auto result = nlohmann::ordered_json::array();
    for (const Json& element : elements) result.push_back(convert(element));
    return result;
  }
  static nlohmann::ordered_json of(const Json::Members& members) {
    auto result = nlohmann::ordered_json::object();
    for (const auto& [key, value] : members) result[key] = convert(value);
    return result;
  }
};

Json Json::object() {
  Json json;
  json.value_ = Members();
  return json;
}

Json Json::object(std::vector<std::pair<std::string, Json>> members) {
  Json json;
  json.value_ = std::move(members);
  return json;
}

Json Json::array() {
  Json json;
  json.value_ = Elements();
  return json;
}

Json& Json::operator[](const std::string& key) {
  if (!isObject()) value_ = Members();
  Members& members = std::get<Members>(value_);
  const auto found =
      std::find_if(members.begin(), members.end(), [&](const auto& member) { return member.first == key; });
  if (found != members.end()) return found->second;
  members.emplace_back(key, Json());
  return members.back().second;
}

void Json::append(Json element) {
  if (!std::holds_alternative<Elements>(value_)) value_ = Elements();
  std::get<Elements>(value_).push_back(std::move(element));
}

bool Json::has(const std::string& key) const {
  const Members* members = std::get_if<Members>(&value_);
  return members != nullptr &&
         std::any_of(members->begin(), members->end(), [&](const auto& member) { return member.first == key; });
}

std::vector<std::pair<std::string, std::string>> Json::flat() const {
  std::vector<std::pair<std::string, std::string>> values;
  const auto* members = std::get_if<Members>(&value_);
  if (members == nullptr) return values;
  for (const auto& [name, member] : *members) {
    if (member.isObject()) {
      for (auto& [inner, text] : member.flat()) values.emplace_back(name + "." + inner, std::move(text));
    } else if (const auto* text = std::get_if<std::string>(&member.value_)) {
      values.emplace_back(name, *text);
    } else {
      values.emplace_back(name, JsonPrinter::convert(member).dump());
    }
  }
  return values;
}

std::string Json::print() const {
  return JsonPrinter::convert(*this).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace urban_nav
