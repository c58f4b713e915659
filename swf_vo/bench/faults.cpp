// SPDX-License-Identifier: BSD-3-Clause
// Effect of a second of image faults: ratio of the final error to that of the undisturbed run, for each fault, on parts
// of kitti_raw_0926_0005 and in rendered rooms, there also relative to the covariance.
//   swf_vo-bench-faults [-o results/faults.json]
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "../test/play.hpp"
#include "support/program.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/testing/textured_room.hpp"
#include "urban_nav_core/trajectory/nees.hpp"

namespace {

using namespace swf_vo;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::Recording;

constexpr std::array<const char*, 14> kFaults = {
    "black:1.5:1",       "freeze:1.5:1",  "drop:1.5:1",        "drop:1:10:0.3", "swap:1.5:1",
    "blur:1.5:1",        "blur:1.5:1:2",  "blur:0.5:3",        "noleft:1.5:1",  "overexpose:1.5:1",
    "corrupt:1.5:1:0.1", "corrupt:1.5:1", "corrupt:1.5:1:0.6", "equal:1.5:0.5"};
constexpr const char* kNone = "black:1000:1";
constexpr std::size_t kPieceFrames = 70;
constexpr int kRoomFrames = 80;

struct Outcome {
  double error = 0.0, nees = 0.0;
  int blamed = -1;  // frames from the start of the fault until the status was not OK
  bool lost = false;
};

Outcome play(const Recording& recording, const std::string& what) {
  Outcome outcome;
  playWithFault(recording, what, [&](const Played& played) {
    const Frame& frame = played.frame;
    if (outcome.blamed < 0 && frame.status.health != urban_nav_core::Health::Ok) outcome.blamed = played.since;
    if (!frame.accepted) return;
    const urban_nav_core::Pose& truth = recording.truth[played.index];
    outcome.error = distanceBetween(truth, frame.T_odom_base.pose);
    outcome.nees = urban_nav_core::nees(truth, frame.T_odom_base).value_or(0.0);
    outcome.lost = frame.status.health == urban_nav_core::Health::Lost;
  });
  return outcome;
}

std::vector<Recording> street() {
  std::vector<Recording> pieces;
  const std::string folder = urban_nav_core::testing::dataFolder("stereo/kitti_raw_0926_0005");
  if (!folder.empty())
    for (std::size_t first = 0; first <= 80; first += 20)
      pieces.push_back(urban_nav_core::testing::readSequenceFolder(folder, first, kPieceFrames));
  return pieces;
}

std::vector<Recording> rooms() {
  std::vector<Recording> result;
  for (const char* motion : {"wander", "loop", "turns"})
    for (std::uint32_t seed = 1; seed <= 2; ++seed) {
      urban_nav_core::testing::SequenceOptions options;
      options.seed = seed;
      urban_nav_core::testing::RenderedSequence sequence(urban_nav_core::testing::texturedRoom({}, seed),
                                                         urban_nav_core::testing::namedMotion(motion, "room", seed),
                                                         options);
      result.push_back(urban_nav_core::testing::record(sequence, kRoomFrames));
    }
  return result;
}

struct Sum {
  double squares = 0.0, nees = 0.0;
  int latest = 0, lost = 0, count = 0;
  void add(const Outcome& outcome) {
    squares += outcome.error * outcome.error;
    nees += outcome.nees;
    latest = std::max(latest, outcome.blamed);
    lost += outcome.lost ? 1 : 0;
    ++count;
  }
  double rms() const { return std::sqrt(squares / std::max(1, count)); }
};

Sum playAll(const std::vector<Recording>& recordings, const std::string& fault) {
  Sum sum;
  for (const Recording& recording : recordings) sum.add(play(recording, fault));
  return sum;
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string output = argc == 3 && std::string(argv[1]) == "-o" ? argv[2] : "";
  BenchTable table({"fault (kind:start:seconds)", "street: error over the undisturbed one's",
                    "status not OK after, frames", "still lost at the end", "rooms: error over the undisturbed one's",
                    "NEES at the end", "status not OK after, frames", "still lost at the end"},
                   argc, argv);
  const std::vector<Recording> pieces = street(), rendered = rooms();
  const Sum usual_street = playAll(pieces, kNone), usual_rooms = playAll(rendered, kNone);
  for (const char* fault : kFaults) {
    const Sum s = playAll(pieces, fault), r = playAll(rendered, fault);
    const auto share = [](int part, int whole) { return std::to_string(part) + " of " + std::to_string(whole); };
    table.add({fault, s.count == 0 ? "-" : cell(s.rms() / usual_street.rms(), 2), std::to_string(s.latest),
               share(s.lost, s.count), cell(r.rms() / usual_rooms.rms(), 2), cell(r.nees / r.count, 1),
               std::to_string(r.latest), share(r.lost, r.count)});
  }
  table.note(
      "Root mean square over five pieces of kitti_raw_0926_0005, 7 s each, and over six rendered rooms, 4 s each; "
      "undisturbed " +
      cell(100.0 * usual_street.rms(), 1) + " cm and " + cell(1000.0 * usual_rooms.rms(), 2) + " mm, NEES " +
      cell(usual_rooms.nees / usual_rooms.count, 1) + " in the rooms.");
  return swf_vo::bench::show(table, output);
} catch (const std::exception& error) {
  return swf_vo::bench::complain(error);
}
