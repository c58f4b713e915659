// SPDX-License-Identifier: BSD-3-Clause
#include "live/stage_health.hpp"

#include <algorithm>
#include <sstream>

#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav_trust {

namespace {

constexpr std::size_t kColumns = 72;

}  // namespace

void StageHealth::add(const std::string& name, int level, const std::string& message, double now) {
  nodes_[name] = {std::clamp(level, kOk, kError), message, now};
}

StageHealth::Text StageHealth::text(double now) const {
  Text text;
  for (const int level : {kError, kWarning})
    for (const auto& [name, latest] : nodes_) {
      const double silence = now - latest.received;
      const bool is_silent = silence > kSilence;
      if ((is_silent ? kError : latest.level) != level) continue;
      text.level = std::max(text.level, level);
      const std::string message =
          is_silent ? "no diagnostics for " + urban_nav_core::formatNumber(silence, 2) + " s" : latest.message;
      text.lines += (text.lines.empty() ? "" : "\n") + wrapText(name + ": " + message, kColumns);
    }
  if (text.lines.empty() && !nodes_.empty()) text.lines = "all " + std::to_string(nodes_.size()) + " nodes are OK";
  return text;
}

std::string wrapText(const std::string& text, std::size_t columns) {
  std::istringstream words(text);
  std::string lines, word;
  std::size_t used = 0;
  while (words >> word) {
    const bool is_full = used > 0 && used + 1 + word.size() > columns;
    lines += used == 0 ? "" : is_full ? "\n" : " ";
    used = used == 0 || is_full ? word.size() : used + 1 + word.size();
    lines += word;
  }
  return lines;
}

}  // namespace urban_nav_trust
