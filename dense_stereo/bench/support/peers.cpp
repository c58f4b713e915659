// SPDX-License-Identifier: BSD-3-Clause
#include "peers.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "dense_stereo/dense_stereo.hpp"
#include "dense_stereo_paper/paper_matcher.hpp"

namespace dense_stereo::bench {

namespace fs = std::filesystem;

namespace {

class OwnMethod : public Peer {
 public:
  explicit OwnMethod(std::string method) : method_(std::move(method)) {}
  std::string name() const override { return method_; }
  const DisparityImage& match(const cv::Mat& left, const cv::Mat& right, int disparities) override {
    if (!stereo_ || disparities != disparities_) {
      Parameters parameters;
      parameters.method = method_;
      parameters.disparities = disparities_ = disparities;
      stereo_ = std::make_unique<DenseStereo>(parameters, makePaperMatcher(parameters));
    }
    const auto view = [](const cv::Mat& image) {
      return urban_nav_core::ImageView{image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)};
    };
    return stereo_->process({0, view(left), view(right)}).image;
  }

 private:
  std::string method_;
  int disparities_ = 0;
  std::unique_ptr<DenseStereo> stereo_;
};

class OpenCvMethod : public Peer {
 public:
  OpenCvMethod(std::string name, int mode) : name_(std::move(name)), mode_(mode) {}
  std::string name() const override { return name_; }
  const DisparityImage& match(const cv::Mat& left, const cv::Mat& right, int disparities) override {
    if (!matcher_ || disparities != disparities_) {
      disparities_ = disparities;
      if (mode_ < 0) matcher_ = cv::StereoBM::create(disparities, 11);
      else matcher_ = cv::StereoSGBM::create(0, disparities, 3, 72, 288, 1, 63, 10, 100, 2, mode_);
    }
    matcher_->compute(left, right, raw_);
    image_.width = left.cols;
    image_.height = left.rows;
    image_.disparity.resize(left.total());
    image_.variance.resize(left.total(), 0.0F);
    for (int v = 0; v < left.rows; ++v)
      for (int u = 0; u < left.cols; ++u) {
        const float d = static_cast<float>(raw_.at<std::int16_t>(v, u)) / 16.0F;
        image_.disparity[image_.index(u, v)] = d > 0.0F ? d : DisparityImage::kInvalid;
      }
    return image_;
  }

 private:
  std::string name_;
  int mode_, disparities_ = 0;
  cv::Ptr<cv::StereoMatcher> matcher_;
  cv::Mat raw_;
  DisparityImage image_;
};

std::vector<std::string> sortedFiles(const fs::path& folder, const std::string& ending) {
  std::vector<std::string> files;
  if (!fs::is_directory(folder)) return files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ending) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

/// fx times baseline, px m, of KITTI's calib.txt.
double focalBaseline(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  double product = 0.0;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    double p[12] = {};
    for (double& value : p) words >> value;
    if (key == "P1:") product = -p[3];
  }
  return product;
}

}  // namespace

std::vector<std::unique_ptr<Peer>> allPeers() {
  std::vector<std::unique_ptr<Peer>> peers;
  peers.push_back(std::make_unique<OwnMethod>("sgm"));
  peers.push_back(std::make_unique<OwnMethod>("paper"));
  peers.push_back(std::make_unique<OpenCvMethod>("StereoBM", -1));
  peers.push_back(std::make_unique<OpenCvMethod>("StereoSGBM 3WAY", cv::StereoSGBM::MODE_SGBM_3WAY));
  peers.push_back(std::make_unique<OpenCvMethod>("StereoSGBM", cv::StereoSGBM::MODE_SGBM));
  peers.push_back(std::make_unique<OpenCvMethod>("StereoSGBM HH4", cv::StereoSGBM::MODE_HH4));
  peers.push_back(std::make_unique<OpenCvMethod>("StereoSGBM HH", cv::StereoSGBM::MODE_HH));
  return peers;
}

std::vector<TruePair> middleburyPairs(const std::string& data) {
  std::vector<TruePair> pairs;
  for (const auto& [name, scale, disparities] :
       {std::tuple{"teddy", 4.0, 64}, std::tuple{"cones", 4.0, 64}, std::tuple{"wood2", 2.0, 128}}) {
    const std::string folder = data + "/dense/" + name;
    TruePair pair;
    pair.name = name;
    pair.disparities = disparities;
    pair.left = cv::imread(folder + "/im2.png", cv::IMREAD_GRAYSCALE);
    pair.right = cv::imread(folder + "/im6.png", cv::IMREAD_GRAYSCALE);
    const cv::Mat truth = cv::imread(folder + "/disp2.png", cv::IMREAD_UNCHANGED);
    const cv::Mat visible = cv::imread(folder + "/nonocc.png", cv::IMREAD_UNCHANGED);
    if (pair.left.empty() || truth.empty()) continue;
    truth.convertTo(pair.truth, CV_32F, 1.0 / scale);
    pair.step = static_cast<float>(1.0 / scale);
    pair.truth.setTo(-1.0F, visible == 0);
    pairs.push_back(pair);
  }
  return pairs;
}

std::vector<TruePair> simulatedPairs(const std::string& name, const std::string& folder, const std::string& truth,
                                     int step) {
  constexpr float kFarthest = 47.0F;  // m
  std::vector<TruePair> pairs;
  const auto left = sortedFiles(folder + "/image_0", ".png"), right = sortedFiles(folder + "/image_1", ".png");
  const auto depth = sortedFiles(truth + "/stereo_left_optical_frame", ".pfm");
  const auto right_depth = sortedFiles(truth + "/stereo_right_optical_frame", ".pfm");
  const auto scale = static_cast<float>(focalBaseline(folder + "/calib.txt"));
  const std::size_t count = std::min({left.size(), right.size(), depth.size(), right_depth.size()});
  for (std::size_t i = 0; i < count; i += static_cast<std::size_t>(step)) {
    TruePair pair;
    pair.name = name;
    pair.left = cv::imread(left[i], cv::IMREAD_GRAYSCALE);
    pair.right = cv::imread(right[i], cv::IMREAD_GRAYSCALE);
    const cv::Mat z = cv::imread(depth[i], cv::IMREAD_UNCHANGED),
                  z_right = cv::imread(right_depth[i], cv::IMREAD_UNCHANGED);
    pair.truth = cv::Mat(z.size(), CV_32F, cv::Scalar(-1.0));
    pair.sky = cv::Mat(z.size(), CV_8U, cv::Scalar(0));
    for (int v = 0; v < z.rows; ++v)
      for (int u = 0; u < z.cols; ++u) {
        const float near = z.at<float>(v, u);
        if (!std::isfinite(near)) pair.sky.at<std::uint8_t>(v, u) = 255;
        if (!std::isfinite(near) || near > kFarthest) continue;
        const float d = scale / near;
        const int column = static_cast<int>(std::lround(static_cast<float>(u) - d));
        for (int k = std::max(column - 1, 0); k <= std::min(column + 1, z.cols - 1); ++k)
          if (std::abs(scale / z_right.at<float>(v, k) - d) < 1.0F) pair.truth.at<float>(v, u) = d;
      }
    pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace dense_stereo::bench
