// SPDX-License-Identifier: BSD-3-Clause
#include "topics/localization/localization.hpp"

#include "base/plot.hpp"
#include "topics/localization/localization_run.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/stored_ids.hpp"

namespace urban_nav {

using urban_nav_store::Access;
using urban_nav_store::Store;

namespace {

std::string describeRun(const LocalizationRun& run) {
  return "localised: KNOWN in " + urban_nav_core::formatNumber(100.0 * run.known_share, 3) + " % of the frames" +
         (run.first_known_s < 0.0 ? "" : ", first after " + urban_nav_core::formatNumber(run.first_known_s, 3) + " s") +
         "; " + std::to_string(run.sightings) + " matches in " + std::to_string(run.looks) + " looks" +
         (run.cloud_looks == 0
              ? ""
              : ", " + std::to_string(run.cloud_sightings) + " in " + std::to_string(run.cloud_looks) + " at clouds");
}

class LocalizationStage final : public Stage {
 public:
  Description describe() const override {
    return {"localization", "localisation", false, false, false, {"localisation#.csv"}};
  }
  void addTables(ParameterSet& parameters) const override {
    parameters.add(urban_nav_registration::table());
    parameters.add(urban_nav_localization::table());
  }
  Selection select(const MapOptions& options) const override {
    if (options.localise.empty()) return {false, "no --localise", {}};
    if (!options.store.empty())
      throw urban_nav_core::UserError("--localise", "--localise only reads the map, --store continues one",
                                      "one of them");
    urban_nav_store::openForReading(options.localise, Access::Frozen)
        .close();  // reports an unusable file before the run
    return {true, "", {"each session is localised in the map of " + options.localise + ", which is only read"}};
  }

  Messages run(MapContext& context) override {
    Store frozen = urban_nav_store::openForReading(context.options.localise, Access::Frozen);
    urban_nav_localization::Parameters parameters = context.options.parameters.get(urban_nav_localization::table());
    parameters.registration = context.options.parameters.get(urban_nav_registration::table());
    Messages messages;
    for (std::size_t i = 0; i < context.sessions.size(); ++i) {
      const MapSession& session = context.sessions[i];
      runs_.push_back(
          runLocalization(parameters, frozen, *context.store, session.id, *session.odometry, context.console));
      const LocalizationRun& made = runs_.back();
      messages.info.push_back(describeRun(made));
      messages.warnings.insert(messages.warnings.end(), made.warnings.begin(), made.warnings.end());
      if (!made.T_map_base.empty()) context.trajectories[context.number(i)].localized = made.T_map_base;
    }
    return messages;
  }

  StageResult result(const MapContext&) const override {
    StageResult made;
    for (std::size_t i = 0; i < runs_.size(); ++i)
      made.files.push_back(
          {"localisation" + fileSuffix(i) + ".csv", [&run = runs_[i]] { return localizationCsv(run); }});
    if (!runs_.empty()) made.summary = toJson(runs_.front());
    return made;
  }

 private:
  std::vector<LocalizationRun> runs_;
};

}  // namespace

std::unique_ptr<Stage> makeLocalizationStage() { return std::make_unique<LocalizationStage>(); }

}  // namespace urban_nav
