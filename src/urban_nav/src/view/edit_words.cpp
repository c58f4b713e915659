// SPDX-License-Identifier: BSD-3-Clause
#include "view/edit_words.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "edits/edit_request.hpp"
#include "urban_nav_core/io/text.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_core::UserError;

namespace {

constexpr std::size_t kMostWords = 4;       // in the longest action
constexpr std::size_t kLongestWord = 1024;  // bytes; the name of a session with seconds, or seven numbers
constexpr std::array<const char*, 5> kEditOptions = {"pose", "sigma", "at", "geodetic", "point"};

constexpr const char* kExpectedEdit = R"({"action": "reject", "arguments": ["3"]}, with the words of `urban_nav edge`)";

std::string checkedWord(const nlohmann::json& value, const std::string& where) {
  if (!value.is_string()) throw UserError(where, "is not a string", kExpectedEdit);
  const std::string& word = value.get_ref<const std::string&>();
  if (word.size() > kLongestWord)
    throw UserError(where, std::to_string(word.size()) + " bytes", "at most " + std::to_string(kLongestWord));
  if (std::any_of(word.begin(), word.end(), [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; }))
    throw UserError(where, "holds a control character", "a line of text");
  if (!word.empty() && word.front() == '-' && word.rfind("--", 0) == 0)
    throw UserError(where, word, "options in \"options\"");
  return word;
}

}  // namespace

std::string EditWords::print() const {
  std::string text = action;
  for (const std::string& word : arguments) text += " " + word;
  for (const auto& [name, value] : options) text += " --" + name + " " + value;
  return text;
}

EditWords parseEditWords(std::string_view text) {
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) throw UserError("request", "is not a JSON object", kExpectedEdit);
  for (const auto& [key, value] : json.items())
    if (key != "action" && key != "arguments" && key != "options")
      throw UserError("request", "has a member \"" + key.substr(0, 40) + "\"", kExpectedEdit);
  EditWords words;
  if (!json.contains("action")) throw UserError("request", "has no \"action\"", kExpectedEdit);
  words.action = checkedWord(json["action"], "action");
  const std::vector<std::string>& actions = editActions();
  if (std::find(actions.begin(), actions.end(), words.action) == actions.end())
    throw UserError("action", words.action, urban_nav_core::joined(actions));
  if (json.contains("arguments")) {
    if (!json["arguments"].is_array() || json["arguments"].size() > kMostWords)
      throw UserError("arguments", "are not a short list", kExpectedEdit);
    for (const nlohmann::json& word : json["arguments"]) words.arguments.push_back(checkedWord(word, "arguments"));
  }
  if (!json.contains("options")) return words;
  if (!json["options"].is_object()) throw UserError("options", "are not an object", kExpectedEdit);
  for (const auto& [name, value] : json["options"].items()) {
    if (std::find(kEditOptions.begin(), kEditOptions.end(), name) == kEditOptions.end())
      throw UserError("options", name.substr(0, 40), "pose, sigma, at, geodetic, point");
    words.options[name] = checkedWord(value, name);
  }
  return words;
}

}  // namespace urban_nav
