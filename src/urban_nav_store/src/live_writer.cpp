// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/live_writer.hpp"

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "urban_nav_core/parallel/named_thread.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_store {

using urban_nav_core::DataError;

class LiveWriter::Implementation {
 public:
  Implementation(Store store, const Options& options) : store_(std::move(store)), options_(options) {
    thread_ = urban_nav_core::namedThread("store_writer", [this] { run(); });
  }

  ~Implementation() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ending_ = true;
    }
    wake_.notify_all();
    thread_.join();
  }

  bool post(Write write) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (waiting_.size() + at_work_ >= options_.capacity) {
      ++counts_.dropped;
      return false;
    }
    waiting_.push_back(std::move(write));
    return true;
  }

  void flush() {
    std::unique_lock<std::mutex> lock(mutex_);
    const std::int64_t wanted = ++flushes_wanted_;
    wake_.notify_all();
    done_.wait(lock, [&] { return flushes_done_ >= wanted; });
  }

  Counts counts() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    Counts counts = counts_;
    counts.waiting = waiting_.size() + at_work_;
    return counts;
  }

 private:
  void run() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (true) {
      wake_.wait_for(lock, options_.period, [&] { return ending_ || flushes_wanted_ > flushes_done_; });
      const bool last = ending_;
      const std::int64_t flushes = flushes_wanted_;
      std::deque<Write> batch = std::exchange(waiting_, {});
      at_work_ = batch.size();
      lock.unlock();
      std::int64_t refused = 0;
      const std::string fault = batch.empty() ? "" : commit(batch, refused);
      lock.lock();
      at_work_ = 0;
      counts_.refused += refused;
      if (fault.empty() || !kept_) {
        counts_.committed += static_cast<std::int64_t>(batch.size());
      } else {
        waiting_.insert(waiting_.begin(), std::make_move_iterator(batch.begin()), std::make_move_iterator(batch.end()));
      }
      counts_.fault = fault;
      flushes_done_ = flushes;
      done_.notify_all();
      if (last) return;
    }
  }

  /// Executes a batch and commits it. Writes refused by the store are removed and the rest is repeated. Returns the
  /// fault; kept_ is set if the batch is still to be committed.
  std::string commit(std::deque<Write>& batch, std::int64_t& refused) {
    std::string fault;
    while (true) {
      auto write = batch.begin();
      try {
        for (; write != batch.end(); ++write) (*write)(store_);
        store_.commit();
        kept_ = false;
        return fault;
      } catch (const DataError& error) {  // error of the disk: the batch may succeed later
        takeBack();
        kept_ = true;
        return error.what();
      } catch (const std::exception& error) {
        takeBack();
        fault = error.what();
        if (write == batch.end()) {
          kept_ = true;
          return fault;
        }
        ++refused;
        batch.erase(write);
      }
    }
  }

  void takeBack() {
    try {
      store_.rollback();
    } catch (const std::exception&) {  // of a transaction that the error has already ended
    }
  }

  Store store_;
  const Options options_;
  mutable std::mutex mutex_;  // guards all members below except the thread and kept_, which only the thread uses
  std::condition_variable wake_, done_;
  std::deque<Write> waiting_;
  std::size_t at_work_ = 0;
  Counts counts_;
  std::int64_t flushes_wanted_ = 0, flushes_done_ = 0;
  bool ending_ = false;
  bool kept_ = false;
  std::thread thread_;
};

LiveWriter::LiveWriter(Store store, const Options& options)
    : implementation_(std::make_unique<Implementation>(std::move(store), options)) {}
LiveWriter::~LiveWriter() = default;
bool LiveWriter::post(Write write) { return implementation_->post(std::move(write)); }
void LiveWriter::flush() { implementation_->flush(); }
LiveWriter::Counts LiveWriter::counts() const { return implementation_->counts(); }

}  // namespace urban_nav_store
