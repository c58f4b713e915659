// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "command_line/json.hpp"
#include "evaluation/evaluation.hpp"
#include "report/page.hpp"
#include "stages/graph/graph_stage.hpp"

namespace urban_nav {

/// Before and after relaxation: paths with the closures between them, every closure with its verdict, cost over iterations, and
/// errors against the truth where there is one. `before`, `after`: one per session.
Section graphSection(const GraphRun& graph, const std::vector<const VoRun*>& runs,
                     const std::vector<std::optional<Evaluation>>& before,
                     const std::vector<std::optional<Evaluation>>& after);

/// What it says in plain words.
std::vector<Verdict> graphVerdicts(const GraphRun& graph);

/// The object "pose_graph" of summary.json. `before`, `after`: one per session.
Json toJson(const GraphRun& graph, const std::vector<std::optional<Evaluation>>& before,
            const std::vector<std::optional<Evaluation>>& after);

}  // namespace urban_nav
