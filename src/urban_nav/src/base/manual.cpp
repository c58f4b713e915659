// SPDX-License-Identifier: BSD-3-Clause
#include "base/manual.hpp"

#include "base/version.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text.hpp"

namespace urban_nav {

namespace {

/// Escapes text for roff.
std::string escaped(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins_line = i == 0 || text[i - 1] == '\n';
    if (begins_line && (text[i] == '.' || text[i] == '\'')) out += "\\&";
    if (text[i] == '\\') out += "\\e";
    else if (text[i] == '-') out += "\\-";
    else out += text[i];
  }
  return out;
}

void appendOption(const Option& option, std::string& page) {
  std::string names;
  for (const std::string_view name : urban_nav_core::splitAt(option.name, ','))
    names += (names.empty() ? "\\fB" : ", \\fB") + escaped(std::string(name)) + "\\fR";
  page += ".TP\n" + names + (option.value.empty() ? "" : " \\fI" + escaped(option.value) + "\\fR") + "\n";
  std::string sentence = option.sentence;
  if (!option.words.empty()) sentence += ": " + urban_nav_core::joined(option.words);
  if (option.repeatable) sentence += " (repeatable)";
  page += escaped(sentence) + "\n";
}

void appendCommand(const Command& command, const std::string& name, std::string& page) {
  page += ".SS urban_nav " + escaped(name) + "\n" + escaped(command.summary) + "\n";
  for (const Option& option : command.options) appendOption(option, page);
  for (const std::string& example : command.examples) page += ".PP\n.EX\n" + escaped(example) + "\n.EE\n";
  for (const Command& action : command.actions) appendCommand(action, name + " " + action.name, page);
}

/// Joins words by blanks, for a shell variable.
std::string joinedByBlanks(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

void appendCases(const Command& command, const std::string& name, std::string& options, std::string& words) {
  std::vector<std::string> names = {"--help"};
  for (const Option& option : command.options) {
    const std::size_t dashes = option.name.rfind("--");
    if (dashes == std::string::npos) continue;
    const std::string longest = option.name.substr(dashes);
    names.push_back(longest);
    if (!option.words.empty())
      words += "    \"" + name + " " + longest + "\") words=\"" + joinedByBlanks(option.words) + "\" ;;\n";
  }
  for (const Command& action : command.actions) names.push_back(action.name);
  options += "    \"" + name + "\") words=\"" + joinedByBlanks(names) + "\" ;;\n";
  for (const Command& action : command.actions) appendCases(action, name + " " + action.name, options, words);
}

}  // namespace

std::string printManual(const std::vector<Command>& commands) {
  std::string page = ".TH URBAN_NAV 1 \"\" \"urban_nav " + suiteVersion() + "\" \"User Commands\"\n.SH NAME\n" +
                     "urban_nav \\- trajectory, map and report from the recordings of a robot\n.SH SYNOPSIS\n" +
                     ".B urban_nav\n.I COMMAND\n[\\fIoptions\\fR]\n.SH DESCRIPTION\n" +
                     escaped("Each command has --help, and --help-all for all parameters of --set.") +
                     "\n.SH COMMANDS\n";
  for (const Command& command : commands) appendCommand(command, command.name, page);
  return page + ".SH EXIT STATUS\n0: done. 1: the data are unsuitable. 2: an error in the call.\n";
}

std::string printCompletion(const std::vector<Command>& commands) {
  std::vector<std::string> names = {"--help", "--version", "--python-path"};
  std::string options, words, groups;
  for (const Command& command : commands) {
    names.push_back(command.name);
    appendCases(command, command.name, options, words);
    for (const Command& action : command.actions) {
      const std::string name = command.name + " " + action.name;
      groups += "    \"" + name + "\") command=\"" + name + "\" ;;\n";
    }
  }
  return "# Completion of urban_nav for bash\n"
         "_urban_nav() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]} "
         "words=''\n"
         "  COMPREPLY=()\n"
         "  if [ \"$COMP_CWORD\" = 1 ]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"" +
         joinedByBlanks(names) +
         "\" -- \"$current\")\n"
         "    return\n"
         "  fi\n"
         "  case \"$command ${COMP_WORDS[2]}\" in\n" +
         groups +
         "  esac\n"
         "  case \"$command $previous\" in\n" +
         words +
         "  esac\n"
         "  if [ -z \"$words\" ]; then\n"
         "    case $command in\n" +
         options +
         "    esac\n"
         "    if [[ $current != -* ]]; then mapfile -t COMPREPLY < <(compgen -f -- \"$current\"); fi\n"
         "  fi\n"
         "  mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
         "}\n"
         "complete -o filenames -F _urban_nav urban_nav\n";
}

}  // namespace urban_nav
