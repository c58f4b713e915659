// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "urban_nav_input/session/sessions.hpp"

namespace urban_nav {

/// Key of a checkpoint without the states of reader and stages, of a session whose last bag is not a part of a split
/// recording. It serves to recognise a bag that follows nevertheless.
constexpr const char* kWholeStage = "whole";

/// State of `map` at the end of a bag, stored so that the next bag of the recording continues seamlessly.
struct BagCheckpoint {
  using StageState = std::pair<std::string, std::string>;  ///< Stage::Description::key, SessionPass::checkpoint()

  std::vector<std::string> bags;        ///< fingerprints of all bags up to here, from the first of the session on
  urban_nav_core::StampNs receipt = 0;  ///< of the last message
  std::string reader;
  std::vector<StageState> stages;

  /// Returns the state of a stage; empty if it had none.
  std::string_view state(const std::string& key) const;
};

/// Returns whether a recorder may write a further bag after this one: its name ends in `_N`, as rosbag, rosbag2 and
/// `convert --split` name the parts of a recording. A date, `_2026-11-30-14-05-00`, is no such number.
bool isPartOfSplit(const std::string& bag);

std::string packBagCheckpoint(BagCheckpoint checkpoint);
/// Reads this version and version 1, which had only visual odometry. Throws DataError for other bytes.
BagCheckpoint unpackBagCheckpoint(std::string_view bytes);

/// Returns how many of a session's bags the checkpoint covers: those that are its last ones, or none if the first
/// begins less than kLongestSplit after its end. nullopt if they do not follow it.
std::optional<std::size_t> coveredBags(const BagCheckpoint& checkpoint, const std::vector<std::string>& bags,
                                       urban_nav_core::StampNs begin);

}  // namespace urban_nav
