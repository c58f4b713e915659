// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/parameters/table.hpp"

namespace urban_nav_core::testing {

/// Value of one row of a table: {"window", 5}.
struct ParameterChange {
  std::string name;
  ParameterValue value;
};

/// Run of a core whose result depends on parameters, and the changes that must affect it.
template <typename Parameters>
struct ParameterExperiment {
  using Run = std::function<std::string(const Parameters&)>;
  using Changes = std::vector<ParameterChange>;
  ParameterExperiment(std::string title, Run function, Changes tested, Changes beside = {})
      : name(std::move(title)), run(std::move(function)), changes(std::move(tested)), conditions(std::move(beside)) {}

  std::string name;    ///< for messages: "map of a street"
  Run run;             ///< returns the result as bytes or text, equal for equal parameters
  Changes changes;     ///< each of them, applied alone, must change the result
  Changes conditions;  ///< apply to all runs: for a row that has an effect only in combination with others
};

/// Row whose effect is tested elsewhere, because it does not concern results (threads, memory, rates) or because
/// another package uses it.
struct ParameterTest {
  std::string name;         ///< "queue"
  std::string test;         ///< "LiveMapper.DropsTheOldestScans"
  std::string folder = "";  ///< source folder of tests of another binary: path from the folder of this package
};

namespace detail {

/// Returns whether a source in the folder or its subfolders has the test "Suite.Name".
inline bool hasTest(const std::string& folder, const std::string& test) {
  const std::size_t dot = test.find('.');
  const std::string head = "(" + test.substr(0, dot) + ", " + test.substr(dot + 1) + ")";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".cpp" && readTextFile(entry.path().string()).find(head) != std::string::npos)
      return true;
  return false;
}

/// Returns whether the test exists, in this binary or in the folder.
inline bool exists(const ParameterTest& wanted) {
  if (!wanted.folder.empty()) return hasTest(wanted.folder, wanted.test);
  const ::testing::UnitTest& all = *::testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const ::testing::TestSuite& suite = *all.GetTestSuite(i);
    for (int j = 0; j < suite.total_test_count(); ++j)
      if (std::string(suite.name()) + "." + suite.GetTestInfo(j)->name() == wanted.test) return true;
  }
  return false;
}

template <typename Parameters>
const RowInfo* findRow(const Table<Parameters>& table, const std::string& name) {
  const std::vector<RowInfo>& rows = table.rows();
  const auto row = std::find_if(rows.begin(), rows.end(), [&name](const RowInfo& each) { return each.name == name; });
  return row == rows.end() ? nullptr : &*row;
}

/// Sets one value; returns a description of an invalid change, or an empty text.
template <typename Parameters>
std::string applyChange(const Table<Parameters>& table, const ParameterChange& change, Parameters& parameters) {
  const RowInfo* row = findRow(table, change.name);
  if (row == nullptr) return "is no row of the table";
  if (!isAllowed(*row, change.value)) return "is not allowed: " + allowed(*row);
  const Parameters before = parameters;
  table.set(parameters, change.name, change.value);
  const bool is_same = table.get(before, change.name) == table.get(parameters, change.name);
  return is_same ? "is the value without the change" : "";
}

/// Runs one experiment; returns a line for each change that is invalid or has no effect.
template <typename Parameters>
std::string runExperiment(const Table<Parameters>& table, const ParameterExperiment<Parameters>& experiment) {
  std::string faults;
  const auto report = [&](const ParameterChange& change, const std::string& fault) {
    faults += fullName(table.stage(), change.name) + " = " + printValue(change.value) + " " + fault + " (" +
              experiment.name + ")\n";
  };
  Parameters conditions;
  for (const ParameterChange& condition : experiment.conditions)
    if (const std::string fault = applyChange(table, condition, conditions); !fault.empty()) report(condition, fault);
  const std::string without_change = experiment.run(conditions);
  if (experiment.run(conditions) != without_change) return experiment.name + ": two equal runs differ\n";
  for (const ParameterChange& change : experiment.changes) {
    Parameters changed = conditions;
    const std::string fault = applyChange(table, change, changed);
    if (!fault.empty()) report(change, fault);
    else if (experiment.run(changed) == without_change) report(change, "does not change the result");
  }
  return faults;
}

}  // namespace detail

/// Returns a line for each change that does not change the result of its experiment; empty if all do.
template <typename Parameters>
std::string findChangesWithoutEffect(const Table<Parameters>& table,
                                     const std::vector<ParameterExperiment<Parameters>>& experiments) {
  std::string faults;
  for (const ParameterExperiment<Parameters>& experiment : experiments)
    faults += detail::runExperiment(table, experiment);
  return faults;
}

/// Returns a line for each row of the table without a test of its effect, and the result of findChangesWithoutEffect();
/// empty if there is none. Each row must be among the changes of an experiment or have a test in `elsewhere`.
template <typename Parameters>
std::string findParametersWithoutEffect(const Table<Parameters>& table,
                                        const std::vector<ParameterExperiment<Parameters>>& experiments,
                                        const std::vector<ParameterTest>& elsewhere = {}) {
  std::string faults = findChangesWithoutEffect(table, experiments);
  std::vector<std::string> shown;
  for (const ParameterExperiment<Parameters>& experiment : experiments)
    for (const ParameterChange& change : experiment.changes) shown.push_back(change.name);
  for (const ParameterTest& other : elsewhere) {
    if (detail::findRow(table, other.name) == nullptr) faults += other.name + " is no row of the table\n";
    if (!detail::exists(other)) faults += other.name + ": there is no test " + other.test + "\n";
    shown.push_back(other.name);
  }
  for (const RowInfo& row : table.rows())
    if (std::find(shown.begin(), shown.end(), row.name) == shown.end())
      faults += fullName(table.stage(), row.name) + " has no test in which it changes a result\n";
  return faults;
}

}  // namespace urban_nav_core::testing
