// SPDX-License-Identifier: BSD-3-Clause
#include "base/console.hpp"

#include <spdlog/logger.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <mutex>

#include "urban_nav_core/io/printable.hpp"

namespace urban_nav {

namespace {
constexpr double kSecondsBetweenLines = 5.0;
constexpr double kSecondsBetweenBars = 0.1;
constexpr int kBarWidth = 24;

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, value < 10.0 ? "%.1f" : "%.0f", value);
  return text;
}
}  // namespace

class Console::Implementation {
 public:
  explicit Implementation(RunListener* takes)
      : listener(takes),
        logger("urban_nav", std::make_shared<spdlog::sinks::stderr_sink_mt>()),
        terminal(takes == nullptr && isatty(STDERR_FILENO) == 1) {
    logger.set_pattern("%v");
    logger.flush_on(spdlog::level::trace);
  }

  void clearTransient() {
    if (transient_width == 0) return;
    std::fprintf(stderr, "\r%*s\r", static_cast<int>(transient_width), "");
    std::fflush(stderr);
    transient_width = 0;
  }

  /// Passes a line to the listener; returns false without one.
  bool give(RunListener::Kind kind, const std::string& line) const {
    if (listener != nullptr) listener->takeLine(kind, line);
    return listener != nullptr;
  }

  RunListener* const listener;
  spdlog::logger logger;
  std::mutex mutex;  // guards transient_width and the order of output
  std::size_t transient_width = 0;
  const bool terminal;
};

Console::Console() : implementation_(std::make_unique<Implementation>(nullptr)) {}
Console::Console(RunListener& listener) : implementation_(std::make_unique<Implementation>(&listener)) {}
Console::~Console() { implementation_->clearTransient(); }

void Console::print(const std::string& text) {
  if (implementation_->give(RunListener::Kind::Result, text)) return;
  const std::lock_guard<std::mutex> lock(implementation_->mutex);
  implementation_->clearTransient();
  const std::string shown = urban_nav_core::printable(text, "\n\t");
  std::fwrite(shown.data(), 1, shown.size(), stdout);  // errors are reported at the end
  std::fflush(stdout);
}

void Console::info(const std::string& line) {
  if (implementation_->give(RunListener::Kind::Info, line)) return;
  const std::lock_guard<std::mutex> lock(implementation_->mutex);
  implementation_->clearTransient();
  implementation_->logger.info("{}", urban_nav_core::printable(line));
}

void Console::warn(const std::string& line) {
  if (implementation_->give(RunListener::Kind::Warning, line)) return;
  const std::lock_guard<std::mutex> lock(implementation_->mutex);
  implementation_->clearTransient();
  implementation_->logger.warn("warning: {}", urban_nav_core::printable(line));
}

void Console::error(const std::string& line) {
  if (implementation_->give(RunListener::Kind::Error, line)) return;
  const std::lock_guard<std::mutex> lock(implementation_->mutex);
  implementation_->clearTransient();
  implementation_->logger.error("error: {}", urban_nav_core::printable(line));
}

void Console::progress(const std::string& label, std::int64_t done, std::int64_t total) {
  if (implementation_->listener != nullptr) implementation_->listener->takeProgress(label, done, total);
}

void Console::transient(const std::string& text) {
  if (!implementation_->terminal) return;
  const std::lock_guard<std::mutex> lock(implementation_->mutex);
  std::fprintf(stderr, "\r%-*s", static_cast<int>(implementation_->transient_width),
               urban_nav_core::printable(text).c_str());
  std::fflush(stderr);
  implementation_->transient_width = std::max(implementation_->transient_width, text.size());
}

bool Console::isTerminal() const { return implementation_->terminal; }

Progress::Progress(Console& console, std::string label, std::string unit, std::int64_t total)
    : console_(console),
      label_(std::move(label)),
      unit_(std::move(unit)),
      total_(total),
      begin_(Clock::now()),
      last_(begin_) {}

void Progress::update(std::int64_t done) {
  console_.progress(label_, done, total_);
  const Clock::time_point now = Clock::now();
  const double since_last = std::chrono::duration<double>(now - last_).count();
  if (since_last < (console_.isTerminal() ? kSecondsBetweenBars : kSecondsBetweenLines)) return;
  last_ = now;
  const std::string text = line(done, std::chrono::duration<double>(now - begin_).count());
  if (console_.isTerminal()) {
    console_.transient(text);
  } else {
    console_.info(text);
  }
}

void Progress::finish(std::int64_t done) {
  console_.progress(label_, done, total_);
  const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  const double rate = seconds > 0.0 ? static_cast<double>(done) / seconds : 0.0;
  console_.info(label_ + ": " + std::to_string(done) + " " + unit_ + " in " + printDuration(seconds) + ", " +
                rounded(rate) + " " + unit_ + "/s");
}

std::string Progress::line(std::int64_t done, double seconds) const {
  const double rate = seconds > 0.0 ? static_cast<double>(done) / seconds : 0.0;
  std::string text = label_ + " ";
  if (total_ > 0) {
    const double share = std::min(1.0, static_cast<double>(done) / static_cast<double>(total_));
    if (console_.isTerminal()) {
      const int filled = static_cast<int>(share * kBarWidth);
      text += "[" + std::string(static_cast<std::size_t>(filled), '#') +
              std::string(static_cast<std::size_t>(kBarWidth - filled), '.') + "] ";
    }
    text += std::to_string(static_cast<int>(std::floor(100.0 * share))) + " %, ";
  }
  text += std::to_string(done) + (total_ > 0 ? "/" + std::to_string(total_) : "") + " " + unit_ + ", " + rounded(rate) +
          " " + unit_ + "/s";
  if (total_ > 0 && rate > 0.0)
    text += ", " + printDuration(static_cast<double>(std::max<std::int64_t>(0, total_ - done)) / rate) + " left";
  return text;
}

std::string printDuration(double seconds) {
  const auto whole = static_cast<long long>(std::llround(std::max(0.0, seconds)));
  char text[48];
  if (whole >= 3600) {
    std::snprintf(text, sizeof text, "%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%lld:%02lld", whole / 60, whole % 60);
  }
  return text;
}

}  // namespace urban_nav
