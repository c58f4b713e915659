// SPDX-License-Identifier: BSD-3-Clause
#include "topics/loops/loops.hpp"

#include "map/odometry_source.hpp"
#include "topics/loops/keyframe_writer.hpp"
#include "urban_nav_core/types/frames.hpp"

namespace urban_nav {

namespace {

class KeyframesPass final : public SessionPass {
 public:
  KeyframesPass(MapContext& context, const Stage::SessionStart& start)
      : store_(*context.store),
        id_(context.sessions[start.session].id),
        writer_(context.options.parameters.get(urban_nav_registration::table()),
                context.sessions[start.session].info.camera, context.options.threads == 1) {
    if (start.checkpoint)
      writer_.resume(*context.sessions[start.session].odometry,
                     store_.keyframes().stamps(id_, urban_nav_core::frames::kStereoLeft));
  }

  void process(PassItem& item) override {
    if (const auto keyframe = writer_.process(item.input.assembled, *item.odometry)) put(*keyframe);
  }
  std::string checkpoint() override {
    writeAll();
    return {};
  }
  void finish(const PassEnd&) override { writeAll(); }

 private:
  void put(const urban_nav_store::StoredKeyframe& keyframe) {
    store_.keyframes().put(id_, urban_nav_core::frames::kStereoLeft, keyframe);
  }
  void writeAll() {
    while (const auto keyframe = writer_.next()) put(*keyframe);
  }

  urban_nav_store::Store& store_;
  urban_nav_store::SessionId id_;
  KeyframeWriter writer_;
};

class KeyframesStage final : public Stage {
 public:
  Description describe() const override { return {"keyframes", "keyframes", false, false, false, {}}; }
  void addTables(ParameterSet& parameters) const override { parameters.add(urban_nav_registration::table()); }
  std::vector<urban_nav_core::Setting> passSettings(const ParameterSet& parameters) const override {
    std::vector<urban_nav_core::Setting> used;
    for (const urban_nav_core::Setting& setting : parameters.settings(urban_nav_registration::table().stage()))
      if (setting.name == "points" || setting.name == "keyframe_distance" || setting.name == "keyframe_angle")
        used.push_back(setting);
    return used;
  }
  Selection select(const MapOptions& options) const override {
    return {isRequested(options, "loops") || !options.localise.empty(), "neither loops nor --localise", {}};
  }
  std::unique_ptr<SessionPass> beginSession(MapContext& context, const SessionStart& start) override {
    if (chooseOdometry(context.options, context.sessions[start.session].info) != OdometrySource::Stereo) return nullptr;
    return std::make_unique<KeyframesPass>(context, start);
  }
};

}  // namespace

std::unique_ptr<Stage> makeKeyframesStage() { return std::make_unique<KeyframesStage>(); }

}  // namespace urban_nav
