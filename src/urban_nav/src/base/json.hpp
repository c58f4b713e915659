// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace urban_nav {

/// A JSON value that keeps its keys in the order they were set. Numbers that are not finite print as null.
class Json {
 public:
  Json() = default;
  Json(bool value) : value_(value) {}                                    // NOLINT: a literal is a value
  Json(int value) : value_(static_cast<std::int64_t>(value)) {}          // NOLINT
  Json(std::int64_t value) : value_(value) {}                            // NOLINT
  Json(std::size_t value) : value_(static_cast<std::int64_t>(value)) {}  // NOLINT
  Json(double value) : value_(value) {}                                  // NOLINT
  Json(const char* value) : value_(std::string(value)) {}                // NOLINT
  Json(std::string value) : value_(std::move(value)) {}                  // NOLINT

  static Json object();
  /// Returns an object with these members, in this order.
  static Json object(std::vector<std::pair<std::string, Json>> members);
  static Json array();

  /// Returns the value of a key, inserted as null if missing. Converts null to an object.
  Json& operator[](const std::string& key);
  void append(Json element);
  bool isObject() const { return std::holds_alternative<Members>(value_); }
  bool has(const std::string& key) const;

  /// Returns names and texts of all values in an object, with nested names joined by points: "gps.fixes", "12".
  std::vector<std::pair<std::string, std::string>> flat() const;

  /// Prints with an indentation of two blanks and a final newline.
  std::string print() const;

 private:
  friend struct JsonPrinter;
  using Members = std::vector<std::pair<std::string, Json>>;
  using Elements = std::vector<Json>;
  std::variant<std::monostate, bool, std::int64_t, double, std::string, Elements, Members> value_;
};

}  // namespace urban_nav
