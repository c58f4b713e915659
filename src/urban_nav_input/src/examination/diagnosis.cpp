// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/examination/diagnosis.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "examination/stamp_check.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/examination/input_info.hpp"
#include "urban_nav_input/examination/sampled_pairs.hpp"
#include "urban_nav_input/session/calibration_check.hpp"

namespace urban_nav_input {

using urban_nav_core::StampNs;

namespace {

constexpr std::int64_t kMatchedSamples = 24;  // pairs whose images are matched
constexpr double kIncomplete = 0.01;          // share of pairs: above it, a finding

/// Faults of single pairs, with equal ones counted together.
class FaultCounter {
 public:
  void add(const std::string& fault) {
    std::string key;  // without numbers
    for (const char letter : fault)
      if (letter < '0' || letter > '9') key += letter;
    Group& group = groups_[key];
    if (group.count++ == 0) group.example = fault;
  }
  std::vector<Finding> findings() const {
    std::vector<Finding> findings;
    for (const auto& [key, group] : groups_)
      findings.push_back(
          {FindingKind::Pairs,
           group.example + (group.count > 1 ? " (and " + std::to_string(group.count - 1) + " similar)" : ""),
           "these pairs are not used; record or copy the images again if there are many"});
    return findings;
  }

 private:
  struct Group {
    std::string example;
    std::int64_t count = 0;
  };
  std::map<std::string, Group> groups_;
};

std::vector<std::string> describe(const SourceInfo& info) {
  std::vector<std::string> contents = info.notes;
  if (!info.has_images) {
    contents.push_back(std::string("no images: the session consists of the ") +
                       (info.planar_role.empty() ? "sweeps of its 3D LiDARs" : "scans of its horizontal planar laser"));
    return contents;
  }
  const urban_nav_core::Pinhole& left = info.camera.left;
  contents.push_back("stereo: " + std::to_string(left.width) + "x" + std::to_string(left.height) +
                     " px, focal length " + urban_nav_core::formatNumber(left.fx, 4) + " px, baseline " +
                     urban_nav_core::formatNumber(info.camera.baseline, 3) + " m");
  if (!info.lasers.empty()) contents.push_back(std::to_string(info.lasers.size()) + " lasers");
  if (!info.panorama.empty()) contents.push_back(std::to_string(info.panorama.size()) + " cameras of a panorama");
  return contents;
}

/// Reads the pairs, and passes a sample of them with their neighbours to the checks of images.
class Reading {
 public:
  Reading(Source& source, Diagnosis& diagnosis)
      : source_(source), diagnosis_(diagnosis), images_(source.info(), kMatchedSamples, 1) {}

  void read(const std::function<void(std::int64_t, std::int64_t)>& progress) {
    while (std::optional<SourceItem> item = source_.next()) {
      sweeps_ += static_cast<std::int64_t>(item->sweeps.size());
      if (!source_.info().has_images) progress(sweeps_, source_.info().frames);
      if (!item->has_pair) continue;
      const auto& pair = item->assembled.pair;
      for (const std::string& fault : item->faults) faults_.add(fault);
      stamps_.push_back(pair.stamp);
      diagnosis_.complete += !pair.left.empty() && !pair.right.empty();
      ++diagnosis_.pairs;
      images_.add(item->assembled);
      progress(diagnosis_.pairs, source_.info().frames);
    }
  }

  /// Completes the diagnosis. `stereo_scale`: ratio of true to stereo length according to a finding on the calibration.
  void conclude(double stereo_scale) {
    const auto append = [this](const std::vector<Finding>& found) {
      diagnosis_.findings.insert(diagnosis_.findings.end(), found.begin(), found.end());
    };
    append(readerFindings(source_.closingFaults()));
    append(source_.sensorFindings());
    append(faults_.findings());
    if (!source_.info().has_images) {
      concludeSweeps();
      return;
    }
    if (2 * diagnosis_.complete > diagnosis_.pairs) append(checkStamps(stamps_));
    append(images_.findings());
    append(source_.sightFindings(images_.sight(), stereo_scale));
    if (stamps_.size() > 1) {
      const auto [first, last] = std::minmax_element(stamps_.begin(), stamps_.end());
      diagnosis_.duration_s = urban_nav_core::secondsBetween(*first, *last);
      if (diagnosis_.duration_s > 0.0)
        diagnosis_.rate_hz = static_cast<double>(stamps_.size() - 1) / diagnosis_.duration_s;
    }
    const auto incomplete = static_cast<double>(diagnosis_.pairs - diagnosis_.complete);
    if (diagnosis_.complete == 0)
      append({{FindingKind::Pairs, "no stereo pair is complete",
               "both images of a pair need stamps within 5 ms of each other (input.pairing_tolerance), and pixels that "
               "can be decoded",
               true}});
    else if (incomplete > kIncomplete * static_cast<double>(diagnosis_.pairs))
      append({{FindingKind::Pairs,
               std::to_string(diagnosis_.pairs - diagnosis_.complete) + " of " + std::to_string(diagnosis_.pairs) +
                   " stereo pairs lack an image",
               "check the cable and the rate of the camera that loses images"}});
  }

 private:
  void concludeSweeps() {
    if (sweeps_ == 0)
      diagnosis_.findings.push_back({FindingKind::PointsInvalid, "no sweep has valid points",
                                     "check the driver and whether the LiDAR is covered", true});
    diagnosis_.duration_s = urban_nav_core::secondsBetween(source_.info().first, source_.info().last);
  }

  Source& source_;
  Diagnosis& diagnosis_;
  std::int64_t sweeps_ = 0;
  std::vector<StampNs> stamps_;
  FaultCounter faults_;
  SampledPairs images_;
};

Finding toFinding(const urban_nav_core::Error& error) {
  const urban_nav_core::Error::Parts& parts = error.parts();
  return errorFinding(parts.where + (parts.where.empty() ? "" : ": ") + parts.found, parts.allowed);
}

}  // namespace

bool Diagnosis::isUsable() const {
  return std::none_of(findings.begin(), findings.end(), [](const Finding& finding) { return finding.unusable; });
}

std::vector<std::string> separateUnreadable(const std::vector<std::string>& inputs,
                                            std::vector<Diagnosis>& unreadable) {
  std::vector<std::string> readable;
  for (const std::string& input : inputs) {
    try {
      findSessions({input});
      readable.push_back(input);
    } catch (const urban_nav_core::DataError& error) {
      Diagnosis diagnosis;
      diagnosis.name = input;
      diagnosis.findings.push_back(toFinding(error));
      unreadable.push_back(diagnosis);
    }
  }
  return readable;
}

namespace {

/// Returns the source of a session. If the baseline of the calibration is negative, opens it with the opposite sign and
/// sets `fault` to the error.
std::unique_ptr<Source> openToExamine(const InputSession& session, SourceOptions& options,
                                      std::optional<Finding>& fault) {
  try {
    return openSource(session.paths, options, nullptr, session.part);
  } catch (const urban_nav_core::UserError& error) {
    if (error.parts().found.find("baseline") == std::string::npos) throw;
    fault = toFinding(error);
    options.baseline_scale = -options.baseline_scale;
    try {
      return openSource(session.paths, options, nullptr, session.part);
    } catch (const urban_nav_core::Error&) {
      throw error;
    }
  }
}

/// Returns the scale of the baseline in the options of a finding.
std::optional<double> statedBaselineScale(const Finding& finding) {
  const std::string name = "input.baseline_scale=";
  for (const std::string& option : finding.options)
    if (option.rfind(name, 0) == 0) return urban_nav_core::parseNumber(option.substr(name.size()));
  return std::nullopt;
}

/// Completes the finding of a negative baseline by the images: exchanged cameras, or a wrong sign.
Finding baselineFinding(Finding fault, const SourceOptions& options, std::vector<Finding>& found) {
  const auto exchanged = std::find_if(found.begin(), found.end(), [](const Finding& finding) {
    return finding.kind == FindingKind::Pairs && finding.text.find("are exchanged") != std::string::npos;
  });
  fault.kind = FindingKind::Calibration;
  if (exchanged == found.end()) {
    fault.text += "; the images are in order: P[3] of the right camera_info has the wrong sign";
    fault.options = {"--set", "input.baseline_scale=" + urban_nav_core::printNumber(options.baseline_scale)};
    fault.remedy = fault.options[0] + " " + fault.options[1] +
                   "; for later recordings, P[3] of the right camera_info "
                   "is -fx times the baseline in metres";
    return fault;
  }
  fault.text += ", and so are the images: the topics of the two cameras are exchanged";
  for (std::string& option : exchanged->options) {  // calibrations with their images
    if (option.rfind("left_info:=", 0) == 0) option.replace(0, 4, "right");
    else if (option.rfind("right_info:=", 0) == 0) option.replace(0, 5, "left");
  }
  fault.options = exchanged->options;
  fault.remedy = exchanged->remedy;
  found.erase(exchanged);
  return fault;
}

}  // namespace

Diagnosis examine(const InputSession& session, const SourceOptions& options,
                  const std::function<void(std::int64_t done, std::int64_t total)>& progress) {
  Diagnosis diagnosis;
  diagnosis.name = session.paths.front();
  SourceOptions used = options;
  used.with_depth = used.with_colour = true;
  std::optional<Finding> fault;
  try {
    const std::unique_ptr<Source> source = readAhead(openToExamine(session, used, fault), 8);
    diagnosis.name = source->info().name;
    diagnosis.kind = source->info().kind;
    diagnosis.contents = describe(source->info());
    diagnosis.inputs = source->info().inputs;
    std::vector<std::string> notes = source->info().notes;
    if (!session.note.empty()) notes.push_back(session.note);
    diagnosis.findings = readerFindings(notes);
    const bool has_images = source->info().has_images;
    if (has_images) {
      for (Finding& finding : checkCalibration(source->info().camera, used.baseline_scale))
        diagnosis.findings.push_back(std::move(finding));
    }
    for (const std::string& path : session.paths) {
      if (inputKind(path) != InputKind::Bag) continue;
      const std::vector<Finding> streams = checkStreams(lookInto(path).streams);
      diagnosis.findings.insert(diagnosis.findings.end(), streams.begin(), streams.end());
    }
    Reading reading(*source, diagnosis);
    reading.read(progress);
    double stereo_scale = 1.0;
    for (const Finding& finding : diagnosis.findings)
      if (const auto scale = statedBaselineScale(finding)) stereo_scale = *scale / used.baseline_scale;
    reading.conclude(stereo_scale);
    if (fault) diagnosis.findings.push_back(baselineFinding(*fault, used, diagnosis.findings));
  } catch (const urban_nav_core::Error& error) {
    diagnosis.findings.push_back(toFinding(error));
  }
  return diagnosis;
}

}  // namespace urban_nav_input
