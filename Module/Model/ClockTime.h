// SPDX-License-Identifier: BSD-3-Clause
#ifndef ClockTime_h
#define ClockTime_h

#include <cstdint>
#include <string>

namespace relief
{

/// A moment as clocks show it: in a zone, by the Gregorian calendar.
struct ClockTime
{
  std::int64_t milliseconds = 0; ///< since 1970-01-01T00:00Z, without leap seconds, as POSIX counts
  int zone = 0;                  ///< how many minutes the zone's clocks are ahead of UTC

  static constexpr int FirstYear = 1600;
  static constexpr int LastYear = 2399;
};

/// The Julian date, in days of UTC.
double JulianDay(const ClockTime& time);

/// Reads a date and time of ISO 8601 with its zone: 2026-06-21T06:30+02:00, 20260621T0430Z; seconds
/// and their fractions may follow. Second 60 is a leap second: 23:59:60 of UTC, which is taken for
/// the midnight after it. Returns an empty text, or what is wrong; a time without a zone is, since
/// it means another moment in every zone.
std::string ParseTime(const std::string& text, ClockTime& time);

/// Reads a duration: 15min, 90s, 1.5h, 1d, or PT15M, P1DT12H of ISO 8601. Returns an empty text, or
/// what is wrong; a duration below a millisecond is.
std::string ParseDuration(const std::string& text, std::int64_t& milliseconds);

/// In the basic form of ISO 8601, which suits names of files: 20260621T0630+0200; with `seconds`
/// 20260621T063000+0200. Fractions of a second are told where there are any.
std::string NameOf(const ClockTime& time, bool seconds);

}

#endif
