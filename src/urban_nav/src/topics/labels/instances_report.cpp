// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/instances_report.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav {

using scene_labeler::Instance;
using scene_labeler::InstanceKind;

namespace {

std::vector<Instance> instancesOfKind(const LabelsRun& run, InstanceKind kind) {
  std::vector<Instance> of_kind;
  for (const LabelledMap& map : run.maps)
    for (const Instance& instance : map.instances)
      if (instance.kind == kind) of_kind.push_back(instance);
  return of_kind;
}

template <typename Size>
std::string medianSize(const std::vector<Instance>& instances, const Size& size) {
  std::vector<double> sizes;
  for (const Instance& instance : instances) sizes.push_back(size(instance));
  if (sizes.empty()) return "";
  std::sort(sizes.begin(), sizes.end());
  return urban_nav_core::formatNumber(sizes[sizes.size() / 2], 3);
}

std::string inSteps(double value, double steps) {
  return urban_nav_core::printNumber(std::round(value * steps) / steps);
}

}  // namespace

PageTable instancesTable(const LabelsRun& run) {
  PageTable table{"Objects", {"kind", "number", "length, m", "width, m", "height, m"}, {}, ""};
  for (std::size_t k = 0; k < scene_labeler::kInstanceKinds; ++k) {
    const auto kind = static_cast<InstanceKind>(k);
    const std::vector<Instance> instances = instancesOfKind(run, kind);
    table.rows.push_back({toString(kind), std::to_string(instances.size()),
                          medianSize(instances, [](const Instance& one) { return one.box.length; }),
                          medianSize(instances, [](const Instance& one) { return one.box.width; }),
                          medianSize(instances, [](const Instance& one) { return one.height; })});
  }
  table.caption =
      "Single vehicles, people and poles, with medians of the parts that were seen; instances.csv has the place and "
      "the "
      "size of each.";
  return table;
}

std::string printInstancesCsv(const LabelsRun& run) {
  std::string text = "map,kind,x,y,z,heading_deg,length_m,width_m,height_m,points,probability,first_ns,last_ns\n";
  for (const LabelledMap& map : run.maps)
    for (const Instance& one : map.instances) {
      text += map.file + "," + toString(one.kind);
      for (const double metres : {one.box.centre.x(), one.box.centre.y(), one.bottom})
        text += "," + inSteps(metres, 1e3);
      text += "," + inSteps(one.box.heading * 180.0 / M_PI, 10.0);
      for (const double metres : {one.box.length, one.box.width, one.height}) text += "," + inSteps(metres, 1e3);
      text += "," + std::to_string(one.points) + "," + inSteps(one.probability, 1e4) + "," + std::to_string(one.first) +
              "," + std::to_string(one.last) + "\n";
    }
  return text;
}

Json instancesJson(const LabelsRun& run) {
  Json json = Json::object();
  for (std::size_t k = 0; k < scene_labeler::kInstanceKinds; ++k) {
    const auto kind = static_cast<InstanceKind>(k);
    json[toString(kind)] = instancesOfKind(run, kind).size();
  }
  return json;
}

}  // namespace urban_nav
