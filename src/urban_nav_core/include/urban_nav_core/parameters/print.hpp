// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/parameters/sources.hpp"

namespace urban_nav_core {

/// config/<pkg>.yaml: the rows at their defaults, each below a comment that says what it does, what is allowed and
/// where it comes from. readParameters gives back what was printed.
std::string printYaml(const std::string& stage, const std::vector<RowInfo>& rows);
/// The same with the values in force and their origins.
std::string printYaml(const std::string& stage, const std::vector<RowInfo>& rows, const std::vector<Setting>& settings);

/// The README's table: name, default, unit, allowed, what it does, source. The rows for experts are in a second table,
/// which a browser folds.
std::string printMarkdown(const std::string& stage, const std::vector<RowInfo>& rows);

/// The part of --help: the parameters for users, each with its value, where that came from, and what it does.
std::string printHelp(const std::string& stage, const std::vector<RowInfo>& rows, const std::vector<Setting>& settings);

/// The part of --help-all: every parameter, also with what is allowed and its source.
std::string printHelpForExperts(const std::string& stage, const std::vector<RowInfo>& rows,
                                const std::vector<Setting>& settings);

/// Puts the Markdown table between `<!-- parameters: STAGE -->` and `<!-- end -->` in the text of a README. Throws
/// UserError naming `path` where the markers are missing.
std::string insertMarkdown(const std::string& readme, const std::string& path, const std::string& stage,
                           const std::vector<RowInfo>& rows);

}  // namespace urban_nav_core
