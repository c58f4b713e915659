// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "report/plot.hpp"
#include "stages/places/places_run.hpp"
#include "urban_nav_store/table_store.hpp"

namespace urban_nav {

using fabmap_node::PlaceBelief;
using urban_nav_store::StoredPlace;

namespace {

constexpr std::size_t sure_pictures = 4, unsure_pictures = 4;
constexpr int picture_scale = 2;
constexpr int gap_px = 4;

using BeliefRefs = std::vector<const PlaceBelief*>;

/// The surest recognitions and the least sure of those proposed, each spread over the run.
BeliefRefs spreadBeliefs(BeliefRefs beliefs, std::size_t most) {
  if (beliefs.size() <= most) return beliefs;
  BeliefRefs some;
  for (std::size_t i = 0; i < most; ++i) some.push_back(beliefs[i * (beliefs.size() - 1) / (most - 1)]);
  return some;
}

cv::Mat decodeThumbnail(urban_nav_store::Store& store, const MapContext& context, const urban_nav_core::PoseRef& at) {
  const auto name = std::find(context.names.begin(), context.names.end(), at.session);
  if (name == context.names.end()) return {};
  StoredPlace key;
  key.session = context.ids()[static_cast<std::size_t>(name - context.names.begin())];
  key.stamp = at.stamp;
  const auto row = urban_nav_store::TableStore<StoredPlace>(store).get(key);
  if (!row || row->thumbnail.empty()) return {};
  return cv::imdecode(std::vector<unsigned char>(row->thumbnail.begin(), row->thumbnail.end()), cv::IMREAD_GRAYSCALE);
}

PagePicture sideBySide(const cv::Mat& place, const cv::Mat& query, const std::string& caption) {
  const cv::Size size(picture_scale * std::max(place.cols, query.cols),
                      picture_scale * (place.rows + query.rows) + gap_px);
  cv::Mat both(size, CV_8UC1, cv::Scalar(255)), scaled;
  int top = 0;
  for (const cv::Mat* image : {&place, &query}) {
    cv::resize(*image, scaled, {}, picture_scale, picture_scale, cv::INTER_CUBIC);
    scaled.copyTo(both({0, top, scaled.cols, scaled.rows}));
    top += scaled.rows + gap_px;
  }
  PagePicture picture;
  cv::imencode(".jpg", both, picture.jpeg, {cv::IMWRITE_JPEG_QUALITY, 80});
  picture.width = both.cols;
  picture.height = both.rows;
  picture.caption = caption;
  return picture;
}

}  // namespace

std::vector<PagePicture> placePictures(const PlacesRun& run, const MapContext& context) {
  BeliefRefs known, unsure;
  for (const auto& session : run.beliefs)
    for (const PlaceBelief& belief : session) {
      if (belief.is_stationary || belief.likeliest.empty()) continue;
      if (belief.knowledge == fabmap_node::PlaceKnowledge::Known) known.push_back(&belief);
      if (belief.knowledge == fabmap_node::PlaceKnowledge::Unsure) unsure.push_back(&belief);
    }
  std::vector<PagePicture> pictures;
  for (const BeliefRefs& some : {spreadBeliefs(known, sure_pictures), spreadBeliefs(unsure, unsure_pictures)})
    for (const PlaceBelief* belief : some) {
      const fabmap_node::LikelyPlace& place = belief->likeliest.front();
      const cv::Mat earlier = decodeThumbnail(*context.store, context, place.at),
                    query = decodeThumbnail(*context.store, context, belief->at);
      if (earlier.empty() || query.empty()) continue;
      pictures.push_back(
          sideBySide(earlier, query,
                     std::string(toString(belief->knowledge)) + ", probability " + forPerson(place.probability, 4) +
                         ", " + std::to_string(belief->agreeing) + " descriptors agree. Above: " + place.at.session +
                         ", " + urban_nav_core::printStamp(place.at.stamp) + " s; below: " + belief->at.session + ", " +
                         urban_nav_core::printStamp(belief->at.stamp) + " s."));
    }
  return pictures;
}

}  // namespace urban_nav
