// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/retrieval/descriptor_voting.hpp"

#include <algorithm>

#include "stereo/described_keyframe.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace urban_nav_registration {

namespace {

constexpr Eigen::Index most_descriptors = 120;  // of a view: a quarter of a keyframe's, spread as they are
constexpr double common = 0.9;  // what as many views hold as well says nothing: the score begins at this quantile

Descriptors pickSome(const Descriptors& all) {
  const Eigen::Index count = std::min(most_descriptors, all.cols());
  Descriptors some(descriptor_size, count);
  for (Eigen::Index i = 0; i < count; ++i) some.col(i) = all.col(i * all.cols() / count);
  return some;
}

}  // namespace

class DescriptorVoting::Implementation {
 public:
  explicit Implementation(const urban_nav_core::StereoCamera& camera) : camera_(camera) {}

  bool add(const Keyframe& keyframe) {
    const View view(keyframe, camera_);
    const bool usable = view.isReadable() && !view.points.empty();
    views_.push_back(usable ? pickSome(view.descriptors) : Descriptors(descriptor_size, 0));
    return usable;
  }
  std::size_t size() const { return views_.size(); }

  std::vector<Found> find(const Keyframe& keyframe, std::size_t most) const {
    const View view(keyframe, camera_);
    if (!view.isReadable() || view.points.empty() || views_.empty()) return {};
    const Descriptors asked = pickSome(view.descriptors);
    // A row for each descriptor that is asked for: how well each view answers it.
    Eigen::MatrixXf answers(asked.cols(), static_cast<Eigen::Index>(views_.size()));
    urban_nav_core::forEach(views_.size(), 16, [&](std::size_t i) {
      const auto column = static_cast<Eigen::Index>(i);
      if (views_[i].cols() == 0) answers.col(column).setZero();
      else answers.col(column) = (asked.transpose() * views_[i]).rowwise().maxCoeff();
    });
    std::vector<float> row(views_.size());
    const auto place = static_cast<std::size_t>(common * static_cast<double>(views_.size() - 1));
    for (Eigen::Index i = 0; i < answers.rows(); ++i) {
      for (std::size_t view_number = 0; view_number < row.size(); ++view_number)
        row[view_number] = answers(i, static_cast<Eigen::Index>(view_number));
      std::nth_element(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(place), row.end());
      answers.row(i) = (answers.row(i).array() - row[place]).max(0.0F);
    }
    std::vector<Found> found(views_.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      found[i] = {i, static_cast<double>(answers.col(static_cast<Eigen::Index>(i)).sum())};
    std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.score > b.score; });
    if (found.size() > most) found.resize(most);
    return found;
  }

 private:
  urban_nav_core::StereoCamera camera_;
  std::vector<Descriptors> views_;
};

DescriptorVoting::DescriptorVoting(const urban_nav_core::StereoCamera& camera)
    : implementation_(std::make_unique<Implementation>(camera)) {}
DescriptorVoting::~DescriptorVoting() = default;
DescriptorVoting::DescriptorVoting(DescriptorVoting&&) noexcept = default;
DescriptorVoting& DescriptorVoting::operator=(DescriptorVoting&&) noexcept = default;

bool DescriptorVoting::add(const Keyframe& keyframe) { return implementation_->add(keyframe); }
std::size_t DescriptorVoting::size() const { return implementation_->size(); }
std::vector<DescriptorVoting::Found> DescriptorVoting::find(const Keyframe& keyframe, std::size_t most) const {
  return implementation_->find(keyframe, most);
}

}  // namespace urban_nav_registration
