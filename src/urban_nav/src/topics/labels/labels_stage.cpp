// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/labels.hpp"

#include <algorithm>

#include "base/plot.hpp"
#include "map/stage_result.hpp"
#include "scene_labeler/class_map.hpp"
#include "scene_labeler/parameters.hpp"
#include "topics/labels/instances_report.hpp"
#include "topics/labels/labels_report.hpp"
#include "topics/labels/labels_run.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav {

namespace {

/// Runs after stage lasers, whose map it labels.
class LabelsStage final : public Stage {
 public:
  Description describe() const override {
    return {"labels", "scene_labeler", true, false, false, {"labels.csv", "instances.csv"}};
  }
  void addTables(ParameterSet& parameters) const override { parameters.add(scene_labeler::table()); }
  std::vector<std::string> topicsRead(const ParameterSet& parameters) const override {
    return {parameters.get(scene_labeler::table()).class_topic};
  }
  Selection select(const MapOptions& options) const override {
    if (!options.localise.empty()) return {false, "not with --localise", {}};
    if (!isRequested(options, "labels")) return {false, "not in --stages", {}};
    const scene_labeler::Parameters& parameters = options.parameters.get(scene_labeler::table());
    // Reports invalid files before the run.
    if (parameters.model != "default") readLabelModel(parameters.model);
    if (!parameters.class_file.empty()) scene_labeler::ClassMap(parameters.class_file);
    return {true, "", {"labels: model " + parameters.model}};
  }

  std::string missingInput(const MapContext& context) const override {
    if (!isRequested(context.options, "lasers")) return "no map of the lasers: stage lasers is not in --stages";
    const std::vector<urban_nav_store::SessionId> ids = context.ids();
    const bool any =
        std::any_of(ids.begin(), ids.end(), [&](const auto& id) { return hasLaserMeasurements(*context.store, id); });
    return any ? "" : "no laser scans or sweeps of a 3D LiDAR";
  }

  Messages run(MapContext& context) override {
    const scene_labeler::Parameters& parameters = context.options.parameters.get(scene_labeler::table());
    run_ = runLabels(readLabelModel(parameters.model, parameters.precision), context);
    return {
        {"labels: " + std::to_string(run_->labelled()) + " of " + std::to_string(run_->points()) + " points from " +
         std::to_string(run_->views()) + " images, " + std::to_string(run_->unsure()) + " of them unsure, in " +
         urban_nav_core::formatNumber(run_->seconds, 3) + " s" +
         (run_->class_topic.empty() ? ""
                                    : ", with class images for " + std::to_string(run_->classImages()) + " images")},
        labelsWarnings(*run_)};
  }

  StageResult result(const MapContext&) const override {
    StageResult made;
    if (!run_) return made;
    made.method = "labels";
    made.sections.push_back({report_place::kMap, labelsSection(*run_)});
    made.data_faults = labelsWarnings(*run_);
    const LabelsRun& run = *run_;
    made.files.push_back({"labels.csv", [run] { return printLabelsCsv(run); }});
    made.files.push_back({"instances.csv", [run] { return printInstancesCsv(run); }});
    made.summary = toJson(*run_);
    return made;
  }

 private:
  std::optional<LabelsRun> run_;
};

}  // namespace

std::unique_ptr<Stage> makeLabelsStage() { return std::make_unique<LabelsStage>(); }

}  // namespace urban_nav
