// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/text_table.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <map>
#include <utility>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

constexpr std::size_t kSampledRows = 64;  // from which the format of a table is detected
constexpr std::size_t kSampledBytes = std::size_t{1} << 18U;
constexpr std::size_t kLongestShown = 40;  // characters of a cell in an error
constexpr char kBlanks = ' ';              // separator of cells with any number of blanks and tabs between them
constexpr std::array<char, 4> kSeparators = {',', ';', '\t', kBlanks};

bool isCellBlank(char c) { return c == ' ' || c == '\t'; }

bool isComment(std::string_view line) {
  return line.front() == '#' || line.front() == '%' || line.substr(0, 2) == "//";
}

std::string_view withoutMarks(std::string_view line) {
  const std::size_t begin = std::min(line.find_first_not_of("#%/ \t"), line.size());
  return line.substr(begin);
}

/// Returns a row separated by blanks without its trailing comment.
std::string_view withoutComment(std::string_view line) {
  for (std::size_t i = 1; i < line.size(); ++i)
    if (line[i] == '#' && isCellBlank(line[i - 1])) return line.substr(0, i);
  return line;
}

/// Returns whether a cell is a number with a decimal comma.
bool isDecimalComma(std::string_view cell) {
  const std::size_t comma = cell.find(',');
  if (comma == std::string_view::npos || cell.find_first_of(".,", comma + 1) != std::string_view::npos) return false;
  std::string number(cell);
  number[comma] = '.';
  return parseNumber(number).has_value();
}

/// Splits lines into cells; their views are valid until the next line.
class RowSplitter {
 public:
  RowSplitter(char separator, bool has_decimal_commas)
      : separator_(separator), has_decimal_commas_(has_decimal_commas) {}

  /// Returns what is wrong with the line; empty if it is valid.
  std::string split(std::string_view line, std::vector<std::string_view>& cells) {
    cells.clear();
    changed_.clear();
    changed_.reserve(2 * line.size());
    if (separator_ == kBlanks) line = withoutComment(line);
    std::size_t at = 0;
    while (true) {
      while (at < line.size() && isCellBlank(line[at]) && line[at] != separator_) ++at;
      if (separator_ == kBlanks) at = std::min(line.find_first_not_of(" \t", at), line.size());
      if (separator_ == kBlanks && at == line.size()) return {};
      const bool is_quoted = at < line.size() && line[at] == '"';
      if (const std::string fault = is_quoted ? takeQuoted(line, at, cells) : takePlain(line, at, cells);
          !fault.empty())
        return fault;
      if (at >= line.size()) return {};
      ++at;
    }
  }

 private:
  bool endsCell(char c) const { return separator_ == kBlanks ? isCellBlank(c) : c == separator_; }

  std::string takePlain(std::string_view line, std::size_t& at, std::vector<std::string_view>& cells) {
    const std::size_t begin = at;
    while (at < line.size() && !endsCell(line[at])) ++at;
    add(trimmed(line.substr(begin, at - begin)), cells);
    return {};
  }

  std::string takeQuoted(std::string_view line, std::size_t& at, std::vector<std::string_view>& cells) {
    const std::size_t begin = changed_.size();
    for (++at; at < line.size(); ++at) {
      if (line[at] == '"' && (at + 1 == line.size() || line[at + 1] != '"')) break;
      if (line[at] == '"') ++at;
      changed_ += line[at];
    }
    if (at >= line.size()) return "unterminated quote";
    for (++at; at < line.size() && !endsCell(line[at]); ++at)
      if (!isCellBlank(line[at])) return "text after a quote";
    add(std::string_view(changed_).substr(begin), cells);
    return {};
  }

  void add(std::string_view cell, std::vector<std::string_view>& cells) {
    if (has_decimal_commas_ && isDecimalComma(cell)) {
      const std::size_t begin = changed_.size();
      changed_ += cell;
      changed_[begin + cell.find(',')] = '.';
      cell = std::string_view(changed_).substr(begin);
    }
    cells.push_back(cell);
  }

  char separator_;
  bool has_decimal_commas_;
  std::string changed_;  // modified cells; at most as long as the line, twice
};

/// Score of a separator: first the number of rows with the same number of cells above one, then the share of numbers.
struct Fit {
  std::size_t rows = 0, width = 0;
  double numbers = 0.0;
  bool has_decimal_commas = false;

  bool isBetterThan(const Fit& other) const { return rows != other.rows ? rows > other.rows : numbers > other.numbers; }
};

Fit fit(char separator, const std::vector<std::string_view>& rows) {
  RowSplitter splitter(separator, false);
  std::vector<std::string_view> cells;
  std::map<std::size_t, std::pair<std::size_t, std::size_t>> widths;  // rows by number of cells, and those of them that
                                                                      // end in a separator
  std::size_t all = 0, numbers = 0, commas = 0, points = 0, thousands = 0;
  for (const std::string_view row : rows) {
    if (!splitter.split(row, cells).empty()) continue;
    auto& [count, ended] = widths[cells.size()];
    ++count;
    ended += !cells.empty() && cells.back().empty() ? 1 : 0;
    for (const std::string_view cell : cells) {
      const bool is_number = parseCell(cell).has_value();
      const bool has_comma = !is_number && isDecimalComma(cell);
      thousands += has_comma && cell.size() - cell.find(',') == 4 ? 1 : 0;
      points += is_number && cell.find('.') != std::string_view::npos ? 1 : 0;
      commas += has_comma ? 1 : 0;
      numbers += is_number || has_comma ? 1 : 0;
      ++all;
    }
  }
  Fit result;
  for (const auto& [width, count] : widths)
    if (width > 1 && count.first >= result.rows) {
      result.width = count.first == count.second ? width - 1 : width;
      result.rows = count.first;
    }
  if (separator == ',' && thousands == commas) points += commas;  // quoted "1,234" may have a thousands separator
  if (commas > 0 && points > 0) numbers -= commas;                // then they are not decimal commas
  result.has_decimal_commas = commas > 0 && points == 0;
  result.numbers = all > 0 ? static_cast<double>(numbers) / static_cast<double>(all) : 0.0;
  return result;
}

bool holdsNumber(const std::vector<std::string_view>& cells) {
  return std::any_of(cells.begin(), cells.end(), [](std::string_view cell) { return parseCell(cell).has_value(); });
}

/// Returns the separator stated in the first line by some spreadsheets ("sep=;").
std::optional<char> statedSeparator(std::string_view line) {
  if (line.size() != 5 || line.substr(0, 4) != "sep=") return std::nullopt;
  return line[4];
}

}  // namespace

TextTable::TextTable(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {
  head_ = text_.substr(0, kSampledBytes);
  if (head_.size() < text_.size()) head_ = head_.substr(0, head_.find_last_of("\r\n") + 1);
  std::vector<std::string_view> rows;
  std::optional<char> stated;
  forEachLine(head_, [&](std::string_view line, int number) {
    const std::string_view content = trimmed(line);
    if (content.empty() || isComment(content)) return;
    const auto separator = number == 1 ? statedSeparator(content) : std::nullopt;
    if (separator) stated = separator;
    else if (rows.size() < kSampledRows) rows.push_back(line);
  });
  Fit best;
  if (stated) {
    separator_ = *stated;
    best = fit(separator_, rows);
  } else {
    for (const char separator : kSeparators) {
      const Fit next = fit(separator, rows);
      if (!next.isBetterThan(best)) continue;
      separator_ = separator;
      best = next;
    }
  }
  // A single column: commas within the words separated by blanks are decimal commas.
  if (best.rows == 0) {
    best.width = rows.empty() ? 0 : 1;
    best.has_decimal_commas = fit(kBlanks, rows).has_decimal_commas;
  }
  width_ = best.width;
  has_decimal_commas_ = best.has_decimal_commas;
  findHeader();
}

void TextTable::findHeader() {
  bool has_ended = false;
  std::vector<std::string_view> cells;
  forEachLine(head_, [&](std::string_view line, int number) {
    const std::string_view content = trimmed(line);
    if (has_ended || content.empty() || (number == 1 && statedSeparator(content))) return;
    const bool is_comment = isComment(content);
    std::vector<std::string> names;
    bool has_number = false;
    for (const char separator : {separator_, ',', ';', '\t', kBlanks}) {
      RowSplitter splitter(separator, has_decimal_commas_);
      if (!splitter.split(is_comment ? withoutMarks(content) : line, cells).empty()) continue;
      if (separator == separator_) has_number = holdsNumber(cells);
      if (cells.size() > width_ && cells.back().empty()) cells.pop_back();
      if (cells.size() != width_ && cells.size() != width_ + 1) continue;
      if (!holdsNumber(cells)) names.assign(cells.begin(), cells.end());
      break;
    }
    if (!names.empty()) {
      header_ = names;
      header_line_ = number;
      header_is_comment_ = is_comment;
    }
    has_ended = !is_comment && (!names.empty() || has_number);
  });
}

void TextTable::requireHeader() {
  if (!header_.empty()) return;
  forEachRow([this](const TableRow& row) {
    if (header_line_ > 0) return;
    header_.assign(row.cells.begin(), row.cells.end());
    header_line_ = row.line;
  });
}

void TextTable::forEachRow(const std::function<void(const TableRow& row)>& row) const {
  RowSplitter splitter(separator_, has_decimal_commas_);
  TableRow next;
  const std::size_t width = header_.empty() ? width_ : header_.size();
  forEachLine(text_, [&](std::string_view line, int number) {
    const std::string_view content = trimmed(line);
    if (content.empty() || isComment(content) || number == header_line_) return;
    if (number == 1 && statedSeparator(content)) return;
    next.line = number;
    const std::string fault = splitter.split(line, next.cells);
    if (!fault.empty()) throw UserError(where(next), fault, fault == "text after a quote" ? "a separator" : "");
    if (next.cells.size() == width + 1 && next.cells.back().empty()) next.cells.pop_back();
    row(next);
  });
}

std::string TextTable::where(const TableRow& row) const { return atLine(name_, row.line); }
std::string TextTable::whereHeader() const { return atLine(name_, header_line_); }

std::optional<double> parseCell(std::string_view cell) {
  if (const auto number = parseNumber(cell)) return number;
  if (cell.empty() || cell.size() > std::string_view("-infinity").size()) return std::nullopt;
  std::string word(cell);
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (word.front() == '-' || word.front() == '+') word.erase(0, 1);
  if (word == "nan" || word == "-nan(ind)" || word == "n/a" || word == "null")
    return std::numeric_limits<double>::quiet_NaN();
  if (word == "inf" || word == "infinity") return std::numeric_limits<double>::infinity();
  return std::nullopt;
}

std::string quotedCell(std::string_view cell) {
  std::string shown(cell.substr(0, kLongestShown));
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return std::isprint(c) == 0; }, '?');
  return "`" + shown + "`";
}

}  // namespace urban_nav_core
