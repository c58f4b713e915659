// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/gps/fix.hpp"

#include <cstdio>

namespace segway_drivers {

namespace {

struct GpsDate {
  int year, month, day;
};

/// Returns the Gregorian date of days since 1970-01-01, by 400-year cycles from 1 March of year 0.
GpsDate dateOfDays(std::int64_t days) {
  const std::int64_t z = days + 719468, era = (z >= 0 ? z : z - 146096) / 146097;
  const std::int64_t day_of_era = z - era * 146097;
  const std::int64_t year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36524 - day_of_era / 146096) / 365;
  const std::int64_t day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
  const std::int64_t shifted = (5 * day_of_year + 2) / 153;
  const int day = static_cast<int>(day_of_year - (153 * shifted + 2) / 5 + 1);
  const int month = static_cast<int>(shifted < 10 ? shifted + 3 : shifted - 9);
  return {static_cast<int>(year_of_era + era * 400 + (month <= 2 ? 1 : 0)), month, day};
}

}  // namespace

double rangeError(GpsFix::Carrier carrier, double uere) {
  constexpr double kFixed = 0.02, kFloat = 0.4;  // m
  if (carrier == GpsFix::Carrier::None) return uere;
  return carrier == GpsFix::Carrier::Fixed ? kFixed : kFloat;
}

std::optional<std::int64_t> daysOfDate(int year, int month, int day) {
  if (year < 1 || year > 9999 || month < 1 || month > 12 || day < 1 || day > 31) return std::nullopt;
  const std::int64_t y = year - (month <= 2 ? 1 : 0), era = y / 400, year_of_era = y - era * 400;
  const std::int64_t day_of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  const std::int64_t days =
      era * 146097 + year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year - 719468;
  if (dateOfDays(days).day != day) return std::nullopt;
  return days;
}

std::string printUtc(std::int64_t days, std::int64_t milliseconds) {
  const GpsDate date = dateOfDays(days);
  const int ms = static_cast<int>(milliseconds);
  char text[64];
  std::snprintf(text, sizeof(text), "%04d-%02d-%02dT%02d:%02d:%02d.%03dZ", date.year, date.month, date.day,
                ms / 3600000, ms / 60000 % 60, ms / 1000 % 60, ms % 1000);
  return text;
}

}  // namespace segway_drivers
