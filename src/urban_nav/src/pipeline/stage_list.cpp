// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stage_list.hpp"

#include "stages/graph/graph_stage.hpp"
#include "stages/keyframes/keyframes_stage.hpp"
#include "stages/labels/labels_stage.hpp"
#include "stages/lasers/calibration_stage.hpp"
#include "stages/lasers/lasers_stage.hpp"
#include "stages/localization/localization_stage.hpp"
#include "stages/loops/loops_stage.hpp"
#include "stages/places/places_stage.hpp"
#include "stages/stereo/stereo_stage.hpp"
#include "stages/vo/vo_stage.hpp"

namespace urban_nav {

std::vector<std::unique_ptr<Stage>> makeStages() {
  std::vector<std::unique_ptr<Stage>> stages;
  stages.push_back(makeVoStage());
  stages.push_back(makeKeyframesStage());
  stages.push_back(makePlacesStage());
  stages.push_back(makeStereoStage());
  stages.push_back(makeCalibrationStage());
  stages.push_back(makeLoopsStage());
  stages.push_back(makeGraphStage());
  stages.push_back(makeLasersStage());
  stages.push_back(makeLabelsStage());
  stages.push_back(makeLocalizationStage());
  return stages;
}

std::vector<std::string> stageNames() {
  std::vector<std::string> names;
  for (const std::unique_ptr<Stage>& stage : makeStages())
    if (stage->describe().listed) names.push_back(stage->describe().name);
  return names;
}

}  // namespace urban_nav
