// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace urban_nav_core {

/// A value of a parameter: bool, whole number, number, or a word out of a list.
using ParameterValue = std::variant<bool, std::int64_t, double, std::string>;

/// One row of a stage's table: all there is to say about a parameter, said once. From it come YAML, the parameter
/// server, --set, range checks, --help, the README's table and config/<pkg>.yaml.
template <typename Parameters>
struct Row {
  std::string name;                                      ///< "window"; with the stage in front it is "swf_vo.window"
  std::variant<bool Parameters::*, int Parameters::*, double Parameters::*, std::string Parameters::*> member;
  std::string unit;                                      ///< "frames", "px", "" for none
  ParameterValue standard;                               ///< the default: written here and nowhere else
  ParameterValue low = false, high = false;              ///< allowed range, ends included (numbers only)
  std::vector<std::string> words;                        ///< allowed words (words only)
  std::string sentence;                                  ///< what it does
  std::string source;                                    ///< section of the paper, publication, or measurement
};

/// A row without the type of its struct: what printing, checking and loading need.
struct RowInfo {
  std::string name, unit, sentence, source;
  ParameterValue standard, low, high;
  std::vector<std::string> words;
};

/// "1...100000 (frames)" or "schur, delete" or "true, false".
std::string allowed(const RowInfo& row);
/// Does the value have the row's type (a whole number serves as a number) and lie within its range? NaN never does.
bool isAllowed(const RowInfo& row, const ParameterValue& value);
/// As YAML writes it: "true", "25", "0.3", "schur"; shortest form that reads back exactly.
std::string printValue(const ParameterValue& value);

/// The rows of one stage. Parameters is a plain struct whose members have no initialisers.
template <typename Parameters>
class Table {
 public:
  Table(std::string stage, std::vector<Row<Parameters>> rows);

  const std::string& stage() const { return stage_; }
  const std::vector<RowInfo>& rows() const { return infos_; }
  /// Every member at its default.
  Parameters defaults() const;
  ParameterValue get(const Parameters& parameters, const std::string& name) const;
  /// The caller has checked name and value (sources.hpp does).
  void set(Parameters& parameters, const std::string& name, const ParameterValue& value) const;

 private:
  std::string stage_;
  std::vector<Row<Parameters>> rows_;
  std::vector<RowInfo> infos_;
};

}  // namespace urban_nav_core

#include "urban_nav_core/parameters/table_impl.hpp"
