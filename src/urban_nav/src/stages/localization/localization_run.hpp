// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "command_line/console.hpp"
#include "command_line/json.hpp"
#include "loop_metric/localiser.hpp"
#include "pipeline/output_folder.hpp"
#include "stages/vo/vo_stage.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Where a session was in a map that stays as it is.
struct LocaliseRun {
  std::vector<loop_metric::Located> frames;  ///< as known at each settled frame, from what had been seen by then
  urban_nav_core::Trajectory
      T_map_base;                        ///< of all frames, by what is known in the end; empty where it was never known
  std::size_t looks = 0, sightings = 0;  ///< views that were looked for in the map, and transforms that came of it
  std::size_t cloud_looks = 0, cloud_sightings = 0;  ///< likewise of local clouds
  double first_known_s = -1.0;                       ///< from the first frame; negative: never
  double known_share = 0.0;                          ///< of the frames
  double ms_median = 0.0;                            ///< of a look
  std::vector<std::string> warnings;
};

/// The views that `own` holds of the run are looked for among those of the map of `frozen`'s first session, and registered. Views near to where it believes to be where it
/// believes so, else all. Where no view was seen for some metres, what the lasers saw on them is looked for likewise, if both have scans. Throws UserError where the map holds no views, or those of another camera.
LocaliseRun localise(const loop_metric::Parameters& parameters, urban_nav_store::Store& frozen,
                     urban_nav_store::Store& own, const urban_nav_store::SessionId& id, const VoRun& run,
                     Console& console);

/// localisation.csv: a row per settled frame: stamp_ns, knowledge (KNOWN, NEW, UNSURE), witnesses, x...qw of T_map_base and 36 numbers of its
/// covariance (empty where nothing is known), sentence.
std::string localisationCsv(const LocaliseRun& run);

/// The object "localisation" of summary.json.
Json toJson(const LocaliseRun& run);

}  // namespace urban_nav
