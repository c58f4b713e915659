// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "map/chain_g2o.hpp"
#include "map/odometry_store_writer.hpp"
#include "map/store_keys.hpp"
#include "topics/fusion/fused_session.hpp"
#include "topics/fusion/fusion.hpp"
#include "topics/fusion/fusion_report.hpp"

namespace urban_nav {

namespace {

class FusionStage final : public Stage {
 public:
  Description describe() const override { return {"fusion", kFusionStage, false, false, false, {"graph#.g2o"}}; }
  Selection select(const MapOptions& options) const override {
    const bool may_be_both = options.odometry == OdometryOption::Auto && isRequested(options, "lo");
    return {options.odometry == OdometryOption::Both || may_be_both, "--odometry", {}};
  }

  Messages run(MapContext& context) override {
    Messages messages;
    const bool any = std::any_of(context.sessions.begin(), context.sessions.end(),
                                 [](const MapSession& session) { return session.by_laser != nullptr; });
    if (!any) return messages;
    for (MapSession& session : context.sessions) {
      if (!session.by_laser) continue;
      if (session.by_laser->settled.size() < 2) {
        messages.warnings.push_back(session.info.name + ": no sweep could be registered; odometry is from stereo only");
        continue;
      }
      const auto fused = std::make_shared<SessionOdometry>(fuseSession(*session.odometry, *session.by_laser));
      session.odometry = fused;
      OdometryStoreWriter(*context.store, session.id, kFusionStage, kVoStream).replaceNodes(*fused, kVoStage);
      for (const std::string& sentence : conflictSentences(*fused)) messages.warnings.push_back(sentence);
      for (const std::string& sentence : constantSentences(*fused)) messages.warnings.push_back(sentence);
      messages.info.push_back(fusionSentence(*fused));
    }
    context.trajectories = odometryTrajectories(context.runs(), context.sessionsKept());
    faults_ = messages.warnings;
    return messages;
  }

  StageResult result(const MapContext& context) const override {
    StageResult result;
    result.data_faults = faults_;
    for (std::size_t i = 0; i < context.sessions.size(); ++i) {
      const std::shared_ptr<SessionOdometry> run = context.sessions[i].odometry;
      if (!run->fusion) continue;
      result.method = "Odometry by stereo and laser";
      Section section = fusionSection(*run);
      if (context.sessions.size() > 1) {
        section.id += std::to_string(i + 1);
        section.title += " (session " + std::to_string(i + 1) + ")";
      }
      result.sections.push_back({report_place::kOdometry, std::move(section)});
      for (Verdict& verdict : fusionVerdicts(*run)) result.verdicts.push_back(verdict);
      if (!context.relaxed)
        result.files.push_back({"graph" + fileSuffix(context.number(i)) + ".g2o", [run] { return chainG2o(*run); }});
    }
    return result;
  }

 private:
  std::vector<std::string> faults_;
};

}  // namespace

std::unique_ptr<Stage> makeFusionStage() { return std::make_unique<FusionStage>(); }

}  // namespace urban_nav
