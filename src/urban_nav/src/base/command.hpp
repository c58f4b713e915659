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
  std::string value;     ///< placeholder of the value in the help: "DIR"; empty: a flag
  std::string sentence;  ///< effect and default, for the help
  bool required = false;
  bool repeatable = false;
  std::vector<std::string> words;  ///< allowed values; empty: any
};

/// Arguments of a call. Options are accessed by their long name without dashes ("out"), positionals by their name
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
  /// Returns the last value; nullopt without one.
  std::optional<std::string> find(const std::string& name) const;
  std::string get(const std::string& name, const std::string& otherwise = "") const;
  /// Returns all values of a repeatable option.
  std::vector<std::string> all(const std::string& name) const;
  /// Returns the elements of a list "a,b,c"; lists of a repeated option are concatenated.
  std::vector<std::string> list(const std::string& name) const;
  /// Returns an integer within [low, high]. Throws UserError for other text.
  std::int64_t integer(const std::string& name, std::int64_t otherwise, std::int64_t low, std::int64_t high) const;
  double number(const std::string& name, double otherwise, double low, double high) const;

 private:
  std::map<std::string, std::vector<std::string>> values_;
  ParameterTables tables_;
};

/// A subcommand with its options. `run` returns the exit status 0 or 1, and throws UserError (2) or DataError (1). A
/// command with actions (`urban_nav places train`) has only a name, a summary and actions; each action is a command
/// with its options and help.
struct Command {
  std::string name;
  std::string summary;
  std::vector<Option> options;
  std::vector<std::string> examples;
  std::function<std::string(const Arguments&)> more_help;  ///< printed after the options; may be empty
  std::function<int(const Arguments&, Console&)> run;
  std::vector<Command> actions = {};
};

/// Parses the command line, runs the command and converts errors to messages and exit statuses: 0 success; 1
/// unsuitable data; 2 error of the user. `tables`: parameters of --set, --config and --help.
int runCommandLine(const std::vector<Command>& commands, const ParameterTables& tables, int argc,
                   const char* const* argv);

/// Runs a command, or an action ("places query"), whose arguments are given by name: options by their long name without
/// dashes, a flag with the value "true". Returns the exit status 0 or 1. Throws UserError for a command or option that
/// does not exist, for a flag with another value and for an option without one, and the errors of the command.
int runCommandByName(const std::vector<Command>& commands, const ParameterTables& tables, const std::string& name,
                     const std::map<std::string, std::vector<std::string>>& values, Console& console);

/// Options common to all commands (--json, --set, --config, --threads).
Option jsonOption();
Option setOption();
Option configOption();
Option threadsOption();
Option transformOption();

}  // namespace urban_nav
