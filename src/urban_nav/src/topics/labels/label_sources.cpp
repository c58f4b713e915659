// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/label_sources.hpp"

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using urban_nav_core::UserError;

namespace {

std::string stem(const std::string& bag) { return std::filesystem::path(bag).stem().string(); }

}  // namespace

LabelSources findLabelSources(const Arguments& arguments, const ParameterSet& parameters,
                              const OdometryRunner& run_odometry) {
  LabelSources sources;
  std::vector<std::string> folders, bags;
  for (const std::string& source : arguments.all("SRC")) (isBag(source) ? bags : folders).push_back(source);
  for (const std::string& bag : bags)
    if (!std::filesystem::exists(bag)) throw UserError(bag, "does not exist", "bags and folders of scenes");
  const std::vector<std::string> trajectories = arguments.all("trajectory");
  if (!trajectories.empty() && trajectories.size() != bags.size())
    throw UserError("--trajectory",
                    std::to_string(trajectories.size()) + " files for " + std::to_string(bags.size()) + " bags",
                    "one for each bag, in their order");
  std::vector<std::size_t> order(bags.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return stem(bags[a]) != stem(bags[b]) ? stem(bags[a]) < stem(bags[b]) : bags[a] < bags[b];
  });
  for (const std::size_t i : order) {
    if (!sources.bags.empty() && stem(sources.bags.back()) == stem(bags[i]))
      throw UserError(bags[i], "has the name of " + sources.bags.back(), "one bag of each name");
    sources.bags.push_back(bags[i]);
    sources.drives.push_back(
        {run_odometry, &parameters, arguments.all("topic"), trajectories.empty() ? std::string() : trajectories[i]});
  }
  if (!folders.empty()) sources.scenes = findScenes(folders);
  return sources;
}

Option classesOption() {
  return {"--classes",
          "NAME|FILE",
          "classes of the values of label: kitti, semantickitti, nuscenes, or a file id,class (default: the numbers of "
          "the classes)",
          false,
          false,
          {}};
}

scene_labeler::ClassMap readClassMap(const Arguments& arguments) {
  return arguments.has("classes") ? scene_labeler::ClassMap(arguments.get("classes")) : scene_labeler::ClassMap();
}

std::vector<Option> driveCommandOptions() {
  return {{"--trajectory",
           "FILE",
           "TUM file with poses of base_link, for each bag (default: the odometry of its stereo images or LiDAR, else "
           "its tf)",
           false,
           true,
           {}},
          {"--topic",
           "ROLE:=NAME",
           "topic of a bag: laser_left, laser_right, points0, panorama1, panorama4, ... (default: guessed)",
           false,
           true,
           {}}};
}

}  // namespace urban_nav
