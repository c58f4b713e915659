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
/// They become a G2oGraph, so that who has one needs no second case. In the plane only the columns change places: no
/// number changes in either direction. In space roll, pitch and yaw become a quaternion and come back to the last bits
/// alone; where pitch is 90 deg, roll and yaw come back as another pair that is the same rotation. The information is
/// taken for that of the error's roll, pitch and yaw, E = Z^-1 X, which at a small error are its rotation vector: it
/// becomes g2o's by factors of 2 and 4, which are exact.
///
/// Throw UserError with file and line for: a wrong number of columns, numbers that are not finite, doubled vertices,
/// plane and space in one file, and other tags (FIX is read as in g2o) if they are refused.
G2oGraph readToro(const std::string& path, UnknownTags unknown = UnknownTags::Keep);
G2oGraph parseToro(std::string_view text, const std::string& name, UnknownTags unknown = UnknownTags::Keep);

/// Lines in the order of graph.lines, as printG2o. The format has no landmarks and no priors: they are left out.
std::string printToro(const G2oGraph& graph);
void writeToro(const std::string& path, const G2oGraph& graph);

/// Which of the two formats a text is in, by its first vertex or edge: true for TORO, false for g2o and where there is
/// neither.
bool isToro(std::string_view text);

}  // namespace urban_nav_core
