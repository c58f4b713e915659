// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "segway_drivers/gps/fix.hpp"
#include "segway_drivers/stream/frame_stream.hpp"

namespace segway_drivers {

/// Returns a sentence: `$`, body, checksum, CR and LF.
Bytes makeNmeaSentence(std::string_view body);
/// Framing rule of sentences: printable characters from `$` to the end of the line, with a correct checksum.
FrameProbe probeNmeaSentence(ByteView bytes);

/// Fields of a complete sentence. Views into its bytes.
struct NmeaSentence {
  std::string_view kind;                 ///< "GGA" for any talker, "PGRME" for proprietary ones
  std::vector<std::string_view> fields;  ///< [0] follows the name

  std::string_view field(std::size_t i) const { return i < fields.size() ? fields[i] : std::string_view(); }
};
NmeaSentence splitNmeaSentence(ByteView sentence);

/// Groups sentences into fixes by their time: GGA, GNS, GLL and RMC (position), GST and GBS (errors), ZDA (date). GSA,
/// VTG and PGRME have no time and belong to the group in which they arrive. A fix is passed on when the sentence
/// arrives that ended previous groups, or the first one of another time, or finish() is called. Not thread-safe.
class NmeaFixBuilder {
 public:
  using Sink = std::function<void(const GpsFix&)>;
  /// `uere`: m, factor of dilutions of precision if the receiver states no errors.
  explicit NmeaFixBuilder(double uere) : uere_(uere) {}

  void add(const NmeaSentence& sentence, std::uint64_t offset, TimeNs arrival, const Sink& sink);
  /// Passes on the current group, as after silence.
  void finish(const Sink& sink);
  bool isOpen() const { return open_; }

 private:
  struct Group {
    GpsFix fix;
    std::string time;  // as in the sentence
    std::optional<std::int64_t> days, milliseconds;
    std::optional<double> hdop, vdop;
    bool valid = false;
    bool has_deviations = false;  // of a GST
    std::string last_kind, kinds;
  };

  void beginGroup(std::string_view time, std::uint64_t offset, TimeNs arrival, const Sink& sink);
  bool isOfGroup(std::string_view time) const;
  void addGga(const NmeaSentence& sentence);
  void addGns(const NmeaSentence& sentence);
  void addGll(const NmeaSentence& sentence);
  void addRmc(const NmeaSentence& sentence);
  void addZda(const NmeaSentence& sentence);
  void addErrors(const NmeaSentence& sentence);
  void addHeight(const NmeaSentence& sentence, std::size_t geoid_field);
  void setPosition(const NmeaSentence& sentence, std::size_t first);
  void addOther(const NmeaSentence& sentence);
  void complete(GpsFix& fix) const;

  double uere_;
  Group group_;
  bool open_ = false;
  std::string given_time_, ends_with_, ended_with_;
  std::optional<std::int64_t> days_;  // of the latest RMC or ZDA
};

}  // namespace segway_drivers
