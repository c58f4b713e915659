// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "run.hpp"

namespace swf_vo::bench {

/// What another system made of a sequence.
struct Peer {
  std::string name;
  std::vector<urban_nav_core::Pose> poses;  ///< of the left camera, one a frame
};

/// Of "NAME=SEQUENCE=FILE" each that belongs to the sequence; FILE: poses in KITTI's or (.tum) the TUM format. Throws
/// UserError where a file cannot be read, or has not as many poses as the sequence.
std::vector<Peer> readPeers(const Sequence& sequence, const std::vector<std::string>& arguments);

}  // namespace swf_vo::bench
