// SPDX-License-Identifier: BSD-3-Clause
#include "topics/stereo/stereo.hpp"

#include <map>

#include "dense_stereo/parameters.hpp"
#include "map/odometry_source.hpp"
#include "topics/stereo/stereo_pass.hpp"
#include "topics/stereo/stereo_report.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace {

class StereoStage final : public Stage {
 public:
  Description describe() const override { return {"stereo", "dense_stereo", true, false, false, {}}; }
  void addTables(ParameterSet& parameters) const override { parameters.add(dense_stereo::table()); }
  std::vector<urban_nav_core::Setting> passSettings(const ParameterSet& parameters) const override {
    return parameters.settings(dense_stereo::table().stage());
  }
  Selection select(const MapOptions& options) const override {
    if (!options.localise.empty()) return {false, "not with --localise", {}};
    return {isRequested(options, "stereo"), "not in --stages", {}};
  }

  std::unique_ptr<SessionPass> beginSession(MapContext& context, const SessionStart& start) override {
    if (!usesStereo(chooseOdometry(context.options, context.sessions[start.session].info))) return nullptr;
    return std::make_unique<StereoPass>(context, start, runs_[start.session]);
  }
  bool restoreSession(MapContext&, std::size_t session, std::string_view finished) override {
    try {
      runs_[session] = StereoPass::unpackStereoRun(finished);
    } catch (const urban_nav_core::DataError&) {
      return false;
    }
    return true;
  }

  std::string missingInput(const MapContext&) const override {
    return runs_.empty() ? "no stereo images, or odometry by laser" : "";
  }

  Messages run(MapContext&) override {
    const StereoSummary summary = summariseStereo(runs());
    if (summary.pairs == 0) return {};
    return {{stereoSentence(summary)}, summary.warnings};
  }

  StageResult result(const MapContext&) const override {
    StageResult made;
    const StereoSummary summary = summariseStereo(runs());
    made.summary = toJson(summary);
    if (summary.pairs == 0) return made;
    made.verdicts = stereoVerdicts(summary);
    for (const auto& [session, run] : runs_)
      made.sections.push_back({report_place::kOdometry + 10, stereoSection(run, session, runs_.size() > 1)});
    return made;
  }

 private:
  std::vector<const StereoRun*> runs() const {
    std::vector<const StereoRun*> all;
    for (const auto& [session, run] : runs_) all.push_back(&run);
    return all;
  }

  std::map<std::size_t, StereoRun> runs_;  // by session of this run
};

}  // namespace

std::unique_ptr<Stage> makeStereoStage() { return std::make_unique<StereoStage>(); }

}  // namespace urban_nav
