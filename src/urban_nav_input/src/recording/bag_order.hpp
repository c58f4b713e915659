// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/recording/recording.hpp"

namespace urban_nav_input {

/// Relation between the header stamps of the images of a recording and the times of receipt.
struct StampSurvey {
  /// Stamps of one topic ascend, but messages are not in the order of their stamps: the bags were converted, merged,
  /// filtered, or recorded over a slow link.
  bool needs_sorting = false;
  /// No header has a stamp.
  bool unset = false;
  /// All stamps of each topic are equal, as from a driver that stamps with the time of its start.
  bool constant = false;
  /// ns; largest step back of the stamps of a topic while times of receipt ascend: a clock was set.
  urban_nav_core::StampNs back = 0;
};

/// Returns the stamp (ns) of a message that begins with a std_msgs/Header; 0 if it is too short or damaged.
urban_nav_core::StampNs readHeaderStamp(const RecordedMessage& message);

/// Returns the smallest and the largest header stamp of the first and last messages of a selection, an approximation of
/// its span. Reads the selection to its end.
std::pair<urban_nav_core::StampNs, urban_nav_core::StampNs> findStampSpan(MessageSelection& messages);

/// Surveys a few hundred messages of the topics, evenly distributed over the part of the bags within `range`.
StampSurvey surveyStamps(Recording& recording, const std::vector<std::string>& topics, const ReceiptRange& range = {});

/// Reads the messages of some bags in the order of receipt, or of their header stamps and then of receipt. Sorting
/// reads all messages once, keeps about 60 bytes for each, and requires topics whose messages have headers. Omits
/// messages received outside `range`.
class BagMessages {
 public:
  BagMessages(const std::vector<RecordingFile*>& bags, const std::vector<std::string>& topics, bool is_sorted,
              const ReceiptRange& range = {});

  /// Returns null at the end; the message is valid until the next call.
  const RecordedMessage* next();

 private:
  MessageSelection selection_;
  std::optional<RecordedMessage> message_;
  bool is_sorted_;
  std::vector<RecordedMessage> all_;                                    // if they are sorted
  std::vector<std::pair<urban_nav_core::StampNs, std::size_t>> order_;  // of them
  std::size_t next_ = 0;
};

}  // namespace urban_nav_input
