// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/page.hpp"
#include "base/plot.hpp"
#include "evaluation/evaluation.hpp"

namespace urban_nav {

/// Returns the plot of two coordinates of both paths, in the frame of the first pose of the truth.
Plot pathPlot(const Evaluation& evaluation, int a, int b);
Plot errorPlot(const Evaluation& evaluation);
/// Returns the plot of the error of a coordinate (0...5: x, y, z in m, rotation about them in deg) with three standard
/// deviations, if there are covariances.
Plot trustPlot(const Evaluation& evaluation, int coordinate);

/// Returns the section "Against the truth": the plots and a table of figures.
Section evaluationSection(const Evaluation& evaluation);
std::vector<Verdict> evaluationVerdicts(const Evaluation& evaluation);
std::vector<Tile> evaluationTiles(const Evaluation& evaluation);

/// Returns the table printed by `evaluate`.
std::string evaluationText(const Evaluation& evaluation);

}  // namespace urban_nav
