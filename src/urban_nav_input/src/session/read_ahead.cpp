// SPDX-License-Identifier: BSD-3-Clause
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "urban_nav_core/parallel/named_thread.hpp"
#include "urban_nav_input/session/source.hpp"

namespace urban_nav_input {

namespace {

class ReadAhead : public Source {
 public:
  ReadAhead(std::unique_ptr<Source> source, int depth)
      : source_(std::move(source)),
        info_(source_->info()),
        depth_(static_cast<std::size_t>(depth)),
        thread_(urban_nav_core::namedThread("read_ahead", [this] { run(); })) {}

  ~ReadAhead() override {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      stop_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

  const SourceInfo& info() const override { return info_; }

  std::optional<SourceItem> next() override {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return ended_ || !queue_.empty(); });
    if (queue_.empty()) {
      if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
      return std::nullopt;
    }
    SourceItem input = std::move(queue_.front());
    queue_.pop_front();
    lock.unlock();
    changed_.notify_all();
    return input;
  }

  std::vector<std::string> closingFaults() const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return ended_ ? source_->closingFaults() : std::vector<std::string>();
  }

  std::vector<Finding> sensorFindings() const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return ended_ ? source_->sensorFindings() : std::vector<Finding>();
  }

  std::vector<Finding> sightFindings(const Sight& sight, double stereo_scale) const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return ended_ ? source_->sightFindings(sight, stereo_scale) : std::vector<Finding>();
  }

  std::shared_ptr<const BagEnd> bagEnd() const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return ended_ ? source_->bagEnd() : nullptr;
  }

  std::vector<LaserInput> scans() const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return ended_ ? source_->scans() : std::vector<LaserInput>();
  }

  std::vector<DepthInput> depths() const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return ended_ ? source_->depths() : std::vector<DepthInput>();
  }

  std::vector<ColourInput> colours() const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return ended_ ? source_->colours() : std::vector<ColourInput>();
  }

  std::vector<SweepInput> sweeps() const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return ended_ ? source_->sweeps() : std::vector<SweepInput>();
  }

  std::vector<urban_nav_ros::Panorama> panoramas() const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return ended_ ? source_->panoramas() : std::vector<urban_nav_ros::Panorama>();
  }

  std::vector<urban_nav_core::SpecificForce> forces() const override {
    const std::lock_guard<std::mutex> lock(mutex_);
    return ended_ ? source_->forces() : std::vector<urban_nav_core::SpecificForce>();
  }

 private:
  void run() {
    try {
      while (std::optional<SourceItem> input = source_->next()) {
        std::unique_lock<std::mutex> lock(mutex_);
        changed_.wait(lock, [this] { return stop_ || queue_.size() < depth_; });
        if (stop_) return;
        queue_.push_back(std::move(*input));
        lock.unlock();
        changed_.notify_all();
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex_);
      error_ = std::current_exception();
    }
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ended_ = true;
    }
    changed_.notify_all();
  }

  const std::unique_ptr<Source> source_;  // used only by thread_ from its start to ended_
  const SourceInfo info_;
  const std::size_t depth_;
  mutable std::mutex mutex_;  // guards the following four members
  std::deque<SourceItem> queue_;
  std::exception_ptr error_;
  bool ended_ = false;
  bool stop_ = false;
  std::condition_variable changed_;
  std::thread thread_;  // last member: starts after the others are initialised
};

}  // namespace

std::unique_ptr<Source> readAhead(std::unique_ptr<Source> source, int depth) {
  return std::make_unique<ReadAhead>(std::move(source), depth);
}

}  // namespace urban_nav_input
