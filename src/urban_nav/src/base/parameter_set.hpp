// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cassert>
#include <memory>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "urban_nav_core/parameters/sources.hpp"

namespace urban_nav {

/// Parameter tables of any number of stages with their values. A table may serve several stages; the set holds it once.
///
/// Not thread-safe while it changes. Values are found by their table, so their type is checked by the compiler:
/// `parameters.get(swf_vo::table()).window`.
class ParameterSet {
 public:
  /// Adds a table with its defaults. Does nothing if the set has a table of this stage.
  template <typename Parameters>
  void add(const urban_nav_core::Table<Parameters>& table) {
    if (find(table.stage()) == nullptr) groups_.push_back(std::make_unique<TableGroup<Parameters>>(table));
  }

  /// Assigns values to all tables; rows without an assignment get their default. Old names of rows are understood.
  /// Throws UserError for an assignment to an unknown stage or row, and for a value that is not allowed.
  void load(const std::vector<urban_nav_core::Assignment>& assignments);
  /// Assigns one value after load(): "swf_vo.window=25". Throws UserError like load().
  void set(const std::string& assignment);

  /// Returns the values of a table. Requires that it was added.
  template <typename Parameters>
  const Parameters& get(const urban_nav_core::Table<Parameters>& table) const {
    const auto* group = dynamic_cast<const TableGroup<Parameters>*>(find(table.stage()));
    assert(group != nullptr && "a stage must add each table it uses");
    return group->loaded.parameters;
  }

  /// Returns the rows of one stage with value and origin; empty if the set has no such table.
  std::vector<urban_nav_core::Setting> settings(const std::string& stage) const;
  /// Returns all rows, in the order in which their tables were added.
  std::vector<urban_nav_core::Setting> settings() const;
  /// Returns the assignments by old names, and the rows named by `shared` that have different values in two tables: one
  /// sentence each, for the user.
  std::vector<std::string> warnings(const std::vector<std::string>& shared) const;
  /// Returns the rows for users with value and origin, for --help, or every row, for --help-all, also with allowed
  /// range and source. `stage`: only this one.
  std::string help(urban_nav_core::Audience audience) const;
  std::string help(const std::string& stage, urban_nav_core::Audience audience) const;
  /// Returns "stage.row" -> {value, origin} for summary.json.
  Json toJson() const;

 private:
  struct Group {
    virtual ~Group() = default;
    virtual const std::string& stage() const = 0;
    virtual const std::vector<urban_nav_core::RowInfo>& rows() const = 0;
    virtual const std::vector<urban_nav_core::Setting>& settings() const = 0;
    virtual void load(const std::vector<urban_nav_core::Assignment>& assignments) = 0;
  };
  template <typename Parameters>
  struct TableGroup final : Group {
    explicit TableGroup(const urban_nav_core::Table<Parameters>& of)
        : table(of), loaded(urban_nav_core::load(of, {})) {}
    const std::string& stage() const override { return table.stage(); }
    const std::vector<urban_nav_core::RowInfo>& rows() const override { return table.rows(); }
    const std::vector<urban_nav_core::Setting>& settings() const override { return loaded.settings; }
    void load(const std::vector<urban_nav_core::Assignment>& assignments) override {
      loaded = urban_nav_core::load(table, assignments);
    }

    const urban_nav_core::Table<Parameters>& table;
    urban_nav_core::Loaded<Parameters> loaded;
  };

  const Group* find(const std::string& stage) const;

  std::vector<std::unique_ptr<Group>> groups_;
  std::vector<urban_nav_core::Assignment> assignments_;
  std::vector<std::string> old_names_;  // warnings about their use
};

}  // namespace urban_nav
