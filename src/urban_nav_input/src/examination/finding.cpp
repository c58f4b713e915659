// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/examination/finding.hpp"

#include <array>

namespace urban_nav_input {

namespace {

/// A part of a sentence of a reader, with the kind of finding and its remedy.
struct KnownSentence {
  const char* part;
  FindingKind kind;
  const char* remedy;
  std::array<const char*, 2> options = {{nullptr, nullptr}};
};

constexpr const char* kWholeIsUsed =
    "no action needed, the intact part is used; for later recordings stop the recorder before the power is switched "
    "off";
constexpr const char* kCopyAgain = "copy the recording again if the original is intact; the readable part is used";

constexpr KnownSentence kKnownSentences[] = {
    {"no header has a stamp", FindingKind::Stamps,
     "let the camera's driver stamp its images; until then pairs are formed by times of receipt"},
    {"stamps step back", FindingKind::Stamps, "set the clock before recording, and slew it (chrony) while recording"},
    {"have the stamp of another", FindingKind::Stamps,
     "record the topic once; a driver that repeats images or stamps needs a restart or a repair"},
    {"came too late by their stamps", FindingKind::Stamps, "check the clock of the computer that stamps this topic"},
    {"no times.txt", FindingKind::Stamps, "--rate HZ sets the rate of the images"},
    {"no image of this camera", FindingKind::Pairs, "check the cable and the driver of this camera of the panorama"},
    {"no static tf", FindingKind::Tf,
     "--transform base_link,FRAME:X,Y,Z,QX,QY,QZ,QW sets it for this recording (m, quaternion); for later ones "
     "publish it: rosrun tf2_ros static_transform_publisher X Y Z QX QY QZ QW base_link FRAME"},
    {"contradict each other", FindingKind::Tf,
     "--transform PARENT,CHILD:X,Y,Z,QX,QY,QZ,QW with the correct one of the two; for later recordings stop the other "
     "publisher"},
    {"no unit quaternion", FindingKind::Tf,
     "no action needed if the rotation is right; for later recordings publish quaternions of length 1"},
    {"is no rigid motion", FindingKind::Tf, "--transform PARENT,CHILD:X,Y,Z,QX,QY,QZ,QW sets it"},
    {"has no camera_info", FindingKind::Calibration, "record its camera_info; --topic depth0_info:=NAME names another"},
    {"its images have", FindingKind::Calibration, "record the camera_info of these images"},
    {"supported: 16UC1", FindingKind::Depth, "record depth images in mm (16UC1) or in m (32FC1)"},
    {"is not used", FindingKind::Tf, "publish its transform from base_link on /tf_static"},
    {"images are rectified already, although", FindingKind::Calibration,
     "publish images without distortion with a camera_info whose D is zero, or record the raw images"},
    {"although their topic is named as rectified", FindingKind::Calibration,
     "name raw images image_raw, and rectified ones image_rect"},
    {"holds images of the same topics at the same time",
     FindingKind::Stamps,
     "no action needed if these are recordings of different drives or robots (--set input.sessions=apart "
     "confirms it); --set input.sessions=together if they are one recording; for later recordings keep the clock "
     "running",
     {{"--set", "input.sessions=apart"}}},
    {"is ignored", FindingKind::Calibration, "repair the file named in the message"},
    {"is cut off", FindingKind::Topics, kWholeIsUsed},
    {"was not closed by its recorder", FindingKind::Topics, kWholeIsUsed},
    {"chunk at byte", FindingKind::Topics, kCopyAgain},
    {"be read and are left out", FindingKind::Topics, kCopyAgain},
    {"damaged and", FindingKind::Topics, kCopyAgain},
    {"be decompressed and are left out", FindingKind::Topics, kCopyAgain},
    {"index is wrong", FindingKind::Topics, kCopyAgain},
    {"names missing files", FindingKind::Topics, "copy the whole folder from the robot"},
    {"-wal that cannot be read", FindingKind::Topics, "copy the file again after its recorder has ended"},
};

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

/// Returns a remedy with the word FRAME replaced by the quoted name of a sentence.
std::string nameFrame(std::string remedy, const std::string& sentence) {
  const std::size_t word = remedy.rfind("FRAME"), open = sentence.find('"');
  const std::size_t close = open == std::string::npos ? open : sentence.find('"', open + 1);
  if (word != std::string::npos && close != std::string::npos)
    remedy.replace(word, 5, sentence.substr(open + 1, close - open - 1));
  return remedy;
}

}  // namespace

const char* toString(FindingKind kind) {
  switch (kind) {
    case FindingKind::Stamps: return "stamps";
    case FindingKind::Pairs: return "pairs";
    case FindingKind::Rectification: return "rectification";
    case FindingKind::Depth: return "depth";
    case FindingKind::Calibration: return "calibration";
    case FindingKind::Tf: return "tf";
    case FindingKind::Rates: return "rates";
    case FindingKind::Imu: return "imu";
    case FindingKind::Lasers: return "lasers";
    case FindingKind::Gps: return "gps";
    case FindingKind::Wheels: return "wheels";
    case FindingKind::Topics: return "topics";
    case FindingKind::SweepTimes: return "sweep_times";
    case FindingKind::SweepOverlap: return "sweep_overlap";
    case FindingKind::SweepGap: return "sweep_gap";
    case FindingKind::RingOrder: return "ring_order";
    case FindingKind::ClockApart: return "clock_apart";
    case FindingKind::PointsInvalid: return "points_invalid";
    case FindingKind::PointsFew: return "points_few";
    case FindingKind::PointsNear: return "points_near";
  }
  return "";
}

std::vector<Finding> readerFindings(const std::vector<std::string>& sentences) {
  std::vector<Finding> findings;
  for (const std::string& sentence : sentences)
    for (const KnownSentence& known : kKnownSentences)
      if (contains(sentence, known.part)) {
        findings.push_back({known.kind, sentence, nameFrame(known.remedy, sentence)});
        if (known.options[0] != nullptr) findings.back().options.assign(known.options.begin(), known.options.end());
        break;
      }
  return findings;
}

Finding errorFinding(const std::string& error, const std::string& allowed) {
  Finding finding{FindingKind::Pairs, error, allowed, true};
  if (contains(error, "no valid points")) {
    finding.kind = FindingKind::PointsInvalid;
    if (finding.remedy.empty()) finding.remedy = "check the driver and whether the LiDAR is covered";
  }
  for (const char* word : {"camera_info", "calib", "baseline", "focal", "distortion", "sensor.yaml", "projection"})
    if (contains(error, word)) finding.kind = FindingKind::Calibration;
  if (contains(error, "points_time")) finding.kind = FindingKind::SweepTimes;
  if (contains(error, "--preset")) finding.kind = FindingKind::Topics;
  if (contains(error, "encoding") || contains(error, "bits")) finding.kind = FindingKind::Depth;
  if (contains(error, "rosbag reindex")) finding.remedy = "rosbag reindex, then doctor again";
  if (!finding.remedy.empty()) return finding;
  switch (finding.kind) {
    case FindingKind::Calibration:
      finding.remedy = "--calibration LEFT.yaml,RIGHT.yaml states the calibration of both cameras";
      break;
    case FindingKind::Depth: finding.remedy = "record mono8, mono16, bayer, rgb8 or bgr8 images"; break;
    default: finding.remedy = "--topic left:=NAME --topic right:=NAME names the images of the stereo pair"; break;
  }
  return finding;
}

}  // namespace urban_nav_input
