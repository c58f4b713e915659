// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "urban_nav_core/io/g2o.hpp"

namespace urban_nav_core {

/// Pose graphs in the text format of TORO (Grisetti et al., RSS 2007), older than g2o's: VERTEX2 (or VERTEX) id x y
/// theta, EDGE2 (or EDGE) from to x y theta and the information in the order 11 12 22 33 13 23; VERTEX3 id x y z roll
/// pitch yaw, EDGE3 from to x y z roll pitch yaw and the upper triangle, row by row (m, rad). R = Rz(yaw) Ry(pitch)
/// Rx(roll).
///
/// Graphs are read as G2oGraph, so that callers handle one type. In the plane columns are only reordered: no number
/// changes in either direction. In space roll, pitch and yaw are converted to a quaternion and back to rounding; at a
/// pitch of 90 deg another pair of roll and yaw for the same rotation may be returned. The information is interpreted
/// as that of roll, pitch and yaw of the error E = Z^-1 X, which to first order are its rotation vector; it is
/// converted to g2o's by factors of 2 and 4, which are exact.
///
/// Throw UserError with file and line for a wrong number of columns, numbers that are not finite, duplicate vertices,
/// plane and space in one file, and other tags (FIX is read as in g2o) if they are refused.
G2oGraph readToro(const std::string& path, UnknownTags unknown = UnknownTags::Keep);
G2oGraph parseToro(std::string_view text, const std::string& name, UnknownTags unknown = UnknownTags::Keep);

/// Prints the lines in the order of graph.lines, like printG2o(). The format has no landmarks and no priors: they are
/// omitted.
std::string printToro(const G2oGraph& graph);
void writeToro(const std::string& path, const G2oGraph& graph);

/// Returns whether a text is in the format of TORO, by its first vertex or edge; false for g2o and without either.
bool isToro(std::string_view text);

}  // namespace urban_nav_core
