// SPDX-License-Identifier: BSD-3-Clause
#include "laser/cloud/time_survey.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace urban_nav_core {

namespace {

constexpr double kNear = 1.5;           // s: times of at most this magnitude are relative to the header
constexpr double kMostSpread = 0.5;     // s: of the centres of sweeps relative to their headers
constexpr double kUsualSweep = 0.1;     // s
constexpr double kSteadyShare = 0.005;  // share of pairs against the trend, for unknown field names
constexpr std::size_t kLeastDistinct = 64, kMostRingNumbers = 256;  // distinct values of such a field

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double computeSpread(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return values.empty() ? 0.0 : *most - *least;
}

/// One field over all clouds, interpreted in one unit.
struct Candidate {
  PointTimes times;
  std::vector<double> spans, middles;  ///< s; middles relative to the header
  double trend = 0.0;
};

/// Returns the unit in which most of the clouds have a valid duration of a sweep.
std::optional<PointTimes::Unit> agreedUnit(const std::vector<const FieldStatistics*>& fields) {
  std::array<std::size_t, 4> votes = {};
  for (const FieldStatistics* field : fields)
    if (const std::optional<PointTimes::Unit> unit = unitOfSpan(field->span()))
      ++votes[static_cast<std::size_t>(*unit)];
  const auto most = std::max_element(votes.begin(), votes.end());
  if (2 * *most < fields.size() || *most == 0) return std::nullopt;
  return static_cast<PointTimes::Unit>(most - votes.begin());
}

bool isSteady(const FieldStatistics& field) {
  return std::min(field.rising, field.falling) <= kSteadyShare && field.distinct >= kLeastDistinct &&
         !(field.is_whole && field.distinct <= kMostRingNumbers);
}

std::vector<const FieldStatistics*> collect(const std::vector<CloudStatistics>& clouds, const std::string& name) {
  std::vector<const FieldStatistics*> fields;
  for (const CloudStatistics& cloud : clouds)
    if (const FieldStatistics* field = cloud.find(name)) fields.push_back(field);
  return fields;
}

/// Interprets a field as times; the centres are relative to the header, or stamps.
Candidate readAs(const std::vector<CloudStatistics>& clouds, const PointTimes& times) {
  Candidate candidate;
  candidate.times = times;
  const double unit = nanoseconds(times.unit);
  std::vector<double> trends;
  for (const CloudStatistics& cloud : clouds) {
    const FieldStatistics* field = cloud.find(times.field);
    if (field == nullptr) continue;
    const double header = times.reference == PointTimes::Reference::Absolute ? static_cast<double>(cloud.stamp) : 0.0;
    candidate.middles.push_back(1e-9 * (unit * field->middle() - header));
    candidate.spans.push_back(1e-9 * unit * field->span());
    trends.push_back(field->trend);
  }
  candidate.trend = median(trends);
  return candidate;
}

/// Values near 0 in all clouds are relative to the header, unless they increase with the stamps of the headers like
/// those of a clock that has just started.
PointTimes::Reference chooseReference(const Candidate& from_header, const Candidate& absolute) {
  const auto isNear = [](double middle) { return std::abs(middle) <= kNear; };
  if (!std::all_of(from_header.middles.begin(), from_header.middles.end(), isNear))
    return PointTimes::Reference::Absolute;
  const bool follows = std::all_of(absolute.middles.begin(), absolute.middles.end(), isNear) &&
                       computeSpread(absolute.middles) < computeSpread(from_header.middles);
  return follows ? PointTimes::Reference::Absolute : PointTimes::Reference::Header;
}

std::optional<Candidate> asTimes(const std::vector<CloudStatistics>& clouds, const std::string& name) {
  const FieldMeaning meaning = findMeaning(name);
  const std::vector<const FieldStatistics*> fields = collect(clouds, name);
  if (meaning == FieldMeaning::Other || fields.empty()) return std::nullopt;
  const std::optional<PointTimes::Unit> unit = agreedUnit(fields);
  if (!unit) return std::nullopt;
  if (meaning == FieldMeaning::Unknown &&
      !std::all_of(fields.begin(), fields.end(), [](const FieldStatistics* field) { return isSteady(*field); }))
    return std::nullopt;
  Candidate from_header = readAs(clouds, {name, *unit, PointTimes::Reference::Header}),
            absolute = readAs(clouds, {name, *unit, PointTimes::Reference::Absolute});
  if (chooseReference(from_header, absolute) == PointTimes::Reference::Absolute) return absolute;
  if (computeSpread(from_header.middles) > kMostSpread) return std::nullopt;  // subsecond part of a stamp
  return from_header;
}

std::optional<Candidate> findTimes(const std::vector<CloudStatistics>& clouds) {
  for (const FieldMeaning meaning : {FieldMeaning::Time, FieldMeaning::Unknown})
    for (const FieldStatistics& field : clouds.front().fields)
      if (findMeaning(field.name) == meaning)
        if (std::optional<Candidate> found = asTimes(clouds, field.name)) return found;
  return std::nullopt;
}

/// Returns whether a field holds stamps of single precision in this unit.
bool isRounded(const std::vector<CloudStatistics>& clouds, const PointTimes& times) {
  if (times.reference != PointTimes::Reference::Absolute) return false;
  return std::all_of(clouds.begin(), clouds.end(), [&](const CloudStatistics& cloud) {
    const FieldStatistics* field = cloud.find(times.field);
    return field != nullptr && unitOfRoundedStamps(*field, cloud.stamp) == times.unit;
  });
}

std::optional<PointTimes> findRoundedTimes(const std::vector<CloudStatistics>& clouds) {
  for (const FieldStatistics& field : clouds.front().fields) {
    if (findMeaning(field.name) != FieldMeaning::Time) continue;
    const std::optional<PointTimes::Unit> unit = unitOfRoundedStamps(field, clouds.front().stamp);
    if (!unit) continue;
    const PointTimes times{field.name, *unit, PointTimes::Reference::Absolute};
    if (isRounded(clouds, times)) return times;
  }
  return std::nullopt;
}

void takeRounded(const PointTimes& times, CloudConvention& convention) {
  convention.times = times;
  convention.fault = PointTimesFault::Constant;
  convention.suspect = times.field;
}

/// Sets the reason why no field was found.
void explainAbsence(const std::vector<CloudStatistics>& clouds, CloudConvention& convention) {
  convention.fault = PointTimesFault::Absent;
  for (const FieldStatistics& field : clouds.front().fields) {
    if (findMeaning(field.name) != FieldMeaning::Time) continue;
    const std::vector<const FieldStatistics*> all = collect(clouds, field.name);
    const auto constant =
        std::count_if(all.begin(), all.end(), [](const FieldStatistics* f) { return f->span() == 0.0; });
    if (2 * static_cast<std::size_t>(constant) < all.size()) continue;
    convention.fault = PointTimesFault::Constant;
    convention.suspect = field.name;
    return;
  }
}

double timeBetween(const std::vector<CloudStatistics>& clouds) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < clouds.size(); ++i)
    if (const double s = secondsBetween(clouds[i - 1].stamp, clouds[i].stamp); s > 0.0) intervals.push_back(s);
  return intervals.empty() ? kUsualSweep : median(intervals);
}

void take(const Candidate& candidate, CloudConvention& convention) {
  convention.times = candidate.times;
  convention.sweep_s = median(candidate.spans);
  convention.middle = median(candidate.middles);
  if (std::abs(convention.middle) <= kClockTolerance) return;
  // Clocks that differ by time zone, epoch or time scale (UTC, TAI) differ by whole seconds.
  convention.fault = PointTimesFault::Clock;
  convention.suspect = candidate.times.field;
  convention.clock = convention.middle;
  convention.middle -= std::round(convention.middle);
}

/// Returns whether drivers do not use this unit for numbers of this type.
bool isUnusual(const CloudStatistics& cloud, const PointTimes& times) {
  const FieldStatistics* field = cloud.find(times.field);
  return field != nullptr && field->number == CloudField::Number::Float32 && times.unit != PointTimes::Unit::Seconds;
}

}  // namespace

const FieldStatistics* CloudStatistics::find(const std::string& name) const {
  const auto found =
      std::find_if(fields.begin(), fields.end(), [&](const FieldStatistics& field) { return field.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

void findPointTimes(const std::vector<CloudStatistics>& clouds, const CloudOptions& options,
                    CloudConvention& convention) {
  convention.sweep_s = timeBetween(clouds);
  if (options.times) {
    if (!options.times->areKnown()) return;
    const Candidate given = readAs(clouds, *options.times);
    if (given.spans.empty()) return;  // the field does not exist
    if (isRounded(clouds, *options.times)) return takeRounded(*options.times, convention);
    take(given, convention);
    const std::optional<PointTimes::Unit> unit = agreedUnit(collect(clouds, options.times->field));
    if (unit == options.times->unit) return;
    convention.fault = PointTimesFault::Unit;
    convention.suspect = options.times->field;
    return;
  }
  const std::optional<Candidate> found = findTimes(clouds);
  if (!found) {
    if (const std::optional<PointTimes> rounded = findRoundedTimes(clouds)) takeRounded(*rounded, convention);
    else explainAbsence(clouds, convention);
  } else if (found->trend < kDecreasingTrend) {
    convention.fault = PointTimesFault::Decreasing;
    convention.suspect = found->times.field;
    if (const double middle = median(found->middles); std::abs(middle) <= kClockTolerance) convention.middle = middle;
  } else {
    take(*found, convention);
    if (convention.fault == PointTimesFault::None && isUnusual(clouds.front(), convention.times)) {
      convention.fault = PointTimesFault::Unit;
      convention.suspect = convention.times.field;
    }
  }
}

}  // namespace urban_nav_core
