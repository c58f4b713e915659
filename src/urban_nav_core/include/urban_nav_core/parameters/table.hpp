// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace urban_nav_core {

/// A value of a parameter: bool, whole number, number, or a word out of a list. The constructors keep `25` a whole
/// number and "schur" a word on compilers whose std::variant would make a bool of either.
struct ParameterValue : std::variant<bool, std::int64_t, double, std::string> {
  using Base = std::variant<bool, std::int64_t, double, std::string>;
  ParameterValue() : Base(false) {}
  ParameterValue(bool value) : Base(value) {}
  ParameterValue(int value) : Base(std::int64_t{value}) {}
  ParameterValue(std::int64_t value) : Base(value) {}
  ParameterValue(double value) : Base(value) {}
  ParameterValue(const char* value) : Base(std::string(value)) {}
  ParameterValue(std::string value) : Base(std::move(value)) {}

  const Base& base() const { return *this; }
};

/// Audience of a parameter. `--help` lists those of users, `--help-all` every one.
enum class Audience {
  Users,
  Experts,  ///< thresholds and sizes inside an algorithm
};

/// One row of a stage's table: all there is to say about a parameter, said once. From it come YAML, the parameter
/// server, --set, range checks, --help, the README's table and config/<pkg>.yaml.
template <typename Parameters>
struct Row {
  std::string name;  ///< "window"; with the stage in front it is "swf_vo.window"
  std::variant<bool Parameters::*, int Parameters::*, double Parameters::*, std::string Parameters::*> member;
  std::string unit;                          ///< "frames", "px", "" for none
  ParameterValue standard;                   ///< the default: written here and nowhere else
  ParameterValue low = false, high = false;  ///< allowed range, ends included (numbers only)
  std::vector<std::string> words;            ///< allowed words (words only; empty: any text)
  std::string sentence;                      ///< what it does
  std::string source;                        ///< `paper 2.4`, publication, `docs/...` or bench that measured it
  std::vector<std::string> old_names = {};   ///< still understood, see old_names.hpp: "queue", or "loop_metric.queue"
  Audience audience = Audience::Users;
};

enum class ParameterType { Bool, Integer, Number, Word };

/// A row without the type of its struct: what printing, checking and loading need.
struct RowInfo {
  std::string name, unit, sentence, source;
  ParameterType type = ParameterType::Bool;
  ParameterValue standard, low, high;
  std::vector<std::string> words;
  std::vector<std::string> old_names = {};
  Audience audience = Audience::Users;
};

/// "1...100000 (frames)" or "numbers 0...1 (px)" or "schur, delete" or "true, false".
std::string allowed(const RowInfo& row);
/// Does the value have the row's type (a whole number serves as a number) and lie within its range? NaN never does.
bool isAllowed(const RowInfo& row, const ParameterValue& value);
/// As YAML writes it: "true", "25", "0.3", "schur"; shortest form that reads back exactly. Text that YAML would take
/// for something else is quoted.
std::string printValue(const ParameterValue& value);
/// "swf_vo.window"; the name alone where the stage is "" (keys of the command itself, such as memory_mb).
std::string fullName(const std::string& stage, const std::string& name);

/// Asserts what a programmer owes a table: different names, defaults of the right type and within their ranges, a
/// sentence in each row.
void assertSound(const std::string& stage, const std::vector<RowInfo>& rows);

/// The rows of one stage. Parameters is a plain struct whose members have no initialisers. Immutable, so thread-safe.
template <typename Parameters>
class Table {
 public:
  Table(std::string stage, std::vector<Row<Parameters>> rows);

  const std::string& stage() const { return stage_; }
  const std::vector<RowInfo>& rows() const { return infos_; }
  /// Sets every member to its default: what the constructor of Parameters calls.
  void setDefaults(Parameters& parameters) const;
  /// The caller has checked the name (sources.hpp does): an unknown one is an assertion.
  ParameterValue get(const Parameters& parameters, const std::string& name) const;
  /// The caller has checked name and value (sources.hpp does).
  void set(Parameters& parameters, const std::string& name, const ParameterValue& value) const;

 private:
  const Row<Parameters>& row(const std::string& name) const;

  std::string stage_;
  std::vector<Row<Parameters>> rows_;
  std::vector<RowInfo> infos_;
};

}  // namespace urban_nav_core

#include "urban_nav_core/parameters/table_impl.hpp"
