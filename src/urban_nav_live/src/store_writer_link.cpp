// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_live/store_writer_link.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_live {

using urban_nav_core::Error;
using urban_nav_core::UserError;
using urban_nav_store::Access;
using urban_nav_store::LiveWriter;
using urban_nav_store::Store;

namespace {

std::string makeTemporaryFolder() {
  std::error_code error;
  std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (error) folder = "/tmp";
  std::string name = (folder / "urban_nav_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw UserError(folder.string(), std::string("no temporary folder can be made: ") + std::strerror(errno), "");
  return name;
}

}  // namespace

void addStoreFigures(const StoreState& state, StageReport& report) {
  report.add("store", state.path);
  if (state.path.empty()) return;
  report.add("store: writes committed", state.committed);
  report.add("store: writes that wait", state.waiting);
  report.add("store: writes rejected", state.refused);
  report.add("store: writes lost", state.lost);
  report.add("store: fault", state.fault);
}

StoreWriterLink::StoreWriterLink(std::string path, Options options)
    : options_(std::move(options)), path_(std::move(path)) {}

StoreWriterLink::~StoreWriterLink() {
  writer_.reset();
  std::error_code ignored;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
}

bool StoreWriterLink::open(const Reader& read) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (writer_ || (path_.empty() && options_.empty_path == EmptyPath::NoStore)) return false;
  const Clock::time_point now = options_.now();
  if (tried_ && now - *tried_ < options_.retry_period) return false;
  tried_ = now;
  try {
    if (path_.empty()) {
      folder_ = makeTemporaryFolder();
      path_ = folder_ + "/session.db";
    }
    if (path_.front() != '/') throw UserError("store", "`" + path_ + "`", "an absolute path");
    Store store(path_, Access::Write);
    if (read) read(store);
    writer_ = std::make_shared<LiveWriter>(std::move(store), options_.writer);
    fault_.clear();
    return true;
  } catch (const Error& error) {
    fault_ = error.what();
    return false;
  }
}

std::shared_ptr<LiveWriter> StoreWriterLink::writer() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return writer_;
}

std::string StoreWriterLink::path() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return path_;
}

void StoreWriterLink::post(LiveWriter::Write write) {
  const std::shared_ptr<LiveWriter> writer = this->writer();
  if (writer && writer->post(std::move(write))) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  ++lost_;
}

void StoreWriterLink::flush() {
  if (const auto writer = this->writer()) writer->flush();
}

StoreState StoreWriterLink::state() const {
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

}  // namespace urban_nav_live
