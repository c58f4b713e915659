// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_places.hpp"

#include <algorithm>
#include <utility>

#include "fabmap_node/store/place_rows.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {

using urban_nav_core::Health;
using urban_nav_store::Session;

namespace {

std::string readNamedModel(const Parameters& parameters) {
  return parameters.model == "default" ? std::string(defaultModelBytes()) : urban_nav_core::readBytes(parameters.model);
}

/// Numbers are published: append new ones.
enum class PlacesReason { None = 0, NoUsableImages = 1, CameraMissing = 2, NotStored = 3, NotRead = 4 };

// Time by stamps after which a session without odometry is named by its first observation: visual odometry publishes
// its first pose after a window.
constexpr urban_nav_core::StampNs kLongestWait = 10'000'000'000;
// Time after which one with odometry is named by its first pose: the first step, which announces the session, follows
// it by a window of frames.
constexpr urban_nav_core::StampNs kAnnouncedWait = 5'000'000'000;

}  // namespace

LivePlaces::LivePlaces(const Parameters& parameters, LiveSessionName name, const std::string& store,
                       urban_nav_live::StoreWriterLink::Options store_options)
    : parameters_(parameters),
      name_(std::move(name)),
      model_bytes_(readNamedModel(parameters)),
      model_(parseModel(model_bytes_, parameters.model)),
      describer_(model_, featureOptions(parameters), MatcherOptions().look_features),
      store_(store, model_bytes_, std::move(store_options)),
      namer_(name_.robot),
      history_(parameters) {
  reset();
}

LivePlaces::~LivePlaces() { endSession(); }

void LivePlaces::addOdometry(const urban_nav_core::StampedPose& pose) {
  odometry_.add(pose);
  if (!first_observed_ && odometry_.isAhead()) {  // the previous session had no observations
    if (odometry_.start()) nameSession(*odometry_.start() + kAnnouncedWait);  // its id is used
    beginNextSession();
    session_.reset();
  }
  nameSession(pose.stamp);
}

void LivePlaces::beginNextSession() {
  odometry_.beginNextSession();
  announced_ = std::exchange(next_announced_, nullptr);
}

void LivePlaces::follow(const urban_nav_core::OdometrySessionPtr& announced) {
  if (!announced || announced->id == sessionId(announced_) || announced->id == sessionId(next_announced_)) return;
  const bool jumps = odometry_.newest() && urban_nav_core::jumpsBack(announced->start, *odometry_.newest());
  if (odometry_.isAhead() || (announced_ && jumps)) {
    next_announced_ = announced;
    return;
  }
  if (announced_ || session_) {  // of another session, which ended without a backward jump
    endSession();
    beginMapSession();
    odometry_.restart();
  }
  announced_ = announced;
  nameSession(announced->start);
}

PlaceOutput LivePlaces::process(urban_nav_core::StampNs stamp, const std::vector<urban_nav_core::ImageView>& images) {
  if (time_.add(stamp)) {
    endSession();
    beginMapSession();
    beginNextSession();
  }
  if (!first_observed_) first_observed_ = stamp;
  nameSession(stamp);
  const PlaceDescription description = describer_.describe(images);
  const std::size_t places = map_->places();
  unreadable_.clear();
  PlaceOutput output = map_->process(stamp, description, odometry_.travelled(stamp));
  output.belief = history_.add(std::move(output.belief));
  if (map_->places() > places) {
    recorded_->add({stamp, description, odometry_.travelled(stamp)});
    if (store_.isWanted()) {
      urban_nav_store::StoredPlace row = toStoredPlace("", stamp, description, "");
      row.thumbnail = placeThumbnail(images);
      keep(std::move(row));
    }
  }
  ++counts_.observations;
  counts_.unused += description.status != ObservationStatus::Used ? 1 : 0;
  counts_.incomplete += description.missing > 0 ? 1 : 0;
  counts_.known += output.belief.knowledge == PlaceKnowledge::Known ? 1 : 0;
  counts_.closures += static_cast<std::int64_t>(output.closures.size());
  last_ = output.belief;
  if (session_ && session_->id == sessionId(announced_))
    for (urban_nav_core::TopologicalClosure& closure : output.closures)
      for (urban_nav_core::PoseRef* at : {&closure.a, &closure.b})
        if (at->session.empty()) at->session = session_->id;
  return output;
}

std::vector<PlaceBelief> LivePlaces::addVerdict(const urban_nav_core::MetricClosure& closure) {
  const auto verdict = placeVerdict(closure);
  urban_nav_core::PoseRef a = closure.a, b = closure.b;
  for (urban_nav_core::PoseRef* at : {&a, &b})
    if (at->session == sessionId(announced_) || (session_ && at->session == session_->id)) at->session.clear();
  if (!verdict || !b.session.empty() || !first_observed_) return {};
  const std::optional<double> travelled_a = travelled(a);
  if (!travelled_a) return {};
  ++counts_.verdicts;
  learn(closure, *verdict, a, b);
  std::vector<PlaceBelief> changed = history_.addVerdict({a, b, *travelled_a, odometry_.travelled(b.stamp), *verdict});
  if (!changed.empty() && changed.back().at.stamp == last_.at.stamp) last_ = changed.back();
  return changed;
}

void LivePlaces::keep(urban_nav_store::StoredPlace place) {
  if (session_) store_.put(*session_, std::move(place));
  else unnamed_.push_back(std::move(place));
}

void LivePlaces::nameSession(urban_nav_core::StampNs now) {
  if (session_) return;
  if (announced_) return beginSession(namer_.follow(*announced_, resumable_).session);
  const auto start = odometry_.start();
  if (start && (!name_.is_announced || now - *start >= kAnnouncedWait)) beginOwnSession(*start);
  else if (!start && first_observed_ && now - *first_observed_ >= kLongestWait) beginOwnSession(*first_observed_);
}

void LivePlaces::beginOwnSession(urban_nav_core::StampNs start) {
  beginSession(namer_.begin(name_.recording, start, resumable_).session);
}

void LivePlaces::beginSession(const Session& session) {
  session_ = session;
  std::vector<ArchivedSession> others;
  for (const ArchivedSession& each : earlier_)
    if (each.session.id != session_->id) others.push_back(each);
  if (others.size() < earlier_.size()) useMap(buildMap(others));  // being recorded again, and so are its places
  for (urban_nav_store::StoredPlace& place : std::exchange(unnamed_, {})) keep(std::move(place));
  for (const urban_nav_store::PlaceLink& link : links_)
    if (link.session.empty()) keep(link);
}

void LivePlaces::endSession() {
  if (!session_ && first_observed_)
    nameSession(std::max(*first_observed_, odometry_.start().value_or(*first_observed_)) + kLongestWait);
  if (session_ && first_observed_) {
    store_.end(*session_);
    map_->renameSession(session_->id);
    earlier_.push_back({*session_, recorded_});
    recorded_ = std::make_shared<RecordedPlaces>();
    for (urban_nav_store::PlaceLink& link : links_)
      for (std::string* session : {&link.session, &link.earlier})
        if (session->empty()) *session = session_->id;
  }
  session_.reset();
  first_observed_.reset();
  history_.clear();
}

void LivePlaces::syncStore() {
  store_.sync([this](urban_nav_store::Store& store) -> std::vector<Session> {
    if (store.sessions().all().empty()) return {};
    const Added added = addSessions(store.path());
    resumable_.insert(resumable_.end(), added.sessions.begin(), added.sessions.end());
    return added.sessions;
  });
}

void LivePlaces::commit() {
  if (!store_.isWanted()) return;
  syncStore();
  try {
    store_.flush();
  } catch (const urban_nav_core::UserError&) {
    return;  // reported in the store's state
  }
}

void LivePlaces::reset() {
  endSession();
  if (store_.isWanted())
    for (const Session& session : resumable_) namer_.reserve(session.id);  // already in the store
  else namer_.clear();
  earlier_.clear();
  links_.clear();
  recorded_ = std::make_shared<RecordedPlaces>();
  useMap(buildMap({}));
  resumable_.clear();
  odometry_ = SessionOdometry();
  announced_ = next_announced_ = nullptr;
  time_.reset();
  counts_ = Counts();
  last_ = PlaceBelief();
}

urban_nav_live::StageReport LivePlaces::report() const {
  urban_nav_live::StageReport report;
  const auto degrade = [&report](PlacesReason reason, const char* name, const std::string& sentence) {
    report.status.health = Health::Degraded;
    report.status.reason = static_cast<int>(reason);
    report.reason_name = name;
    report.status.sentence = sentence;
  };
  if (last_.observation != ObservationStatus::Used)
    degrade(PlacesReason::NoUsableImages, "NoUsableImages",
            std::string("images cannot be used: ") + toString(last_.observation));
  else if (counts_.incomplete > 0 && counts_.incomplete == counts_.observations)
    degrade(PlacesReason::CameraMissing, "CameraMissing", "a camera of the panorama sends no images");
  else if (const std::string fault = store_.state().fault; !fault.empty())
    degrade(PlacesReason::NotStored, "NotStored", "places are not stored: " + fault);
  else if (!unreadable_.empty()) degrade(PlacesReason::NotRead, "NotRead", "places cannot be compared: " + unreadable_);
  report.is_error = !store_.state().fault.empty();
  report.summary = report.status.health == Health::Ok
                       ? std::string(toString(last_.knowledge)) + ", " + std::to_string(map_->places()) + " places"
                       : report.status.sentence;
  report.add("session", session_ ? session_->id : "");
  report.add("observations", counts_.observations);
  report.add("not used", counts_.unused);
  report.add("with a camera missing", counts_.incomplete);
  report.add("places", map_->places());
  report.add("known", counts_.known);
  report.add("closures proposed", counts_.closures);
  report.add("verdicts on closures", counts_.verdicts);
  report.add("places forgotten", map_->forgotten());
  addStoreFigures(store_.state(), report);
  return report;
}

}  // namespace fabmap_node
