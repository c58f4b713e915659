// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/parameters/sources.hpp"

namespace urban_nav_core {

/// Returns `config/<pkg>.yaml`: the rows at their defaults, each below a comment with its meaning, range and source.
/// readParameters() reads it back unchanged.
std::string printYaml(const std::string& stage, const std::vector<RowInfo>& rows);
/// Returns YAML with the current values and their origins.
std::string printYaml(const std::string& stage, const std::vector<RowInfo>& rows, const std::vector<Setting>& settings);

/// Returns the table of the README: name, default, unit, range, meaning, source. Rows for experts are in a second,
/// collapsed table.
std::string printMarkdown(const std::string& stage, const std::vector<RowInfo>& rows);

/// Returns the section of --help: the parameters for users, each with its value, origin and meaning.
std::string printHelp(const std::string& stage, const std::vector<RowInfo>& rows, const std::vector<Setting>& settings);

/// Returns the section of --help-all: every parameter, also with range and source.
std::string printHelpForExperts(const std::string& stage, const std::vector<RowInfo>& rows,
                                const std::vector<Setting>& settings);

/// Puts the Markdown table between `<!-- parameters: STAGE -->` and `<!-- end -->` in the text of a README. Throws
/// UserError naming `path` where the markers are missing.
std::string insertMarkdown(const std::string& readme, const std::string& path, const std::string& stage,
                           const std::vector<RowInfo>& rows);

}  // namespace urban_nav_core
