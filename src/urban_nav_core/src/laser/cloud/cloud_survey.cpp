// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/laser/cloud/cloud_survey.hpp"

#include <algorithm>
#include <vector>

#include "laser/cloud/field_statistics.hpp"
#include "laser/cloud/ring_survey.hpp"
#include "laser/cloud/time_survey.hpp"

namespace urban_nav_core {

namespace {

constexpr std::size_t kFewestPoints = 50;  // least number of points of a cloud that is counted
constexpr double kFullIntensity = 255.0;   // largest intensity of a beam
constexpr double kUnitRange = 1.0, kTwelveBits = 4095.0, kSixteenBits = 65535.0;

/// Returns the full scale of an intensity field, from its largest value.
double findScale(const FieldStatistics& field, double largest) {
  if (largest <= kUnitRange) return field.is_whole ? 1.0 : kFullIntensity;
  for (const double range : {kFullIntensity, kTwelveBits, kSixteenBits})
    if (largest <= range) return kFullIntensity / range;
  return kFullIntensity / largest;
}

/// Prefers calibrated reflectances to intensities in photon counts.
void findIntensity(const std::vector<CloudStatistics>& clouds, CloudConvention& convention) {
  struct Choice {
    const FieldStatistics* field = nullptr;
    double largest = 0.0;
  };
  const auto choose = [&](bool (*is_meant)(const std::string& name)) {
    Choice choice;
    for (const FieldStatistics& field : clouds.front().fields)
      if (choice.field == nullptr && is_meant(field.name)) choice.field = &field;
    for (const CloudStatistics& cloud : clouds)
      if (choice.field != nullptr)
        if (const FieldStatistics* field = cloud.find(choice.field->name))
          choice.largest = std::max(choice.largest, field->last);
    return choice;
  };
  Choice choice = choose(isIntensity);
  if (choice.field == nullptr || choice.largest > kFullIntensity)
    if (const Choice other = choose(isReflectance); other.field != nullptr) choice = other;
  if (choice.field == nullptr) return;
  convention.intensity_field = choice.field->name;
  convention.intensity_scale = findScale(*choice.field, choice.largest);
}

}  // namespace

struct CloudSurvey::Findings {
  CloudOptions options;
  std::vector<CloudStatistics> clouds;
  RingSurvey rings;
  std::string names;
};

CloudSurvey::CloudSurvey(CloudOptions options) : findings_(std::make_unique<Findings>()) {
  findings_->options = std::move(options);
}
CloudSurvey::CloudSurvey(CloudSurvey&&) noexcept = default;
CloudSurvey& CloudSurvey::operator=(CloudSurvey&&) noexcept = default;
CloudSurvey::~CloudSurvey() = default;

void CloudSurvey::add(const CloudView& cloud) {
  const CloudPoints points(cloud);
  const UsablePoints usable = findUsablePoints(points);
  if (usable.bytes.size() < kFewestPoints) return;
  CloudStatistics statistics;
  statistics.stamp = cloud.stamp;
  findings_->names.clear();
  for (const CloudField& field : cloud.fields) {
    findings_->names += (findings_->names.empty() ? "" : ", ") + field.name;
    const bool is_coordinate = field.name == "x" || field.name == "y" || field.name == "z";
    if (!is_coordinate && points.field(field.name) && statistics.find(field.name) == nullptr)
      statistics.fields.push_back(summarise(field, points, usable));
  }
  findings_->rings.add(points, usable, statistics.fields);
  findings_->clouds.push_back(std::move(statistics));
}

bool CloudSurvey::isComplete() const { return findings_->clouds.size() >= kEnough; }

const std::string& CloudSurvey::fieldNames() const { return findings_->names; }

CloudConvention CloudSurvey::conclude() const {
  CloudConvention convention;
  convention.clouds = findings_->clouds.size();
  if (findings_->clouds.empty()) return convention;
  findings_->rings.conclude(convention);
  findPointTimes(findings_->clouds, findings_->options, convention);
  findIntensity(findings_->clouds, convention);
  return convention;
}

}  // namespace urban_nav_core
