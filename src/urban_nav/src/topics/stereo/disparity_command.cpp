// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <filesystem>

#include "base/console.hpp"
#include "base/json.hpp"
#include "base/parameters.hpp"
#include "base/plot.hpp"
#include "dense_stereo/dense_stereo.hpp"
#include "dense_stereo_paper/paper_matcher.hpp"
#include "topics/stereo/disparity_files.hpp"
#include "topics/stereo/stereo.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/folder/image_file.hpp"
#include "urban_nav_input/session/calibration_file.hpp"
#include "urban_nav_ros/stereo_calibration.hpp"

namespace urban_nav {

using dense_stereo::StereoResult;
using urban_nav_core::DataError;
using urban_nav_core::Health;
using urban_nav_core::ImageView;
using urban_nav_core::UserError;

namespace {

using DisparityClock = std::chrono::steady_clock;

cv::Mat readImage(const std::string& path, const urban_nav_ros::GreyScale& scale) {
  if (!std::filesystem::exists(path)) throw UserError(path, "does not exist", "an image file");
  urban_nav_ros::GreyImage image = urban_nav_input::readGrey(path, scale);
  if (!image.fault.empty()) throw DataError(image.fault, "", "");
  return image.pixels;
}

/// The images and, where the calibration rectifies, their rectified copies.
struct RectifiedImages {
  cv::Mat raw_left, raw_right;
  std::vector<std::uint8_t> left_pixels, right_pixels;
  urban_nav_core::StereoPair pair;
  urban_nav_core::StereoCamera camera;
};

void readPair(const Arguments& arguments, RectifiedImages& images) {
  const std::string left = arguments.get("LEFT"), right = arguments.get("RIGHT"), files = arguments.get("calibration");
  const urban_nav_ros::GreyScale scale = urban_nav_input::sampleGreyScale({left, right});
  images.raw_left = readImage(left, scale);
  images.raw_right = readImage(right, scale);
  const cv::Size size = images.raw_left.size(), other = images.raw_right.size();
  if (size != other)
    throw UserError(right, std::to_string(other.width) + "x" + std::to_string(other.height) + " px",
                    std::to_string(size.width) + "x" + std::to_string(size.height) + ", the size of " + left);
  const auto [left_info, right_info] = urban_nav_input::readCalibration(files, size.width, size.height);
  const urban_nav_ros::StereoCalibration calibration(left_info, right_info, arguments.has("rectified"), files);
  images.camera = calibration.camera();
  images.pair.left =
      calibration.rectify(urban_nav_ros::Side::Left, urban_nav_ros::toView(images.raw_left), images.left_pixels);
  images.pair.right =
      calibration.rectify(urban_nav_ros::Side::Right, urban_nav_ros::toView(images.raw_right), images.right_pixels);
  if (images.pair.left.empty() || images.pair.right.empty())
    throw UserError(files, "a calibration for images of another size",
                    std::to_string(size.width) + "x" + std::to_string(size.height) + " px");
}

Json toJson(const StereoResult& result, double ms) {
  Json json = Json::object();
  json["answered"] = result.answered;
  json["status"] = toString(result.status.health);
  json["reason"] = toString(static_cast<dense_stereo::Reason>(result.status.reason));
  json["sentence"] = result.status.sentence;
  json["exposure"] = result.exposure;
  json["row_offset_px"] = result.row_offset;
  json["ms"] = ms;
  return json;
}

int runDisparity(const Arguments& arguments, Console& console) {
  ParameterSet parameters = loadParameters(arguments);
  for (const std::string& warning : parameterWarnings(parameters)) console.warn(warning);
  const urban_nav_core::ThreadLimit threads(static_cast<int>(arguments.integer("threads", 0, 1, 1024)));
  if (arguments.has("method")) parameters.set("dense_stereo.method=" + arguments.get("method"));
  const std::string output = arguments.get("output");
  checkDisparityName(output, "--output");
  RectifiedImages images;
  readPair(arguments, images);
  const dense_stereo::Parameters& own = parameters.get(dense_stereo::table());
  dense_stereo::DenseStereo stereo(own, dense_stereo::makePaperMatcher(own));
  const auto begin = DisparityClock::now();
  const StereoResult& result = stereo.process(images.pair);
  const double ms = std::chrono::duration<double, std::milli>(DisparityClock::now() - begin).count();
  if (arguments.has("json")) urban_nav_core::writeAtomically(arguments.get("json"), toJson(result, ms).print());
  if (result.status.health == Health::Lost) throw DataError(arguments.get("LEFT"), result.status.sentence, "");
  if (!result.status.sentence.empty()) console.warn(result.status.sentence);
  writeDisparity(output, result.image, images.pair.left, images.camera);
  if (arguments.has("variance")) writeVariance(arguments.get("variance"), result.image);
  console.print(urban_nav_core::formatNumber(100.0 * result.answered, 3) + " % of the pixels matched, " +
                urban_nav_core::formatNumber(ms, 3) + " ms\n");
  return 0;
}

std::string disparityHelp(const Arguments& arguments) { return stageHelp(arguments, dense_stereo::table().stage()); }

}  // namespace

Command disparityCommand() {
  Command command;
  command.name = "disparity";
  command.summary = "Matches one stereo pair densely: disparities, their variances, a point cloud.";
  command.options = {
      {"LEFT", "", "left image", true, false, {}},
      {"RIGHT", "", "right image, of the same size", true, false, {}},
      {"--calibration",
       "FILE",
       "KITTI's calib.txt (images are rectified), or LEFT.yaml,RIGHT.yaml (camera_info; images are rectified by them)",
       true,
       false,
       {}},
      {"-o,--output",
       "OUT",
       "file to write: .pfm (px, NaN where invalid), .png (colours) or .ply (points in the left optical frame, m)",
       true,
       false,
       {}},
      {"--variance", "FILE.pfm", "the variance of each disparity, px^2, NaN where invalid", false, false, {}},
      {"--method", "NAME", "overrides dense_stereo.method", false, false, {"sgm", "paper"}},
      {"--rectified",
       "",
       "the images are rectified already, whatever distortion the camera_info states",
       false,
       false,
       {}},
      jsonOption(),
      configOption(),
      setOption(),
      threadsOption()};
  command.examples = {
      "urban_nav disparity left.png right.png --calibration calib.txt -o disparity.pfm --variance variance.pfm",
      "urban_nav disparity left.png right.png --calibration left.yaml,right.yaml -o points.ply"};
  command.more_help = disparityHelp;
  command.run = runDisparity;
  return command;
}

}  // namespace urban_nav
