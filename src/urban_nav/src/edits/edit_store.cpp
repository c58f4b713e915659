// SPDX-License-Identifier: BSD-3-Clause
#include "edits/edit_store.hpp"

#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/stored_ids.hpp"

namespace urban_nav {

using urban_nav_store::Access;
using urban_nav_store::Store;

namespace {

std::string moveText(double metres) {
  if (metres < 0.01) return urban_nav_core::formatNumber(1e3 * metres, 3) + " mm";
  if (metres < 1.0) return urban_nav_core::formatNumber(1e2 * metres, 3) + " cm";
  return urban_nav_core::formatNumber(metres, 4) + " m";
}

std::string idList(const std::vector<std::int64_t>& ids) {
  std::string text;
  for (const std::int64_t id : ids) text += (text.empty() ? "" : ", ") + std::to_string(id);
  return text;
}

std::string figureText(const std::optional<double>& figure) {
  return figure ? urban_nav_core::formatNumber(*figure, 4) : std::string("unknown");
}

/// Opens a store for an edit. Throws DataError while another program writes it.
Store openForEditing(const std::string& path) {
  try {
    return Store(path, Access::Write);
  } catch (const urban_nav_core::UserError& error) {
    throw urban_nav_core::DataError(path, error.parts().found, error.parts().allowed);
  }
}

}  // namespace

EditResult editStore(const Arguments& arguments) {
  const std::string path = arguments.get("STORE");
  EditResult result;
  StoredMeasurements measurements;
  {
    Store store = urban_nav_store::openForReading(path, Access::Snapshot);
    measurements = readMeasurements(store);
    result.request = readEditRequest(arguments, store, measurements);
  }
  if (result.request.unchanged.empty()) {
    Store store = openForEditing(path);
    result.outcome = makeEdit(store, measurements, result.request);
    store.close();
  } else {
    Store store = urban_nav_store::openForReading(path, Access::Snapshot);
    result.outcome = makeEdit(store, measurements, result.request);
  }
  return result;
}

std::string describe(const EditResult& result) {
  const EditRequest& request = result.request;
  const EditOutcome& outcome = result.outcome;
  if (!outcome.changed) return "nothing changed: " + outcome.reason + "\n";
  std::string text = "edit " + std::to_string(*outcome.edit) +
                     (request.action == "undo"   ? " undone"
                      : request.action == "redo" ? " redone"
                                                 : " applied") +
                     "; poses moved by up to " + moveText(outcome.moved.largest) + ", rms " +
                     moveText(outcome.moved.rms) + "\n";
  if (outcome.edge) text += "closure " + std::to_string(*outcome.edge) + " added\n";
  if (!outcome.contradicted_by.empty()) text += "contradicted by closures " + idList(outcome.contradicted_by) + "\n";
  text += "cost " + urban_nav_core::formatNumber(outcome.before.cost, 5) + " -> " +
          urban_nav_core::formatNumber(outcome.after.cost, 5);
  if (outcome.before.planes_over_noise || outcome.after.planes_over_noise)
    text += ", planes over noise " + figureText(outcome.before.planes_over_noise) + " -> " +
            figureText(outcome.after.planes_over_noise);
  return text + "\n";
}

Json toJson(const EditOutcome& outcome) {
  const auto optional = [](const auto& value) { return value ? Json(*value) : Json(); };
  Json json = Json::object({{"changed", outcome.changed},
                            {"reason", outcome.reason},
                            {"edit", optional(outcome.edit)},
                            {"edge", optional(outcome.edge)}});
  json["moved"] = Json::object({{"largest_m", outcome.moved.largest}, {"rms_m", outcome.moved.rms}});
  Json& ids = json["contradicted_by"] = Json::array();
  for (const std::int64_t id : outcome.contradicted_by) ids.append(id);
  json["cost_before"] = outcome.before.cost;
  json["cost_after"] = outcome.after.cost;
  json["planes_over_noise_before"] = optional(outcome.before.planes_over_noise);
  json["planes_over_noise_after"] = optional(outcome.after.planes_over_noise);
  Json& warnings = json["warnings"] = Json::array();
  for (const std::string& warning : outcome.warnings) warnings.append(warning);
  return json;
}

}  // namespace urban_nav
