// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/retrieval/keyframe_places.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "fabmap_node/model/likelihood.hpp"
#include "fabmap_node/model/place_model.hpp"
#include "fabmap_node/parameters.hpp"
#include "fabmap_node/places/place_index.hpp"
#include "fabmap_node/recognition/compact_look.hpp"
#include "fabmap_node/recognition/place_describer.hpp"
#include "fabmap_node/store/model_rows.hpp"
#include "fabmap_node/store/place_rows.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_registration/io/jpeg.hpp"
#include "urban_nav_registration/session/stored_keyframe.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_keyframe_place.hpp"
#include "urban_nav_store/tables/stored_model.hpp"

namespace fabmap_node {

using urban_nav_registration::Keyframe;
using urban_nav_registration::SearchedKeyframe;
using urban_nav_store::Store;
using urban_nav_store::StoredKeyframePlace;
using urban_nav_store::StoredModel;
using urban_nav_store::StoredPlace;
using urban_nav_store::TableStore;

namespace {

constexpr std::size_t kPartlyCompared = 30;  // likeliest keyframes by words, of which some descriptors are compared
constexpr std::size_t kFullyCompared = 8;    // of these, of which all descriptors are compared
constexpr std::size_t kPartialStep = 4;      // of the descriptors in the first comparison
constexpr std::size_t kRowsAtATime = 50;     // about 0.1 ms each

/// Model of the words of a map's places.
struct MapModel {
  std::string hash, bytes;
};

/// Returns the model of most sessions; the default one without any.
MapModel modelOfMap(Store& store, const std::vector<SearchedKeyframe>& keyframes) {
  std::vector<urban_nav_store::SessionId> sessions;
  for (const SearchedKeyframe& each : keyframes)
    if (sessions.empty() || sessions.back() != each.at.session) sessions.push_back(each.at.session);
  std::sort(sessions.begin(), sessions.end());
  sessions.erase(std::unique(sessions.begin(), sessions.end()), sessions.end());
  std::map<std::string, std::size_t> counts;
  std::map<std::string, std::string> bytes;
  for (const urban_nav_store::SessionId& session : sessions)
    TableStore<StoredModel>(store).forEach(session, [&](const StoredModel& row) {
      if (row.stage != "fabmap_node") return;
      ++counts[row.hash];
      bytes.emplace(row.hash, modelBytes(row, store.path()));
    });
  const auto most =
      std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most != counts.end()) return {most->first, bytes[most->first]};
  const std::string_view suite = defaultModelBytes();
  return {modelHash(suite), std::string(suite)};
}

}  // namespace

class KeyframePlaces::Search {
 public:
  Search(Store& store, std::vector<SearchedKeyframe> keyframes)
      : Search(store, keyframes, modelOfMap(store, keyframes)) {}

  std::size_t read() const { return read_; }
  std::size_t described() const { return described_; }

  bool readNext() {
    for (std::size_t i = 0; i < kRowsAtATime && read_ < keyframes_.size(); ++i)
      if (!addStored()) {
        addDescribed();
        break;
      }
    return read_ < keyframes_.size();
  }

  std::vector<std::size_t> find(const Keyframe& keyframe, std::size_t most) const {
    const PlaceDescription query = describe(keyframe);
    if (query.status != ObservationStatus::Used || places_.empty()) return {};
    std::vector<Candidate> candidates = likeliest(query.words);
    const ComparedFeatures look = unpackLook(query.look, "query");
    compare(look, kPartialStep, candidates);
    if (candidates.size() > kFullyCompared) candidates.resize(kFullyCompared);
    compare(look, 1, candidates);
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < std::min(most, candidates.size()); ++i)
      found.push_back(places_[candidates[i].place].keyframe);
    return found;
  }

 private:
  /// Place of the index.
  struct IndexedPlace {
    std::size_t keyframe = 0;
    std::string look;  ///< empty: in the store
  };
  struct Candidate {
    std::size_t place = 0;
    double log_likelihood = 0.0, share = 0.0;
    ComparedFeatures look;
  };

  Search(Store& store, std::vector<SearchedKeyframe> keyframes, const MapModel& model)
      : store_(store),
        keyframes_(std::move(keyframes)),
        model_hash_(model.hash),
        model_(parseModel(model.bytes, "model of places in " + store.path())),
        table_(model_.tree, model_.detector, Dependence::ChowLiu),
        describer_(model_, featureOptions(Parameters()), kKeyframeLookFeatures),
        index_(table_) {}

  /// Returns the stored row of a keyframe's image; nullopt if there is none of this model.
  std::optional<StoredPlace> storedRow(const SearchedKeyframe& keyframe) const {
    if (keyframe.conversion) return std::nullopt;
    StoredKeyframePlace key;
    key.session = keyframe.at.session;
    key.stamp = keyframe.at.stamp;
    if (auto row = TableStore<StoredKeyframePlace>(store_).get(key); row && row->model == model_hash_) return row;
    auto row = TableStore<StoredPlace>(store_).get(key);
    if (row && row->cameras == 1 && row->model == model_hash_) return row;
    return std::nullopt;
  }

  bool addStored() {
    const auto row = storedRow(keyframes_[read_]);
    if (row) add(toPlaceDescription(*row, model_.vocabulary.size()), false);
    return row.has_value();
  }

  void addDescribed() {
    const SearchedKeyframe& searched = keyframes_[read_];
    const auto stored =
        store_.keyframes().get(searched.at.session, urban_nav_registration::kKeyframeCamera, searched.at.stamp);
    Keyframe keyframe;
    if (stored) keyframe = urban_nav_registration::toKeyframe(*stored, searched.at.session);
    ++described_;
    add(describe(stored && searched.conversion ? searched.conversion->convert(keyframe) : keyframe), true);
  }

  void add(const PlaceDescription& description, bool keeps_descriptors) {
    const std::size_t keyframe = read_++;
    if (description.status != ObservationStatus::Used) return;
    index_.add(description.words);
    places_.push_back({keyframe, keeps_descriptors ? description.look : std::string()});
  }

  PlaceDescription describe(const Keyframe& keyframe) const {
    const cv::Mat pixels = urban_nav_registration::decodeJpeg(keyframe.image, {keyframe.width, keyframe.height});
    if (pixels.empty()) return describer_.describe({urban_nav_core::ImageView()});
    return describer_.describe({{pixels.data, pixels.cols, pixels.rows, static_cast<std::ptrdiff_t>(pixels.step)}});
  }

  /// Returns the likeliest places by words, most probable first, with their descriptors.
  std::vector<Candidate> likeliest(const WordSet& words) const {
    std::vector<double> likelihoods;
    index_.logLikelihoods(words, likelihoods);
    std::vector<std::size_t> order(likelihoods.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const std::size_t count = std::min(kPartlyCompared, order.size());
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                      [&](std::size_t a, std::size_t b) {
                        return likelihoods[a] != likelihoods[b] ? likelihoods[a] > likelihoods[b] : a < b;
                      });
    std::vector<Candidate> candidates(count);
    for (std::size_t i = 0; i < count; ++i) {
      candidates[i].place = order[i];
      candidates[i].log_likelihood = likelihoods[order[i]];
      candidates[i].look = look(places_[order[i]]);
    }
    return candidates;
  }

  ComparedFeatures look(const IndexedPlace& place) const {
    if (!place.look.empty()) return unpackLook(place.look, "keyframe of the map");
    const auto row = storedRow(keyframes_[place.keyframe]);
    return row ? unpackLook(row->descriptors, "keyframe of the map") : ComparedFeatures();
  }

  /// Compares every `step`-th descriptor, and sorts by agreement. Sky needs no special treatment here, since geometric
  /// verification follows.
  static void compare(const ComparedFeatures& query, std::size_t step, std::vector<Candidate>& candidates) {
    urban_nav_core::forEach(candidates.size(), 1, [&](std::size_t i) {
      Candidate& each = candidates[i];
      each.share = secondLook(query, step > 1 ? thinnedOut(each.look, step) : each.look).whole;
    });
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
      if (a.share != b.share) return a.share > b.share;
      return a.log_likelihood != b.log_likelihood ? a.log_likelihood > b.log_likelihood : a.place < b.place;
    });
  }

  Store& store_;
  const std::vector<SearchedKeyframe> keyframes_;
  const std::string model_hash_;
  const PlaceModel model_;
  const LikelihoodTable table_;
  const PlaceDescriber describer_;
  PlaceIndex index_;
  std::vector<IndexedPlace> places_;
  std::size_t read_ = 0, described_ = 0;
};

KeyframePlaces::KeyframePlaces() = default;
KeyframePlaces::~KeyframePlaces() = default;

void KeyframePlaces::open(Store& store, std::vector<SearchedKeyframe> keyframes) {
  search_ = std::make_unique<Search>(store, std::move(keyframes));
}
std::size_t KeyframePlaces::read() const { return search_ ? search_->read() : 0; }
std::size_t KeyframePlaces::described() const { return search_ ? search_->described() : 0; }
bool KeyframePlaces::readNext() { return search_ && search_->readNext(); }
std::vector<std::size_t> KeyframePlaces::find(const Keyframe& keyframe, std::size_t most) const {
  return search_ ? search_->find(keyframe, most) : std::vector<std::size_t>();
}

}  // namespace fabmap_node
