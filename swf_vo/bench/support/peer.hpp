// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "run.hpp"

namespace swf_vo::bench {

/// Result of another system for a sequence.
struct Peer {
  std::string name;
  std::vector<urban_nav_core::Pose> poses;  ///< left camera, one per frame
};

/// Reads the files that belong to the sequence from arguments "NAME=SEQUENCE=FILE"; FILE: poses in KITTI's or (.tum)
/// the TUM format. Throws UserError if a file cannot be read or its number of poses differs from the sequence.
std::vector<Peer> readPeers(const Sequence& sequence, const std::vector<std::string>& arguments);

}  // namespace swf_vo::bench
