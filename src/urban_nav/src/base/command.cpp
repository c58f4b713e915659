// SPDX-License-Identifier: BSD-3-Clause
#include "base/command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "base/console.hpp"
#include "base/manual.hpp"
#include "base/python_path.hpp"
#include "base/version.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_core::DataError;
using urban_nav_core::UserError;

namespace {

/// Returns the key of an option: "out" for "-o,--out", "INPUT" for "INPUT".
std::string toKey(const Option& option) {
  const std::size_t dashes = option.name.rfind("--");
  return dashes == std::string::npos ? option.name : option.name.substr(dashes + 2);
}

bool isPositional(const Option& option) { return option.name.empty() || option.name.front() != '-'; }

std::string signature(const Option& option) {
  std::string text = option.name;
  std::replace(text.begin(), text.end(), ',', ' ');
  if (isPositional(option)) return text + (option.repeatable ? "..." : "");
  return text + (option.value.empty() ? "" : " " + option.value);
}

std::string makeUsage(const Command& command) {
  std::string text = "urban_nav " + command.name;
  for (const Option& option : command.options) {
    if (isPositional(option)) text += " " + signature(option);
  }
  for (const Option& option : command.options) {
    if (!isPositional(option) && option.required) text += " --" + toKey(option) + " " + option.value;
  }
  return text + " [options]";
}

std::string makeHelp(const Command& command, const Arguments& arguments) {
  std::string text = command.summary + "\n\nusage: " + makeUsage(command) + "\n\n";
  std::size_t width = 0;
  for (const Option& option : command.options) width = std::max(width, signature(option).size());
  for (const Option& option : command.options) {
    const std::string left = signature(option);
    text += "  " + left + std::string(width - left.size() + 2, ' ') + option.sentence;
    if (!option.words.empty()) text += ": " + urban_nav_core::joined(option.words);
    if (option.repeatable) text += " (repeatable)";
    text += "\n";
  }
  if (!command.examples.empty()) text += "\nexamples:\n";
  for (const std::string& example : command.examples) text += "  " + example + "\n";
  if (command.more_help) text += "\n" + command.more_help(arguments);
  return text;
}

/// One line per command: its name and summary.
std::string summaryLines(const std::vector<Command>& commands) {
  std::string text;
  for (const Command& command : commands)
    text += "  " + command.name + std::string(10 - std::min<std::size_t>(9, command.name.size()), ' ') +
            command.summary + "\n";
  return text;
}

std::string generalHelp(const std::vector<Command>& commands) {
  std::string text =
      "urban_nav: turns the camera and laser recordings of a robot into a trajectory, a map and a report on their "
      "accuracy.\n\n"
      "usage: urban_nav COMMAND [options]      (urban_nav COMMAND --help for more; urban_nav --version)\n"
      "       urban_nav --python-path          (folder for PYTHONPATH with which `import urban_nav` works)\n\n";
  return text + summaryLines(commands) + "\nexit status: 0 success, 1 unsuitable data, 2 error in the call\n";
}

bool isHelpWord(const std::string& word) {
  return word == "--help" || word == "--help-all" || word == "-h" || word == "help";
}

/// Returns the output of an option of the program itself (--help, --version); nullopt for other words.
std::optional<std::string> generalText(const std::vector<Command>& commands, const std::string& word) {
  if (isHelpWord(word)) return generalHelp(commands);
  if (word == "--version") return "urban_nav " + suiteVersion() + "\n";
  if (word == "--python-path") return pythonPath() + "\n";
  if (word == "--manual") return printManual(commands);
  if (word == "--completion") return printCompletion(commands);
  return std::nullopt;
}

void checkRequired(const Command& command, const Arguments& arguments) {
  for (const Option& option : command.options) {
    if (option.required && !arguments.has(toKey(option))) {
      throw UserError(
          "urban_nav " + command.name,
          (isPositional(option) ? option.name : "--" + toKey(option)) + " is missing; usage: " + makeUsage(command),
          "");
    }
    if (option.words.empty()) continue;
    for (const std::string& value : arguments.all(toKey(option))) {
      if (std::find(option.words.begin(), option.words.end(), value) == option.words.end()) {
        throw UserError("urban_nav " + command.name,
                        (isPositional(option) ? option.name : "--" + toKey(option)) + " = " + value,
                        urban_nav_core::joined(option.words));
      }
    }
  }
}

/// Checks an argument given by name; CLI11 checks those of a command line.
void checkNamed(const Command& command, const std::string& key, const std::vector<std::string>& given) {
  const std::string where = "urban_nav " + command.name;
  const auto option =
      std::find_if(command.options.begin(), command.options.end(), [&](const Option& o) { return toKey(o) == key; });
  if (option == command.options.end()) {
    std::vector<std::string> names;
    for (const Option& each : command.options) names.push_back(toKey(each));
    throw UserError(where, "no option " + key, urban_nav_core::joined(names));
  }
  const bool is_flag = option->value.empty() && !isPositional(*option);
  const bool has_value = !given.empty() && !(given.size() == 1 && given.front() == "true");
  if (is_flag && has_value) throw UserError(where, key + " = " + given.front(), "no value: it is a switch");
  if (given.empty()) throw UserError(where, key + " has no value", option->value.empty() ? "a value" : option->value);
  if (given.size() > 1 && !option->repeatable)
    throw UserError(where, key + " has " + std::to_string(given.size()) + " values", "one");
}

/// Parses a command line by CLI11. Values are checked here, so that --help works with any other arguments.
Arguments parse(const Command& command, const ParameterTables& tables, int argc, const char* const* argv) {
  CLI::App app(command.summary, "urban_nav " + command.name);
  app.set_help_flag();
  std::map<std::string, std::vector<std::string>> values;
  std::map<std::string, bool> flags;
  for (const Option& option : command.options) {
    const std::string key = toKey(option);
    if (option.value.empty() && !isPositional(option)) {
      app.add_flag(option.name, flags[key]);
      continue;
    }
    CLI::Option* added = app.add_option(option.name, values[key]);
    if (isPositional(option)) {
      if (!option.repeatable) added->expected(1)->allow_extra_args(false);
    } else {
      added->expected(1)->allow_extra_args(false);
      added->multi_option_policy(option.repeatable ? CLI::MultiOptionPolicy::TakeAll
                                                   : CLI::MultiOptionPolicy::TakeLast);
    }
  }
  bool help = false, help_all = false;
  app.add_flag("-h,--help", help);
  app.add_flag("--help-all", help_all);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    throw UserError("urban_nav " + command.name, std::string(error.what()) + " (--help lists the options)", "");
  }
  for (const auto& [key, given] : flags) {
    if (given) values[key] = {"true"};
  }
  if (help || help_all) values["help"] = {"true"};
  if (help_all) values["help-all"] = {"true"};
  for (auto entry = values.begin(); entry != values.end();)
    entry = entry->second.empty() ? values.erase(entry) : std::next(entry);
  return Arguments(std::move(values), tables);
}

int runCommand(const Command& command, const ParameterTables& tables, int argc, const char* const* argv,
               Console& console) {
  const Arguments arguments = parse(command, tables, argc, argv);
  if (arguments.has("help")) {
    console.print(makeHelp(command, arguments));
    return 0;
  }
  checkRequired(command, arguments);
  return command.run(arguments, console);
}

const Command& findCommand(const std::vector<Command>& commands, const std::string& name, const std::string& where,
                           const std::string& noun) {
  const auto command = std::find_if(commands.begin(), commands.end(), [&](const Command& c) { return c.name == name; });
  if (command != commands.end()) return *command;
  std::vector<std::string> names;
  names.reserve(commands.size());
  for (const Command& c : commands) names.push_back(c.name);
  throw UserError(where, name.empty() ? noun + " is missing" : "no " + noun + " \"" + name + "\"",
                  urban_nav_core::joined(names));
}

/// Runs an action of a command, named by the next word.
int runAction(const Command& group, const ParameterTables& tables, int argc, const char* const* argv,
              Console& console) {
  const std::string name = argc > 1 ? argv[1] : "";
  if (isHelpWord(name)) {
    console.print(group.summary + "\n\nusage: urban_nav " + group.name + " ACTION [options]      (urban_nav " +
                  group.name + " ACTION --help for more)\n\n" + summaryLines(group.actions));
    return 0;
  }
  Command action = findCommand(group.actions, name, "urban_nav " + group.name, "action");
  action.name = group.name + " " + action.name;
  return runCommand(action, tables, argc - 1, argv + 1, console);
}

}  // namespace

std::optional<std::string> Arguments::find(const std::string& name) const {
  const auto found = values_.find(name);
  return found == values_.end() || found->second.empty() ? std::nullopt
                                                         : std::optional<std::string>(found->second.back());
}

std::string Arguments::get(const std::string& name, const std::string& otherwise) const {
  return find(name).value_or(otherwise);
}

std::vector<std::string> Arguments::all(const std::string& name) const {
  const auto found = values_.find(name);
  return found == values_.end() ? std::vector<std::string>() : found->second;
}

std::vector<std::string> Arguments::list(const std::string& name) const {
  std::vector<std::string> words;
  for (const std::string& value : all(name)) {
    for (const std::string_view word : urban_nav_core::splitAt(value, ',')) {
      if (!word.empty()) words.emplace_back(word);
    }
  }
  return words;
}

std::int64_t Arguments::integer(const std::string& name, std::int64_t otherwise, std::int64_t low,
                                std::int64_t high) const {
  const std::optional<std::string> text = find(name);
  if (!text) return otherwise;
  const std::optional<std::int64_t> value = urban_nav_core::parseInteger(*text);
  if (!value || *value < low || *value > high) {
    throw UserError("--" + name, name + " = " + *text,
                    "a whole number, " + std::to_string(low) + "..." + std::to_string(high));
  }
  return *value;
}

double Arguments::number(const std::string& name, double otherwise, double low, double high) const {
  const std::optional<std::string> text = find(name);
  if (!text) return otherwise;
  const std::optional<double> value = urban_nav_core::parseNumber(*text);
  if (!value || !(*value >= low && *value <= high)) {
    throw UserError("--" + name, name + " = " + *text,
                    "a number, " + urban_nav_core::printNumber(low) + "..." + urban_nav_core::printNumber(high));
  }
  return *value;
}

int runCommandLine(const std::vector<Command>& commands, const ParameterTables& tables, int argc,
                   const char* const* argv) {
  Console console;
  const std::string name = argc > 1 ? argv[1] : "";
  try {
    if (name.empty()) {
      console.print(generalHelp(commands));
      return 2;
    }
    if (const std::optional<std::string> text = generalText(commands, name)) {
      console.print(*text);
      return 0;
    }
    const Command& command = findCommand(commands, name, "urban_nav", "command");
    const int status = command.actions.empty() ? runCommand(command, tables, argc - 1, argv + 1, console)
                                               : runAction(command, tables, argc - 1, argv + 1, console);
    if (std::ferror(stdout) != 0) throw UserError("standard output", "could not be written", "free disk space");
    return status;
  } catch (const DataError& error) {
    console.error(error.what());
    return 1;
  } catch (const UserError& error) {
    console.error(error.what());
    return 2;
  } catch (const std::exception& error) {
    console.error(std::string("aborted: ") + error.what());
    return 1;
  }
}

int runCommandByName(const std::vector<Command>& commands, const ParameterTables& tables, const std::string& name,
                     const std::map<std::string, std::vector<std::string>>& values, Console& console) {
  const std::size_t blank = name.find(' ');
  const Command& group = findCommand(commands, name.substr(0, blank), "urban_nav", "command");
  Command command = group;
  if (!group.actions.empty())
    command = findCommand(group.actions, blank == std::string::npos ? "" : name.substr(blank + 1),
                          "urban_nav " + group.name, "action");
  command.name = name;
  for (const auto& [key, given] : values) checkNamed(command, key, given);
  const Arguments arguments(values, tables);
  checkRequired(command, arguments);
  return command.run(arguments, console);
}

Option jsonOption() { return {"--json", "FILE", "a machine-readable summary", false, false, {}}; }
Option setOption() { return {"--set", "STAGE.KEY=VALUE", "one parameter; overrides --config", false, true, {}}; }
Option configOption() { return {"--config", "FILE", "parameters as YAML: stage, then key: value", false, true, {}}; }
Option threadsOption() {
  return {"--threads", "N", "threads to use (default: one per core); without effect on the results", false, false, {}};
}
Option transformOption() {
  return {"--transform",
          "PARENT,CHILD:X,Y,Z,QX,QY,QZ,QW",
          "pose of a frame (m, quaternion), overrides the tf of the recording; repeatable",
          false,
          true,
          {}};
}

}  // namespace urban_nav
