// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "map/stage_list.hpp"

namespace urban_nav {

/// Stages that join separately mapped sessions.
const std::vector<std::string>& stagesOfJoin();

/// Returns whether a run with these stages joins its sessions to those of --store: it recognises the places of all
/// sessions again and relaxes them together, as one run over all recordings.
bool joinsSessions(const MapOptions& options, const StageList& stages);

/// Numbers the sessions of a run that joins, previous ones and its own, in the order of their start (ties: by id), and
/// names them in that order, in its closures too. Requires that the store holds all of them.
void orderSessions(MapContext& context);

}  // namespace urban_nav
