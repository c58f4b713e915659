// SPDX-License-Identifier: BSD-3-Clause
#include "topics/places/places.hpp"

#include "base/plot.hpp"
#include "map/odometry_source.hpp"
#include "topics/places/place_verdicts.hpp"
#include "topics/places/places_pass.hpp"
#include "topics/places/places_report.hpp"
#include "topics/places/places_run.hpp"

namespace urban_nav {

namespace {

class PlacesStage final : public Stage {
 public:
  Description describe() const override { return {"places", "fabmap_node", true, false, true, {}}; }
  void addTables(ParameterSet& parameters) const override {
    parameters.add(fabmap_node::table());
    parameters.add(urban_nav_registration::table());
  }
  std::vector<urban_nav_core::Setting> passSettings(const ParameterSet& parameters) const override {
    std::vector<urban_nav_core::Setting> used;
    for (const urban_nav_core::Setting& setting : parameters.settings(fabmap_node::table().stage()))
      if (setting.name == "model" || setting.name == "panorama_features" || setting.name == "image_features")
        used.push_back(setting);
    for (const urban_nav_core::Setting& setting : parameters.settings(urban_nav_registration::table().stage()))
      if (setting.name == "keyframe_distance" || setting.name == "keyframe_angle") used.push_back(setting);
    return used;
  }
  Selection select(const MapOptions& options) const override {
    if (!options.localise.empty()) return {false, "not with --localise", {}};
    if (!isRequested(options, "places")) return {false, "not in --stages", {}};
    const fabmap_node::Parameters& parameters = options.parameters.get(fabmap_node::table());
    if (parameters.model != "default") loadPlaceModel(parameters);  // reports a bad file before the work
    return {true, "", {"places: model " + parameters.model}};
  }

  std::unique_ptr<SessionPass> beginSession(MapContext& context, const SessionStart& start) override {
    if (!usesStereo(chooseOdometry(context.options, context.sessions[start.session].info))) return nullptr;
    return std::make_unique<PlacesPass>(context, start, model(context), ms_features_);
  }

  Messages run(MapContext& context) override {
    run_ = runPlaces(context.options.parameters.get(fabmap_node::table()), *model(context), context,
                     context.divides ? &known_agreements_ : nullptr);
    if (!context.groups.empty() || context.learnt)
      context.closures = context.given;  // instead of those of the recognition before
    if (isRequested(context.options, "loops")) addProposed(run_->closures, "places", context.closures);
    if (run_->observations == 0) return {{}, run_->warnings};
    return {{"places: " + std::to_string(run_->observations) + (run_->has_panoramas ? " panoramas, " : " images, ") +
             std::to_string(run_->closures.size()) + " closures proposed"},
            run_->warnings};
  }

  StageResult result(const MapContext& context) const override {
    StageResult made;
    if (!run_) return made;
    const PlacesRun verified = withVerdicts(*run_, context.options.parameters.get(fabmap_node::table()), context);
    made.summary = toJson(verified, ms_features_);
    if (verified.observations == 0) return made;
    made.verdicts = placesVerdicts(verified);
    made.sections.push_back({report_place::kClosures + 10, placesSection(verified, placePictures(verified, context))});
    return made;
  }

 private:
  std::shared_ptr<const LoadedPlaceModel> model(const MapContext& context) {
    if (!model_) model_ = loadPlaceModel(context.options.parameters.get(fabmap_node::table()));
    return model_;
  }

  std::shared_ptr<const LoadedPlaceModel> model_;
  std::vector<double> ms_features_;
  fabmap_node::AgreementCache known_agreements_;  // of the recognitions of one run
  std::optional<PlacesRun> run_;
};

}  // namespace

std::unique_ptr<Stage> makePlacesStage() { return std::make_unique<PlacesStage>(); }

}  // namespace urban_nav
