// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace urban_nav {

class Console;
class ParameterSet;

/// Adds the parameter tables of the program to a set.
using ParameterTables = std::function<void(ParameterSet&)>;

/// One option or positional argument of a command.
struct Option {
  std::string name;      ///< "--out", "-o,--output", or "INPUT" for a positional argument
  std::string value;     ///< what stands for the value in the help: "DIR"; empty: a flag
  std::string sentence;  ///< what it does, with the default
  bool required = false;
  bool repeatable = false;
  std::vector<std::string> words;  ///< allowed values; empty: any
};

/// What the user gave. Options are asked for by their long name without dashes ("out"), positionals by theirs
/// ("INPUT").
class Arguments {
 public:
  explicit Arguments(std::map<std::string, std::vector<std::string>> values, ParameterTables tables = {})
      : values_(std::move(values)), tables_(std::move(tables)) {}

  /// Adds the tables of the program's stages to a set (loadParameters()).
  void addTables(ParameterSet& set) const {
    if (tables_) tables_(set);
  }
  bool has(const std::string& name) const { return values_.count(name) != 0; }
  /// The last value given; empty if there is none.
  std::optional<std::string> find(const std::string& name) const;
  std::string get(const std::string& name, const std::string& otherwise = "") const;
  /// All values of a repeatable option.
  std::vector<std::string> all(const std::string& name) const;
  /// A list "a,b,c"; repeated options add up.
  std::vector<std::string> list(const std::string& name) const;
  /// A whole number within [low, high]; UserError if it is none.
  std::int64_t integer(const std::string& name, std::int64_t otherwise, std::int64_t low, std::int64_t high) const;
  double number(const std::string& name, double otherwise, double low, double high) const;

 private:
  std::map<std::string, std::vector<std::string>> values_;
  ParameterTables tables_;
};

/// A subcommand: what it takes and what it does. `run` returns the exit status 0 or 1, and throws UserError (2) or
/// DataError (1). A command with actions (`urban_nav places train`) has nothing but its name, summary and actions; each
/// action is a command with options and help of its own.
struct Command {
  std::string name;
  std::string summary;
  std::vector<Option> options;
  std::vector<std::string> examples;
  std::function<std::string(const Arguments&)> more_help;  ///< printed after the options; may be empty
  std::function<int(const Arguments&, Console&)> run;
  std::vector<Command> actions = {};
};

/// Parses, runs, and turns errors into lines and exit statuses: 0 done; 1 the data did not allow it; 2 the user's
/// mistake. `tables`: of the parameters that --set, --config and --help know.
int runCommandLine(const std::vector<Command>& commands, const ParameterTables& tables, int argc,
                   const char* const* argv);

/// Runs a command, or an action ("places query"), whose arguments are given by name: options by their long name without
/// dashes, a flag with the value "true". Returns the exit status 0 or 1. Throws UserError for a command or option that
/// does not exist, for a flag with another value and for an option without one, and the errors of the command.
int runCommandByName(const std::vector<Command>& commands, const ParameterTables& tables, const std::string& name,
                     const std::map<std::string, std::vector<std::string>>& values, Console& console);

/// The options that every command has (--json, --set, --config, --threads): appended where a command wants them.
Option jsonOption();
Option setOption();
Option configOption();
Option threadsOption();
Option transformOption();

}  // namespace urban_nav
