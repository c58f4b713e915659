// SPDX-License-Identifier: BSD-3-Clause
#include "map/session_reader.hpp"

#include <algorithm>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/examination/sampled_pairs.hpp"
#include "urban_nav_input/session/calibration_check.hpp"

namespace urban_nav {

namespace {

constexpr int kMaxReadAhead = 16;        // pairs; decoding times are even, more would only cost memory
constexpr double kReadAheadShare = 0.1;  // of memory_mb
constexpr std::int64_t kJudgedPairs = 12, kLeastJudgedStep = 10;

}  // namespace

int readAheadDepth(const CommandParameters& parameters, const urban_nav_core::Pinhole& camera) {
  const double pair_mb = std::max(0.1, 2e-6 * camera.width * camera.height);
  return std::clamp(static_cast<int>(kReadAheadShare * parameters.memory_mb / pair_mb), 2, kMaxReadAhead);
}

SessionReader::SessionReader(MapContext& context, const StageList& stages, RunCheckpoint& checkpoint,
                             std::size_t session)
    : context_(context), stages_(stages), checkpoint_(checkpoint), session_(session) {}

std::unique_ptr<urban_nav_input::Source> SessionReader::openSource(const urban_nav_input::BagEnd* after) {
  const MapOptions& options = context_.options;
  urban_nav_input::SourceOptions source_options = options.source;
  for (const Stage* stage : stages_) {
    source_options.with_sweeps = source_options.with_sweeps || stage->describe().uses_sweeps;
    source_options.with_depth = source_options.with_depth || stage->describe().uses_depth;
    source_options.with_colour = source_options.with_colour || stage->describe().uses_colour;
  }
  source_options.with_planar_sweeps = options.odometry == OdometryOption::Laser;
  const urban_nav_input::InputSession& input = context_.sessions[session_].input;
  std::unique_ptr<urban_nav_input::Source> source =
      urban_nav_input::openSource(input.paths, source_options, after, input.part);
  context_.sessions[session_].info = source->info();
  if (!input.note.empty()) context_.sessions[session_].info.notes.push_back(input.note);
  if (options.threads == 1) return source;
  const int depth = readAheadDepth(options.parameters.get(commandTable()), source->info().camera.left);
  return urban_nav_input::readAhead(std::move(source), depth);
}

std::vector<std::string> SessionReader::calibrationFaults() const {
  std::vector<std::string> sentences;
  if (!source_->info().has_images) return sentences;
  for (const urban_nav_input::Finding& fault :
       urban_nav_input::checkCalibration(source_->info().camera, context_.options.source.baseline_scale))
    sentences.push_back(source_->info().name + ": " + fault.text + " (" + fault.remedy + ")");
  return sentences;
}

void SessionReader::openPasses(const BagCheckpoint* checkpoint) {
  for (Stage* stage : stages_) {
    const std::string key = stage->describe().key;
    Stage::SessionStart start{session_, std::nullopt};
    if (checkpoint != nullptr) start.checkpoint = checkpoint->state(key);
    if (auto pass = stage->beginSession(context_, start)) passes_.emplace_back(key, std::move(pass));
  }
}

void SessionReader::openResumed() {
  const std::optional<RunCheckpoint::ResumePoint>& point = checkpoint_.resumePoint(session_);
  if (!point) return;
  const urban_nav_input::BagEnd after{point->bags, point->checkpoint.receipt, point->checkpoint.reader, {}, {}, {}, {},
                                      {}};
  try {
    source_ = openSource(&after);
    openPasses(&point->checkpoint);
  } catch (const urban_nav_core::Error& error) {
    context_.console.warn(std::string("cannot continue after the complete bags: ") + error.what() +
                          ": starting from the beginning");
    source_.reset();
    passes_.clear();
    context_.sessions[session_].odometry = std::make_shared<SessionOdometry>();
    checkpoint_.startNewSession(session_);
  }
}

void SessionReader::open() {
  if (source_) {
    checkpoint_.resume(session_);
    flush();
    checkpoint_.commit();
    return;
  }
  source_ = openSource();
  for (const std::string& fault : calibrationFaults()) context_.console.warn(fault);
  finished_ = restoreFinished();
  if (finished_) return;
  checkpoint_.begin(session_);
  openPasses(nullptr);
}

bool SessionReader::restoreFinished() {
  const std::vector<BagCheckpoint::StageState> states = checkpoint_.finishedStates(session_);
  for (const auto& [key, state] : states)
    for (Stage* stage : stages_)
      if (stage->describe().key == key && !stage->restoreSession(context_, session_, state)) {
        context_.sessions[session_].odometry = std::make_shared<SessionOdometry>();
        return false;
      }
  return !states.empty();
}

void SessionReader::flush() {
  for (const auto& [key, pass] : passes_) pass->flush();
}

template <typename Input>
void SessionReader::processAll(const std::vector<Input>& inputs) {
  for (const Input& input : inputs)
    for (const auto& [key, pass] : passes_) pass->process(input);
}

void SessionReader::saveBagEnd(const urban_nav_input::BagEnd& end) {
  processAll(end.depths);
  processAll(end.colours);
  processAll(end.panoramas);
  processAll(end.sweeps);
  flush();
  std::vector<BagCheckpoint::StageState> states;
  for (const auto& [key, pass] : passes_) states.emplace_back(key, pass->checkpoint());
  checkpoint_.writeScans(end.scans);
  checkpoint_.saveBagEnd(std::move(states), end);
}

void SessionReader::read(const ProgressCallback& progress) {
  if (finished_) return;
  const std::int64_t frames = source_->info().frames;
  const bool has_images = source_->info().has_images;
  Progress bar(context_.console, has_images ? "vo" : "lo", has_images ? "frames" : "sweeps", frames);
  auto read = static_cast<std::int64_t>(context_.sessions[session_].odometry->frames.size());  // or sweeps
  urban_nav_input::SampledPairs images(source_->info(), kJudgedPairs, kLeastJudgedStep);
  while (std::optional<urban_nav_input::SourceItem> input = source_->next()) {
    if (input->bag_end) saveBagEnd(*input->bag_end);
    checkpoint_.writeScans(input->scans);
    processAll(input->depths);
    processAll(input->colours);
    processAll(input->panoramas);
    processAll(input->sweeps);
    if (input->has_pair) {
      images.add(input->assembled);
      PassItem item{*input};
      for (const auto& [key, pass] : passes_) pass->process(item);
    }
    read += has_images ? static_cast<std::int64_t>(input->has_pair) : static_cast<std::int64_t>(input->sweeps.size());
    bar.update(read);
    if (checkpoint_.isCommitDue()) {
      flush();
      checkpoint_.commit();
    }
    progress(frames > 0 ? static_cast<double>(read) / static_cast<double>(frames) : 0.0);
  }
  if (const auto end = source_->bagEnd()) saveBagEnd(*end);
  checkpoint_.writeScans(source_->scans());
  processAll(source_->depths());
  processAll(source_->colours());
  processAll(source_->panoramas());
  processAll(source_->sweeps());
  std::vector<std::string> faults = source_->closingFaults();
  for (std::string& fault : calibrationFaults()) faults.push_back(std::move(fault));
  std::vector<urban_nav_input::Finding> findings = source_->sensorFindings();
  for (const urban_nav_input::Finding& finding : images.findings()) findings.push_back(finding);
  for (const urban_nav_input::Finding& finding : source_->sightFindings(images.sight(), 1.0))
    findings.push_back(finding);
  for (const urban_nav_input::Finding& finding : findings)
    faults.push_back(source_->info().name + ": " + finding.text + " (" + finding.remedy + ")");
  if (const std::string& note = context_.sessions[session_].input.note; !note.empty())
    faults.push_back(source_->info().name + ": " + note);
  const PassEnd end{faults, source_->forces()};
  std::vector<BagCheckpoint::StageState> states;
  for (const auto& [key, pass] : passes_) {
    pass->finish(end);
    states.emplace_back(key, pass->finished());
  }
  checkpoint_.finishSession(states);
  bar.finish(read);
  passes_.clear();
}

}  // namespace urban_nav
