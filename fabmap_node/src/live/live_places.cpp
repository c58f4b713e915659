// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_places.hpp"

#include "urban_nav_core/io/text_file.hpp"

namespace fabmap_node {

using urban_nav_core::Health;

namespace {

std::string readNamedModel(const Parameters& parameters) {
  return parameters.model == "default" ? std::string(defaultModelBytes())
                                       : urban_nav_core::readTextFile(parameters.model);
}

/// Numbers are published: new ones are appended.
enum class PlacesReason { None = 0, NoUsableImages = 1, CameraMissing = 2 };

}  // namespace

LivePlaces::LivePlaces(const Parameters& parameters, LiveSessionName name)
    : parameters_(parameters),
      name_(std::move(name)),
      model_bytes_(readNamedModel(parameters)),
      model_(parseModel(model_bytes_, parameters.model)),
      describer_(model_.vocabulary, featureOptions(parameters), MatcherOptions().look_features) {
  reset();
}

void LivePlaces::addOdometry(const urban_nav_core::StampedPose& pose) {
  if (!begin_) begin_ = pose.stamp;
  travelled_.add(pose.stamp, pose.pose.t());
}

PlaceOutput LivePlaces::process(urban_nav_core::StampNs stamp, const std::vector<urban_nav_core::ImageView>& images) {
  if (!begin_) begin_ = stamp;
  const PlaceDescription description = describer_.describe(images);
  PlaceOutput output = map_->process(stamp, description, travelled_.at(stamp));
  ++counts_.observations;
  counts_.unused += description.status != ObservationStatus::Used ? 1 : 0;
  counts_.incomplete += description.missing > 0 ? 1 : 0;
  counts_.known += output.belief.knowledge == PlaceKnowledge::Known ? 1 : 0;
  counts_.closures += static_cast<std::int64_t>(output.closures.size());
  last_ = output.belief;
  return output;
}

void LivePlaces::reset() {
  map_ = std::make_unique<FabMap>(model_, parameters_);
  map_->beginSession("");
  travelled_ = TravelledDistance();
  loaded_.clear();
  begin_.reset();
  counts_ = Counts();
  last_ = PlaceBelief();
}

urban_nav_live::StageReport LivePlaces::report() const {
  urban_nav_live::StageReport report;
  const auto degrade = [&report](PlacesReason reason, const char* name, const std::string& sentence) {
    report.status.health = Health::Degraded;
    report.status.reason = static_cast<int>(reason);
    report.reason_name = name;
    report.status.sentence = sentence;
  };
  if (last_.observation != ObservationStatus::Used)
    degrade(PlacesReason::NoUsableImages, "NoUsableImages",
            std::string("images cannot be used: ") + toString(last_.observation));
  else if (counts_.incomplete > 0 && counts_.incomplete == counts_.observations)
    degrade(PlacesReason::CameraMissing, "CameraMissing", "a camera of the panorama gives no images");
  report.summary = report.status.health == Health::Ok
                       ? std::string(toString(last_.knowledge)) + ", " + std::to_string(map_->places()) + " places"
                       : report.status.sentence;
  report.add("observations", counts_.observations);
  report.add("not used", counts_.unused);
  report.add("with a camera missing", counts_.incomplete);
  report.add("places", map_->places());
  report.add("known", counts_.known);
  report.add("closures proposed", counts_.closures);
  return report;
}

}  // namespace fabmap_node
