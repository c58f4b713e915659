// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/bench_table.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>
#include <thread>

#include "urban_nav_core/io/atomic_file.hpp"

namespace urban_nav_core::testing {

namespace {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n') result += "\\n";
    else result += c;
  }
  return result + '"';
}

std::string list(const std::vector<std::string>& texts) {
  std::string result = "[";
  for (std::size_t i = 0; i < texts.size(); ++i) result += (i > 0 ? ", " : "") + quoted(texts[i]);
  return result + "]";
}

std::string readFirstLine(const char* command) {
  std::array<char, 256> buffer{};
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command, "r"), pclose);
  if (!pipe || std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe.get()) == nullptr) return {};
  std::string line = buffer.data();
  while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.pop_back();
  return line;
}

/// Reduces "NAME=/some/folder/FILE" to "NAME=FILE".
std::string withoutFolder(const std::string& word) {
  const std::size_t slash = word.find_last_of('/'), value = word.find_last_of('=', slash);
  if (slash == std::string::npos) return word;
  return (value == std::string::npos ? "" : word.substr(0, value + 1)) + word.substr(slash + 1);
}

}  // namespace

BenchTable::BenchTable(std::vector<std::string> columns, int argc, char** argv) : columns_(std::move(columns)) {
  // Folders are specific to one machine; file names are sufficient.
  for (int i = 0; i < argc; ++i) command_ += (i > 0 ? " " : "") + withoutFolder(argv[i]);
}

void BenchTable::add(std::vector<std::string> cells) {
  cells.resize(columns_.size());
  rows_.push_back(std::move(cells));
}

void BenchTable::note(std::string sentence) { notes_.push_back(std::move(sentence)); }

std::string BenchTable::text() const {
  std::vector<std::size_t> widths(columns_.size());
  const auto widen = [&](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) widths[i] = std::max(widths[i], cells[i].size());
  };
  widen(columns_);
  for (const auto& row : rows_) widen(row);
  std::ostringstream out;
  const auto line = [&](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) out << cells[i] << std::string(widths[i] - cells[i].size() + 2, ' ');
    out << '\n';
  };
  line(columns_);
  for (const auto& row : rows_) line(row);
  for (const std::string& sentence : notes_) out << sentence << '\n';
  return out.str();
}

void BenchTable::write(const std::string& path) const {
  std::ostringstream out;
  out << "{\n  \"machine\": " << quoted(machineName()) << ",\n  \"commit\": " << quoted(commitName())
      << ",\n  \"command\": " << quoted(command_) << ",\n  \"columns\": " << list(columns_) << ",\n  \"rows\": [\n";
  for (std::size_t i = 0; i < rows_.size(); ++i)
    out << "    " << list(rows_[i]) << (i + 1 < rows_.size() ? ",\n" : "\n");
  out << "  ],\n  \"notes\": " << list(notes_) << "\n}\n";
  writeAtomically(path, out.str());
}

std::string cell(double value, int decimals) {
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*f", decimals, value);
  return buffer.data();
}

std::string machineName() {
  std::ifstream info("/proc/cpuinfo");
  std::string name = "unknown processor";
  for (std::string line; std::getline(info, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    name = line.substr(line.find(':') + 2);
    break;
  }
  return name + " (" + std::to_string(std::thread::hardware_concurrency()) + " cores)";
}

std::string commitName() {
  const std::string commit = readFirstLine("git rev-parse --short HEAD 2>/dev/null");
  if (commit.empty()) return "unknown";
  return commit + (readFirstLine("git status --porcelain 2>/dev/null").empty() ? "" : "+");
}

}  // namespace urban_nav_core::testing
