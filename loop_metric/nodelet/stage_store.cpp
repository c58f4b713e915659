// SPDX-License-Identifier: BSD-3-Clause
#include "stage_store.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>

#include "urban_nav_core/types/error.hpp"

namespace loop_metric {

using urban_nav_core::UserError;
using urban_nav_store::Access;
using urban_nav_store::LiveWriter;
using urban_nav_store::Store;

namespace {

constexpr std::chrono::seconds again{10};

std::string makeFolder() {
  std::error_code error;
  std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (error) folder = "/tmp";
  std::string name = (folder / "loop_metric_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw UserError(folder.string(), std::string("no temporary folder can be made: ") + std::strerror(errno), "");
  return name;
}

}  // namespace

StageStore::StageStore(std::string path) : temporary_(path.empty()), path_(std::move(path)) {}

StageStore::~StageStore() {
  writer_.reset();
  std::error_code ignored;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
}

bool StageStore::open() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (writer_ || (tried_ && Clock::now() - *tried_ < again)) return false;
  tried_ = Clock::now();
  try {
    if (temporary_ && folder_.empty()) {
      folder_ = makeFolder();
      path_ = folder_ + "/session.db";
    }
    if (path_.front() != '/') throw UserError("store", "`" + path_ + "`", "an absolute path");
    writer_ = std::make_shared<LiveWriter>(Store(path_, Access::Write), LiveWriter::Options());
    fault_.clear();
    return true;
  } catch (const urban_nav_core::Error& error) {
    fault_ = error.what();
    return false;
  }
}

std::shared_ptr<LiveWriter> StageStore::writer() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return writer_;
}

bool StageStore::isOpen() const { return writer() != nullptr; }

void StageStore::post(LiveWriter::Write write) {
  const std::shared_ptr<LiveWriter> writer = this->writer();
  if (writer && writer->post(std::move(write))) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  ++lost_;
}

void StageStore::flush() {
  if (const auto writer = this->writer()) writer->flush();
}

StoreState StageStore::state() const {
  const std::shared_ptr<LiveWriter> writer = this->writer();
  const LiveWriter::Counts counts = writer ? writer->counts() : LiveWriter::Counts();
  const std::lock_guard<std::mutex> lock(mutex_);
  StoreState state;
  state.path = path_;
  state.fault = writer ? counts.fault : fault_;
  state.committed = counts.committed;
  state.refused = counts.refused;
  state.waiting = counts.waiting;
  state.lost = lost_;
  return state;
}

}  // namespace loop_metric
