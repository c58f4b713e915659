// SPDX-License-Identifier: BSD-3-Clause
#include "session/given_transforms.hpp"

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"

namespace urban_nav_input {

namespace {

constexpr double kUnitTolerance = 0.05;

[[noreturn]] void refuse(const std::string& text, const std::string& found) {
  throw urban_nav_core::UserError("--transform " + text, found,
                                  "PARENT,CHILD:X,Y,Z,QX,QY,QZ,QW with two frames, metres and a unit quaternion");
}

std::vector<double> readNumbers(const std::string& text, const std::string& numbers) {
  std::vector<double> values;
  std::istringstream words(numbers);
  for (std::string word; std::getline(words, word, ',');) {
    char* end = nullptr;
    values.push_back(std::strtod(word.c_str(), &end));
    if (word.empty() || *end != '\0' || !std::isfinite(values.back())) refuse(text, "\"" + word + "\" is not a number");
  }
  if (values.size() != 7) refuse(text, std::to_string(values.size()) + " numbers instead of 7");
  return values;
}

geometry_msgs::TransformStamped parse(const std::string& text) {
  const std::size_t comma = text.find(','), colon = text.find(':', comma == std::string::npos ? 0 : comma);
  if (comma == std::string::npos || colon == std::string::npos || comma == 0 || colon == comma + 1)
    refuse(text, "does not name two frames");
  const std::vector<double> values = readNumbers(text, text.substr(colon + 1));
  const urban_nav_core::Quaterniond rotation(values[6], values[3], values[4], values[5]);
  if (std::abs(rotation.norm() - 1.0) > kUnitTolerance)
    refuse(text, "a quaternion of length " + std::to_string(rotation.norm()));
  return urban_nav_ros::toStaticTransform(
      text.substr(0, comma), text.substr(comma + 1, colon - comma - 1),
      urban_nav_core::Pose(rotation.normalized(), urban_nav_core::Vector3d(values[0], values[1], values[2])));
}

bool isOfPreset(const std::string& text) { return !text.empty() && text.front() == '?'; }

}  // namespace

std::vector<std::string> giveTransforms(const std::vector<std::string>& given,
                                        urban_nav_ros::StaticTransforms& transforms) {
  std::vector<std::string> sentences;
  for (const std::string& text : given) {
    if (isOfPreset(text)) continue;
    transforms.give(parse(text));
    sentences.push_back("--transform " + text);
  }
  for (const std::string& text : given) {
    if (!isOfPreset(text)) continue;
    const geometry_msgs::TransformStamped transform = parse(text.substr(1));
    const bool has_base = transform.header.frame_id == urban_nav_core::frames::kBaseLink &&
                          transforms.has(urban_nav_core::frames::kBaseLink);
    if (has_base || transforms.hasParent(transform.child_frame_id)) continue;
    transforms.add(transform);
    sentences.push_back("transform of the preset, which the recording lacks: " + text.substr(1));
  }
  return sentences;
}

}  // namespace urban_nav_input
