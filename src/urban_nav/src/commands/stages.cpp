// SPDX-License-Identifier: BSD-3-Clause
#include "commands/stages.hpp"

#include "topics/fusion/fusion.hpp"
#include "topics/graph/graph.hpp"
#include "topics/labels/labels.hpp"
#include "topics/lasers/lasers.hpp"
#include "topics/lo/lo.hpp"
#include "topics/localization/localization.hpp"
#include "topics/loops/loops.hpp"
#include "topics/places/places.hpp"
#include "topics/stereo/stereo.hpp"
#include "topics/trust/trust.hpp"
#include "topics/vo/vo.hpp"

namespace urban_nav {

AllStages makeStages() {
  const auto calibrations = std::make_shared<std::vector<SessionCalibration>>();
  AllStages stages;
  stages.push_back(makeVoStage());
  stages.push_back(makeLoStage());
  stages.push_back(makeFusionStage());
  stages.push_back(makeKeyframesStage());
  stages.push_back(makeSweepsStage());
  stages.push_back(makePlacesStage());
  stages.push_back(makeStereoStage());
  stages.push_back(makeCalibrationStage(calibrations));
  stages.push_back(makeLoopsStage());
  stages.push_back(makeGraphStage());
  stages.push_back(makeLasersStage(calibrations));
  stages.push_back(makeLabelsStage());
  stages.push_back(makeLocalizationStage());
  stages.push_back(makeTrustStage());
  return stages;
}

void addStageTables(ParameterSet& parameters) {
  for (const std::unique_ptr<Stage>& stage : makeStages()) stage->addTables(parameters);
}

}  // namespace urban_nav
