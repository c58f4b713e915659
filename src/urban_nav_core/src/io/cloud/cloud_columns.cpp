// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/cloud/cloud_columns.hpp"

#include <algorithm>

#include "formats.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

constexpr std::size_t kLargestTable = std::size_t{4} << 30U;  // bytes, unpacked

/// Columns of a CSV file whose first line that is not empty is the header.
class CsvColumns {
 public:
  CsvColumns(std::string name, const std::vector<std::string>& wanted)
      : name_(std::move(name)), wanted_(wanted), columns_(wanted.size()), places_(wanted.size()) {}

  void addLine(std::string_view line, int number) {
    if (trimmed(line).empty()) return;
    const std::vector<std::string_view> cells = splitAt(line, ',');
    if (width_ == 0) return addHeader(cells);
    if (cells.size() != width_)
      throw UserError(atLine(name_, number), std::to_string(cells.size()) + " cells",
                      std::to_string(width_) + ", as many as the header has");
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
      if (!columns_[i]) continue;
      const auto value = cloud_formats::parseCoordinate(cells[places_[i]]);
      if (!value)
        throw UserError(atLine(name_, number), wanted_[i] + " = `" + std::string(cells[places_[i]].substr(0, 40)) + "`",
                        "a number");
      columns_[i]->push_back(*value);
    }
  }
  NumberColumns take() { return std::move(columns_); }

 private:
  void addHeader(const std::vector<std::string_view>& cells) {
    width_ = cells.size();
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
      const auto found = std::find(cells.begin(), cells.end(), wanted_[i]);
      if (found == cells.end()) continue;
      places_[i] = static_cast<std::size_t>(found - cells.begin());
      columns_[i].emplace();
    }
  }

  std::string name_;
  const std::vector<std::string>& wanted_;
  NumberColumns columns_;
  std::vector<std::size_t> places_;
  std::size_t width_ = 0;
};

}  // namespace

NumberColumns readCloudColumns(const std::string& path, const std::vector<std::string>& wanted) {
  return parseCloudColumns(readTextFile(path), path, wanted);
}

NumberColumns parseCloudColumns(std::string_view content, const std::string& name,
                                const std::vector<std::string>& wanted) {
  std::string plain;
  if (cloud_formats::isGzip(content)) {
    plain = cloud_formats::gunzip(content, name, kLargestTable);
    content = plain;
  }
  if (content.substr(0, 4) == "ply\n" || content.substr(0, 4) == "ply\r")
    return cloud_formats::parsePlyColumns(content, name, wanted);
  CsvColumns columns(name, wanted);
  forEachLine(content, [&columns](std::string_view line, int number) { columns.addLine(line, number); });
  return columns.take();
}

}  // namespace urban_nav_core
