// SPDX-License-Identifier: BSD-3-Clause
// Processor time of place recognition on one core: describing a panorama, likelihoods of all places by the inverted
// index, the second look, a whole match, places of a store, and keyframes of a stored map for localization. Places are
// drawn at random with word frequencies as in text (Zipf).
//
//   fabmap_node-bench-speed [-o FILE.json]
#include <malloc.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <string>
#include <vector>

#include "fabmap_node/model/place_model.hpp"
#include "fabmap_node/recognition/compact_look.hpp"
#include "fabmap_node/recognition/place_describer.hpp"
#include "fabmap_node/recognition/place_matcher.hpp"
#include "fabmap_node/retrieval/keyframe_places.hpp"
#include "fabmap_node/store/place_rows.hpp"
#include "fabmap_node/store/place_sessions.hpp"
#include "live/live_places.hpp"
#include "reference/features/opencv_features.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/testing/processor_time.hpp"
#include "urban_nav_registration/io/jpeg.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_keyframe_place.hpp"
#include "urban_nav_store/tables/stored_model.hpp"

namespace {

using namespace fabmap_node;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::threadMs;

/// Returns the median of the processor times of `runs` calls, ms, after a warm-up call.
template <typename Call>
double medianMs(int runs, const Call& call) {
  std::vector<double> times;
  for (int i = 0; i <= runs; ++i) {
    const double begin = threadMs();
    call();
    if (i > 0) times.push_back(threadMs() - begin);
  }
  std::nth_element(times.begin(), times.begin() + runs / 2, times.end());
  return times[static_cast<std::size_t>(runs) / 2];
}

/// Draws observations whose words have frequencies proportional to 1 / (rank + 10).
class WordDraws {
 public:
  explicit WordDraws(std::size_t words) : random_(1) {
    std::vector<double> weights;
    for (std::size_t q = 0; q < words; ++q) weights.push_back(1.0 / static_cast<double>(q + 10));
    draw_ = std::discrete_distribution<Word>(weights.begin(), weights.end());
  }
  WordSet draw(std::size_t different) {
    WordSet set;
    while (set.size() < different) {
      for (std::size_t k = set.size(); k < different; ++k) set.push_back(draw_(random_));
      std::sort(set.begin(), set.end());
      set.erase(std::unique(set.begin(), set.end()), set.end());
    }
    return set;
  }

 private:
  std::mt19937 random_;
  std::discrete_distribution<Word> draw_;
};

ChowLiuTree drawTree(std::size_t words) {
  ChowLiuTree tree;
  std::mt19937 random(2);
  for (Word q = 0; q < words; ++q) {
    tree.parent.push_back(q == 0 ? 0 : static_cast<Word>(random() % q));
    const double p = 0.01 + 0.3 / (1.0 + 0.01 * q);
    tree.p.push_back(p);
    tree.p_parent_present.push_back(q == 0 ? p : std::min(0.9, 2.0 * p));
    tree.p_parent_absent.push_back(q == 0 ? p : 0.8 * p);
  }
  return tree;
}

void addInference(std::size_t words, std::size_t seen, std::size_t places, BenchTable& table) {
  const ChowLiuTree tree = drawTree(words);
  const LikelihoodTable likelihoods(tree, {0.39, 0.05}, Dependence::ChowLiu);
  PlaceIndex index(likelihoods);
  WordDraws draws(words);
  for (std::size_t i = 0; i < places; ++i) index.add(draws.draw(seen));
  const WordSet query = draws.draw(seen);
  std::vector<double> logs;
  table.add({"likelihoods of " + std::to_string(places) + " places",
             std::to_string(words) + " words, " + std::to_string(seen) + " seen",
             cell(medianMs(21, [&] { index.logLikelihoods(query, logs); }), 2)});
}

/// Images of a data set, each as large as one of the panoramic head.
std::vector<cv::Mat> readHeadImages(const std::string& folder) {
  std::vector<std::string> names;
  if (std::filesystem::is_directory(folder))
    for (const auto& entry : std::filesystem::directory_iterator(folder)) names.push_back(entry.path().string());
  std::sort(names.begin(), names.end());
  std::vector<cv::Mat> images;
  for (const std::string& name : names) {
    const cv::Mat image = cv::imread(name, cv::IMREAD_GRAYSCALE);
    if (image.empty()) continue;
    images.emplace_back();
    cv::resize(image, images.back(), {384, 512}, 0.0, 0.0, cv::INTER_AREA);
  }
  return images;
}

std::vector<urban_nav_core::ImageView> panorama(const std::vector<cv::Mat>& images, std::size_t first) {
  std::vector<urban_nav_core::ImageView> views;
  for (std::size_t k = 0; k < 5; ++k) {
    const cv::Mat& image = images[(first + k) % images.size()];
    views.push_back({image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step[0])});
  }
  return views;
}

urban_nav_core::ImageView toView(const cv::Mat& image) {
  return {image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step[0])};
}

/// Memory in use on the heap, kB.
double heapKb() {
  const struct mallinfo2 heap = ::mallinfo2();
  return static_cast<double>(heap.uordblks + heap.hblkhd) / 1024.0;
}

/// Writes a map of `count` keyframes that show `images` cyclically, in the form of `map`, and returns them.
std::vector<urban_nav_registration::SearchedKeyframe> writeKeyframes(const std::string& path,
                                                                     const std::vector<cv::Mat>& images,
                                                                     std::size_t count) {
  const PlaceModel model = defaultModel();
  const std::string hash = modelHash(defaultModelBytes());
  const PlaceDescriber describer(model, {}, kKeyframeLookFeatures);
  std::vector<urban_nav_registration::SearchedKeyframe> keyframes;
  urban_nav_store::Store store(path, urban_nav_store::Access::Write);
  store.sessions().put(urban_nav_store::Session{"s", "day", "", "", 0, true});
  urban_nav_store::TableStore<urban_nav_store::StoredModel>(store).put(
      {"s", hash, "fabmap_node", std::string(defaultModelBytes())});
  urban_nav_store::TableStore<urban_nav_store::StoredKeyframePlace> rows(store);
  constexpr std::size_t kDescribed = 200;
  std::vector<PlaceDescription> descriptions;
  for (std::size_t k = 0; k < kDescribed; ++k)
    descriptions.push_back(describer.describe({toView(images[(k + 1) % images.size()])}));
  for (std::size_t i = 0; i < count; ++i) {
    const auto stamp = static_cast<urban_nav_core::StampNs>(i + 1);
    rows.put({toStoredPlace("s", stamp, descriptions[i % kDescribed], hash)});
    keyframes.push_back({{"s", stamp}, nullptr});
  }
  store.commit();
  return keyframes;
}

/// Returns the memory per keyframe, kB.
double addKeyframes(const std::vector<cv::Mat>& images, BenchTable& table) {
  constexpr std::size_t kCount = 10000;
  std::string folder = (std::filesystem::temp_directory_path() / "places_speed_XXXXXX").string();
  if (::mkdtemp(folder.data()) == nullptr) return 0.0;
  const auto keyframes = writeKeyframes(folder + "/map.db", images, kCount);
  urban_nav_registration::Keyframe query;
  query.image = urban_nav_registration::encodeJpeg(toView(images[0]), 90);
  query.width = images[0].cols;
  query.height = images[0].rows;
  double memory = 0.0;
  {
    urban_nav_store::Store store(folder + "/map.db", urban_nav_store::Access::Read);
    KeyframePlaces places;
    const double before = heapKb(), begin = threadMs();
    places.open(store, keyframes);
    while (places.readNext()) {
    }
    table.add({"keyframes of a map ready for localization", std::to_string(kCount), cell(threadMs() - begin, 0)});
    memory = (heapKb() - before) / static_cast<double>(kCount);
    table.add({"search for a keyframe among them", std::to_string(kCount) + ", image decoded and described",
               cell(medianMs(15, [&] { places.find(query, 3); }), 1)});
  }
  std::filesystem::remove_all(folder);
  return memory;
}

/// Writes a store with one session whose places are `descriptions`, repeated cyclically.
void writeStoredPlaces(const std::string& path, const std::vector<PlaceDescription>& descriptions, std::size_t count) {
  urban_nav_store::Store store(path, urban_nav_store::Access::Write);
  const auto visitAll = [&](const PlaceVisitor& visit) {
    for (std::size_t i = 0; i < count; ++i)
      visit({static_cast<urban_nav_core::StampNs>(i + 1), descriptions[i % descriptions.size()]});
  };
  writePlaces(store, {"s", "day", "", "", 0, true}, visitAll, std::string(defaultModelBytes()));
  store.commit();
}

/// Start of the nodelet with a store: all places are read and indexed.
void addStoredPlaces(const std::vector<PlaceDescription>& descriptions, std::size_t count, BenchTable& table) {
  std::string folder = (std::filesystem::temp_directory_path() / "places_speed_XXXXXX").string();
  if (::mkdtemp(folder.data()) == nullptr) return;
  writeStoredPlaces(folder + "/places.db", descriptions, count);
  {
    LivePlaces places(Parameters(), {}, folder + "/places.db");
    const double before = heapKb(), begin = threadMs();
    places.syncStore();
    const double ms = threadMs() - begin;
    table.add({"places of a store read and indexed, live",
               std::to_string(count) + ", " + cell((heapKb() - before) / static_cast<double>(count), 2) +
                   " kB of memory each",
               cell(ms, 0)});
  }
  std::filesystem::remove_all(folder);
}

/// Maps of panoramas whose descriptors are read back one by one, as from a store, without the time of the disk.
void addLargeMaps(const PlaceModel& model, const std::vector<PlaceDescription>& descriptions, BenchTable& table) {
  const LikelihoodTable likelihoods(model.tree, model.detector, Dependence::ChowLiu);
  const auto shown = [&descriptions](std::size_t i) -> const PlaceDescription& {
    return descriptions[1 + i % (descriptions.size() - 1)];
  };
  const double before = heapKb();
  PlaceMatcher matcher(likelihoods, model.sampled_places, {}, [&](std::size_t, urban_nav_core::StampNs stamp) {
    return shown(static_cast<std::size_t>(stamp)).look;
  });
  const DescribedPlace query{1, 0, descriptions[0].words, descriptions[0].look};
  for (const std::size_t places : {std::size_t{10'000}, std::size_t{100'000}, std::size_t{1'000'000}}) {
    while (matcher.size() < places)
      matcher.add({0, static_cast<urban_nav_core::StampNs>(matcher.size()), shown(matcher.size()).words, {}});
    const double memory = (heapKb() - before) / static_cast<double>(places);
    table.add({"match of a panorama, descriptors in a store",
               std::to_string(places) + " places, " + cell(memory, 2) + " kB of memory each",
               cell(medianMs(5, [&] { matcher.match(query, [](std::size_t) { return true; }); }), 1)});
  }
}

void addImages(const std::vector<cv::Mat>& images, BenchTable& table) {
  const PlaceModel model = defaultModel();
  const MatcherOptions options;
  const FeatureExtractor extractor;
  const PlaceDescriber describer(model, {}, options.look_features);
  const auto views = panorama(images, 0);
  table.add({"features of a panorama", "five images of 384x512 px",
             cell(medianMs(15, [&] { extractor.extract(views); }), 1)});
  for (const OpenCvFeature feature : {OpenCvFeature::Sift, OpenCvFeature::Orb}) {
    const std::string name = kOpenCvFeatureNames[static_cast<std::size_t>(feature)];
    const double ms = medianMs(7, [&] {
      for (const auto& view : views) openCvObservation(feature, view, FeatureOptions().panorama);
    });
    table.add({"features of a panorama by OpenCV: " + name, "five images of 384x512 px", cell(ms, 1)});
  }
  table.add({"panorama to words and compact descriptors", std::to_string(model.vocabulary.size()) + " words",
             cell(medianMs(15, [&] { describer.describe(views); }), 1)});
  const LikelihoodTable likelihoods(model.tree, model.detector, Dependence::ChowLiu);
  PlaceMatcher matcher(likelihoods, model.sampled_places, options);
  constexpr std::size_t kDescribed = 40, kMapPlaces = 4000;
  std::vector<PlaceDescription> descriptions;
  for (std::size_t k = 0; k < kDescribed; ++k) descriptions.push_back(describer.describe(panorama(images, 5 * k)));
  for (std::size_t i = 0; i < kMapPlaces; ++i) {
    const PlaceDescription& one = descriptions[1 + i % (kDescribed - 1)];
    matcher.add({0, static_cast<urban_nav_core::StampNs>(i) * 1'000'000'000, one.words, one.look});
  }
  const ComparedFeatures a = unpackLook(descriptions[0].look, "a"), b = unpackLook(descriptions[1].look, "b");
  table.add({"second look at one place", std::to_string(a.size()) + " descriptors",
             cell(medianMs(21, [&] { secondLook(a, b); }), 2)});
  const DescribedPlace query{1, 0, descriptions[0].words, descriptions[0].look};
  table.add({"match of a panorama, all in one", std::to_string(kMapPlaces) + " places",
             cell(medianMs(15, [&] { matcher.match(query, [](std::size_t) { return true; }); }), 1)});
  for (const std::size_t places : {std::size_t{10'000}, std::size_t{100'000}})
    addStoredPlaces(descriptions, places, table);
  addLargeMaps(model, descriptions, table);
}

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  const urban_nav_core::ThreadLimit one_thread(1);
  BenchTable table({"step", "size", "processor time, ms"}, argc, argv);
  addInference(1604, 183, 4000, table);
  addInference(10000, 600, 100000, table);
  const char* data = std::getenv("URBAN_NAV_DATA");
  const auto images = readHeadImages(std::string(data == nullptr ? "" : data) + "/places/malaga_07/images");
  if (images.empty())
    std::fputs("URBAN_NAV_DATA names no folder with places/malaga_07: no images are described\n", stderr);
  if (!images.empty()) {
    addImages(images, table);
    const double memory = addKeyframes(images, table);
    table.note(
        "One core, medians. Images: five of a street sequence at a time, resized; 4 000 places repeat 39 panoramas, "
        "10 000 keyframes 200 images. Memory of these: " +
        cell(memory, 1) + " kB each, the model included.");
  }
  std::fputs(table.text().c_str(), stdout);
  if (argc == 3 && std::string(argv[1]) == "-o") table.write(argv[2]);
  return 0;
}
