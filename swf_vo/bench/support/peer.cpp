// SPDX-License-Identifier: BSD-3-Clause
#include "peer.hpp"

#include <filesystem>

#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/types/error.hpp"

namespace swf_vo::bench {

namespace {

std::vector<urban_nav_core::Pose> readPoses(const std::string& path) {
  if (std::filesystem::path(path).extension() != ".tum") return urban_nav_core::readKitti(path);
  std::vector<urban_nav_core::Pose> poses;
  for (const auto& stamped : urban_nav_core::readTum(path)) poses.push_back(stamped.pose);
  return poses;
}

}  // namespace

std::vector<Peer> readPeers(const Sequence& sequence, const std::vector<std::string>& arguments) {
  std::vector<Peer> peers;
  for (const std::string& argument : arguments) {
    const auto first = argument.find('='), second = argument.find('=', first + 1);
    if (second == std::string::npos || argument.substr(first + 1, second - first - 1) != sequence.name) continue;
    peers.push_back({argument.substr(0, first), readPoses(argument.substr(second + 1))});
    const Peer& peer = peers.back();
    if (peer.poses.size() != sequence.truth.size())
      throw urban_nav_core::UserError(peer.name + " on " + sequence.name, std::to_string(peer.poses.size()) + " poses",
                                      std::to_string(sequence.truth.size()) + ", as many as the truth");
  }
  return peers;
}

}  // namespace swf_vo::bench
