// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/testing/sequence_folder.hpp"
#include "urban_nav_core/testing/textured_room.hpp"
#include "urban_nav_core/testing/textured_street.hpp"
#include "urban_nav_core/types/error.hpp"

namespace {

using namespace urban_nav_core;
using namespace urban_nav_core::testing;

constexpr const char* kHelp = R"(usage: render_sequence DIR [OPTION VALUE]...

Renders a stereo sequence with exact truth into DIR, as a folder of KITTI odometry: image_0/%06d.png (left), image_1
(right), calib.txt, times.txt, and poses.txt (left camera, relative to the first frame). DIR must not exist or be empty;
poses.txt is written last, so a folder without it was cut off.

  --scene room|street|van  a room with boxes; a street with houses; the same with a van ahead (default: room)
  --motion NAME            %MOTIONS% (default: loop in the room, straight in the street)
  --seconds S              length (default: 20)
  --rate HZ                frames per second (default: 20)
  --size WxH               image size, px (default: 512x384)
  --focal PX               focal length (default: 0.78 of the width)
  --baseline M             distance of the cameras (default: 0.12 in the room, 0.4 in the street)
  --noise N                standard deviation of the image noise, grey levels (default: 1)
  --seed N                 of the noise, the scene, the motion "wander" and the faults (default: 1)
  --fault F                KIND:START_S:DURATION_S[:VALUE], repeatable; KIND black, freeze, swap, drop, overexpose,
                           blur, corrupt, noleft, noright, jump, equal, backward
)";

struct Request {
  std::string folder, scene = "room", motion;
  double seconds = 20.0, rate = 20.0, focal = 0.0, baseline = 0.0, noise = 1.0;
  int width = 512, height = 384;
  std::uint32_t seed = 1;
  std::vector<Fault> faults;
};

double number(const std::string& option, const std::string& text, double low, double high) {
  const std::optional<double> value = parseNumber(text);
  if (!value || *value < low || *value > high)
    throw UserError(option, text, printNumber(low) + "..." + printNumber(high));
  return *value;
}

void readSize(const std::string& text, Request& request) {
  const std::vector<std::string_view> sides = splitAt(text, 'x');
  if (sides.size() != 2) throw UserError("--size", text, "WIDTHxHEIGHT, such as 512x384");
  request.width = static_cast<int>(number("--size", std::string(sides[0]), 32, 8192));
  request.height = static_cast<int>(number("--size", std::string(sides[1]), 32, 8192));
}

void readOption(const std::string& option, const std::string& value, Request& request) {
  if (option == "--scene") {
    if (value != "room" && value != "street" && value != "van") throw UserError(option, value, "room, street, van");
    request.scene = value;
  } else if (option == "--motion") {
    request.motion = value;
  } else if (option == "--seconds") {
    request.seconds = number(option, value, 0.01, 1e5);
  } else if (option == "--rate") {
    request.rate = number(option, value, 0.1, 1000.0);
  } else if (option == "--size") {
    readSize(value, request);
  } else if (option == "--focal") {
    request.focal = number(option, value, 10.0, 1e5);
  } else if (option == "--baseline") {
    request.baseline = number(option, value, 0.001, 10.0);
  } else if (option == "--noise") {
    request.noise = number(option, value, 0.0, 100.0);
  } else if (option == "--seed") {
    request.seed = static_cast<std::uint32_t>(number(option, value, 0.0, 4294967295.0));
  } else if (option == "--fault") {
    request.faults.push_back(parseFault(value));
  } else {
    throw UserError(option, "unknown option", "those of --help");
  }
}

Request readArguments(const std::vector<std::string>& arguments) {
  Request request;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i].rfind("--", 0) != 0) {
      if (!request.folder.empty()) throw UserError("", arguments[i], "one DIR");
      request.folder = arguments[i];
      continue;
    }
    if (i + 1 == arguments.size()) throw UserError(arguments[i], "no value", "a value after it");
    readOption(arguments[i], arguments[i + 1], request);
    ++i;
  }
  if (request.folder.empty()) throw UserError("", "no folder named", "render_sequence DIR (see --help)");
  return request;
}

RenderedSequence makeSequence(const Request& request) {
  const bool in_room = request.scene == "room";
  SequenceOptions options;
  RenderCamera& camera = options.camera;
  camera.width = request.width;
  camera.height = request.height;
  camera.fx = camera.fy = request.focal > 0.0 ? request.focal : 0.78 * request.width;
  camera.cx = 0.5 * (request.width - 1);
  camera.cy = 0.5 * (request.height - 1);
  camera.baseline = request.baseline > 0.0 ? request.baseline : (in_room ? 0.12 : 0.4);
  options.rate = request.rate;
  options.noise = request.noise;
  options.seed = request.seed;
  options.first_stamp = 0;
  const std::string name = request.motion.empty() ? (in_room ? "loop" : "straight") : request.motion;
  const Motion motion = namedMotion(name, in_room ? "room" : "street", request.seed);
  if (in_room) return RenderedSequence(texturedRoom({}, request.seed), motion, options);
  StreetSize street;
  street.length = std::max(street.length, motion(request.seconds).t().x() + 150.0);
  if (request.scene == "van")
    return RenderedSequence(streetWithVan(street, kDriveSpeed, 14.0, request.seed), motion, options);
  return RenderedSequence(texturedStreet(street, request.seed), motion, options);
}

void render(const Request& request) {
  RenderedSequence sequence = makeSequence(request);
  const int frames = std::max(1, static_cast<int>(std::lround(request.seconds * request.rate)));
  const bool terminal = ::isatty(STDERR_FILENO) != 0;
  const int step = terminal ? 5 : std::max(1, (frames + 3) / 4);
  const auto report_progress = [&](int i) {
    if (i % step == 0)
      std::cerr << (terminal ? "\r" : "") << "frame " << i << " of " << frames << (terminal ? "" : "\n") << std::flush;
  };
  const int written =
      writeSequenceFolder(sequence, frames, FaultFilter(request.faults, request.seed), request.folder, report_progress);
  std::cerr << (terminal ? "\r" : "") << written << " frames in " << request.folder << (terminal ? "        " : "")
            << "\n";
}

void printHelp() {
  std::string help = kHelp, motions;
  for (const std::string& name : motionNames()) motions += (motions.empty() ? "" : ", ") + name;
  help.replace(help.find("%MOTIONS%"), 9, motions);
  std::cout << help;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  for (const std::string& argument : arguments) {
    if (argument == "--help" || argument == "-h") {
      printHelp();
      return 0;
    }
  }
  try {
    render(readArguments(arguments));
  } catch (const UserError& error) {
    std::cerr << "render_sequence: " << error.what() << "\n";
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "render_sequence: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
