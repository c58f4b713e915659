// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/page.hpp"
#include "base/plot.hpp"
#include "evaluation/evaluation.hpp"

namespace urban_nav {

/// Plots of an evaluation, in the frame of the truth's first pose unless said otherwise.
Plot pathPlot(const Evaluation& evaluation, int a, int b);
Plot errorPlot(const Evaluation& evaluation);
/// Error of one coordinate (0...5: x, y, z in m, rotation about them in deg) within three standard deviations; without
/// covariances the error alone.
Plot trustPlot(const Evaluation& evaluation, int coordinate);

/// "Against the truth": the plots above and a table of figures.
Section evaluationSection(const Evaluation& evaluation);
std::vector<Verdict> evaluationVerdicts(const Evaluation& evaluation);
std::vector<Tile> evaluationTiles(const Evaluation& evaluation);

/// The table that `evaluate` prints.
std::string evaluationText(const Evaluation& evaluation);

}  // namespace urban_nav
