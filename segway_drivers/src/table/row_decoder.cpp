// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/table/row_decoder.hpp"

#include <algorithm>

#include "table/rows.hpp"
#include "urban_nav_core/types/error.hpp"

namespace segway_drivers {

namespace {

struct RowKind {
  std::string name, columns;
};

const std::vector<RowKind>& rowKinds() {
  static const std::vector<RowKind> kinds = {{"lms291", "index,status,ranges,reflectivities"}};
  return kinds;
}

const RowKind& findRowKind(const std::string& kind) {
  const auto& kinds = rowKinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const RowKind& each) { return each.name == kind; });
  if (found != kinds.end()) return *found;
  std::string allowed;
  for (const RowKind& each : kinds) allowed += (allowed.empty() ? "" : ", ") + each.name;
  throw urban_nav_core::UserError("KIND", kind, allowed);
}

}  // namespace

const std::vector<std::string>& deviceKinds() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const RowKind& each : rowKinds()) list.push_back(each.name);
    return list;
  }();
  return names;
}

std::string rowColumns(const std::string& kind) { return findRowKind(kind).columns; }

std::unique_ptr<RowDecoder> makeRowDecoder(const std::string& kind, const Parameters& parameters,
                                           const ImageFolder& /*images*/, RowDecoder::Sink sink) {
  findRowKind(kind);
  return makeLmsRows(parameters, std::move(sink));
}

}  // namespace segway_drivers
