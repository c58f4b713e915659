// SPDX-License-Identifier: BSD-3-Clause
#include <optional>

#include "map/session_fixes.hpp"
#include "pose_graph/parameters.hpp"
#include "topics/trust/trust.hpp"
#include "topics/trust/trust_files.hpp"
#include "topics/trust/trust_report.hpp"

namespace urban_nav {

namespace {

class TrustStage final : public Stage {
 public:
  Description describe() const override { return {"trust", "trust", true, false, false, {"trust.csv"}}; }
  void addTables(ParameterSet& parameters) const override {
    parameters.add(urban_nav_trust::table());
    parameters.add(pose_graph::table());
  }
  Selection select(const MapOptions& options) const override {
    if (!options.localise.empty()) return {false, "--localise", {}};
    return Stage::select(options);
  }

  std::unique_ptr<SessionPass> beginSession(MapContext& context, const SessionStart& start) override {
    const bool are_stored =
        isRequested(context.options, "lasers") || context.options.parameters.get(pose_graph::table()).gps;
    if (!are_stored) storeFixes(context, start.session);
    return nullptr;
  }

  Messages run(MapContext& context) override {
    run_ = assessTrust(context, parameters(context));
    Messages messages;
    const std::size_t failed = failedTests(*run_, parameters(context)).size();
    messages.info.push_back("trust: " + std::string(toString(run_->map.state)) + ", " +
                            std::to_string(run_->results.tests.size()) + " tests, " + std::to_string(failed) +
                            " failed" + (run_->map.reason.empty() ? "" : ": " + run_->map.reason));
    return messages;
  }

  StageResult result(const MapContext& context) const override {
    StageResult result;
    if (!run_) return result;
    result.answer = trustVerdict(*run_, parameters(context));
    result.sections.push_back({report_place::kTrust, trustSection(*run_, parameters(context))});
    result.failed_tests = failedTests(*run_, parameters(context));
    result.files.push_back({"trust.csv", [this] { return trustCsv(*run_); }});
    result.summary = toJson(*run_, parameters(context));
    return result;
  }

 private:
  static const urban_nav_trust::Parameters& parameters(const MapContext& context) {
    return context.options.parameters.get(urban_nav_trust::table());
  }

  std::optional<TrustRun> run_;
};

}  // namespace

std::unique_ptr<Stage> makeTrustStage() { return std::make_unique<TrustStage>(); }

}  // namespace urban_nav
