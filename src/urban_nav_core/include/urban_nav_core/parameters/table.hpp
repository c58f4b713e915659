// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace urban_nav_core {

/// Value of a parameter: bool, integer, number, or a word from a list. The constructors keep `25` an integer and
/// "schur" a word with compilers whose std::variant would convert either to bool.
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

/// Audience of a parameter. `--help` lists those for users, `--help-all` every one.
enum class Audience {
  Users,
  Experts,  ///< thresholds and sizes inside an algorithm
};

/// Row of a stage's parameter table, the only description of a parameter. YAML, the parameter server, --set, range
/// checks, --help, the README's table and `config/<pkg>.yaml` are derived from it.
template <typename Parameters>
struct Row {
  std::string name;  ///< "window"; prefixed by its stage it is "swf_vo.window"
  std::variant<bool Parameters::*, int Parameters::*, double Parameters::*, std::string Parameters::*> member;
  std::string unit;                          ///< "frames", "px"; "" for dimensionless
  ParameterValue standard;                   ///< default, defined only here
  ParameterValue low = false, high = false;  ///< range, inclusive (numbers only)
  std::vector<std::string> words;            ///< allowed words (words only; empty: any text)
  std::string sentence;                      ///< what it does
  std::string source;                        ///< `paper 2.4`, publication, `docs/...` or the bench that measured it
  std::vector<std::string> old_names = {};   ///< accepted as well, see old_names.hpp: "queue", or "loop_metric.queue"
  Audience audience = Audience::Users;
};
/// Type of the value of a parameter.
enum class ParameterType { Bool, Integer, Number, Word };

/// Row without the type of its struct, for printing, checking and loading.
struct RowInfo {
  std::string name, unit, sentence, source;
  ParameterType type = ParameterType::Bool;
  ParameterValue standard, low, high;
  std::vector<std::string> words;
  std::vector<std::string> old_names = {};
  Audience audience = Audience::Users;
};

/// Returns "1...100000 (frames)", "numbers 0...1 (px)", "schur, delete" or "true, false".
std::string allowed(const RowInfo& row);
/// Returns whether the value has the row's type (an integer is valid for a number) and is within its range. NaN is not.
bool isAllowed(const RowInfo& row, const ParameterValue& value);
/// Returns the value in YAML: "true", "25", "0.3", "schur"; the shortest form that is read back exactly. Text that YAML
/// would parse as another type is quoted.
std::string printValue(const ParameterValue& value);
/// Returns "swf_vo.window"; the name only if the stage is "" (keys of the command itself, such as memory_mb).
std::string fullName(const std::string& stage, const std::string& name);

/// Asserts that a table is valid: unique names, defaults of the right type and within range, a description in each row.
void assertSound(const std::string& stage, const std::vector<RowInfo>& rows);

/// Rows of one stage. Parameters is a plain struct whose members have no initialisers. Immutable, hence thread-safe.
template <typename Parameters>
class Table {
 public:
  Table(std::string stage, std::vector<Row<Parameters>> rows);

  const std::string& stage() const { return stage_; }
  const std::vector<RowInfo>& rows() const { return infos_; }
  /// Sets every member to its default; called by the constructor of Parameters.
  void setDefaults(Parameters& parameters) const;
  /// Requires that the caller has checked the name, as sources.hpp does; asserts on an unknown one.
  ParameterValue get(const Parameters& parameters, const std::string& name) const;
  /// Requires that the caller has checked name and value, as sources.hpp does.
  void set(Parameters& parameters, const std::string& name, const ParameterValue& value) const;

 private:
  const Row<Parameters>& row(const std::string& name) const;

  std::string stage_;
  std::vector<Row<Parameters>> rows_;
  std::vector<RowInfo> infos_;
};

}  // namespace urban_nav_core

#include "urban_nav_core/parameters/table_impl.hpp"
