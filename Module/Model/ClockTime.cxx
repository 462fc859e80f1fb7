// SPDX-License-Identifier: BSD-3-Clause
#include "ClockTime.h"

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iomanip>
#include <sstream>

namespace relief
{

namespace
{
constexpr std::int64_t Second = 1000;
constexpr std::int64_t Minute = 60 * Second;
constexpr std::int64_t Hour = 60 * Minute;
constexpr std::int64_t Day = 24 * Hour;

struct Date
{
  int year;
  int month;
  int day;
};

bool IsLeap(int year)
{
  return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
}

int DaysOfMonth(int year, int month)
{
  constexpr int days[] = { 31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31 };
  return days[month - 1] + (month == 2 && IsLeap(year) ? 1 : 0);
}

// Days since 1970-01-01. A year begins in March here, so that the leap day is its last.
std::int64_t DaysOf(const Date& date)
{
  const std::int64_t year = date.year - (date.month <= 2 ? 1 : 0);
  const std::int64_t month = (date.month + 9) % 12;
  return 365 * year + year / 4 - year / 100 + year / 400 + (153 * month + 2) / 5 + date.day - 1 -
    719468; // of 1970-01-01
}

Date DateOf(std::int64_t days)
{
  // No year is that far from its mean length.
  int year = 1970 + static_cast<int>(std::floor(static_cast<double>(days) / 365.2425));
  while (DaysOf({ year, 1, 1 }) > days)
  {
    --year;
  }
  while (DaysOf({ year + 1, 1, 1 }) <= days)
  {
    ++year;
  }
  int month = 1;
  while (month < 12 && DaysOf({ year, month + 1, 1 }) <= days)
  {
    ++month;
  }
  return { year, month, static_cast<int>(days - DaysOf({ year, month, 1 })) + 1 };
}

// Takes a text apart from its beginning on.
class Scanner
{
public:
  explicit Scanner(const std::string& text)
    : Text(text)
  {
  }

  bool AtEnd() const { return this->At == this->Text.size(); }
  char Next() const { return this->AtEnd() ? '\0' : this->Text[this->At]; }

  bool Take(const char* any)
  {
    for (const char* c = any; *c && !this->AtEnd(); ++c)
    {
      if (this->Text[this->At] == *c)
      {
        ++this->At;
        return true;
      }
    }
    return false;
  }

  bool IsDigit() const { return this->Next() >= '0' && this->Next() <= '9'; }

  // A number of just so many digits.
  bool Digits(int count, int& number)
  {
    number = 0;
    for (; count > 0 && this->IsDigit(); --count)
    {
      number = 10 * number + (this->Text[this->At++] - '0');
    }
    return count == 0;
  }

  // What follows a decimal point, rounded to milliseconds.
  bool Fraction(int& thousandths)
  {
    double value = 0.0;
    double place = 100.0;
    const bool any = this->IsDigit();
    for (; this->IsDigit(); place *= 0.1)
    {
      value += place * (this->Text[this->At++] - '0');
    }
    thousandths = static_cast<int>(std::lround(value));
    return any;
  }

  // A decimal number without a sign.
  bool Number(double& number)
  {
    const std::size_t begin = this->At;
    while (this->IsDigit() || this->Next() == '.')
    {
      ++this->At;
    }
    const std::string digits = this->Text.substr(begin, this->At - begin);
    char* end = nullptr;
    number = std::strtod(digits.c_str(), &end);
    return !digits.empty() && digits != "." && *end == '\0';
  }

  std::string Rest() const { return this->Text.substr(this->At); }

private:
  const std::string& Text;
  std::size_t At = 0;
};

struct Clock
{
  int hour = 0;
  int minute = 0;
  int second = 0;
  int thousandths = 0;
};

// hh:mm, hh:mm:ss and hh:mm:ss.fff, or the same without colons.
bool ReadClock(Scanner& scan, bool extended, Clock& clock)
{
  if (!scan.Digits(2, clock.hour) || (extended && !scan.Take(":")) || !scan.Digits(2, clock.minute))
  {
    return false;
  }
  if (extended ? scan.Take(":") : scan.IsDigit())
  {
    return scan.Digits(2, clock.second) && (!scan.Take(".,") || scan.Fraction(clock.thousandths));
  }
  return true;
}

// Z, +hh:mm, +hhmm or +hh; in minutes.
bool ReadZone(Scanner& scan, int& zone)
{
  zone = 0;
  if (scan.Take("Zz"))
  {
    return true;
  }
  const bool west = scan.Next() == '-';
  int hours = 0;
  int minutes = 0;
  if (!scan.Take("+-") || !scan.Digits(2, hours))
  {
    return false;
  }
  if (scan.Take(":") || scan.IsDigit())
  {
    if (!scan.Digits(2, minutes))
    {
      return false;
    }
  }
  zone = (west ? -1 : 1) * (60 * hours + minutes);
  return hours <= 23 && minutes <= 59;
}

std::string Wrong(const std::string& text, const std::string& why)
{
  return "'" + text.substr(0, 40) + "' " + why;
}

// In milliseconds, of what ISO 8601 names by a letter.
std::int64_t SizeOf(char unit)
{
  return unit == 'D' ? Day : unit == 'H' ? Hour : unit == 'M' ? Minute : Second;
}

// What is wrong with numbers that were read, if anything.
std::string CheckNumbers(const Date& date, const Clock& clock)
{
  if (date.year < ClockTime::FirstYear || date.year > ClockTime::LastYear)
  {
    return "is of a year that is not known; " + std::to_string(ClockTime::FirstYear) + " to " +
      std::to_string(ClockTime::LastYear) + " is expected";
  }
  if (date.month < 1 || date.month > 12 || date.day < 1 ||
    date.day > DaysOfMonth(date.year, date.month))
  {
    return "is of a day that the calendar lacks; year, month and day are expected";
  }
  const bool midnight =
    clock.hour == 24 && clock.minute == 0 && clock.second == 0 && clock.thousandths == 0;
  if ((clock.hour > 23 && !midnight) || clock.minute > 59 || clock.second > 60)
  {
    return "is of an hour that clocks lack; 00:00 to 24:00 is expected";
  }
  return std::string();
}
}

//------------------------------------------------------------------------------
double JulianDay(const ClockTime& time)
{
  return 2440587.5 + static_cast<double>(time.milliseconds) / static_cast<double>(Day);
}

//------------------------------------------------------------------------------
std::string ParseTime(const std::string& text, ClockTime& time)
{
  const std::string form = "date, time and zone as 2026-06-21T06:30+02:00 are expected";
  Scanner scan(text);
  Date date{};
  const bool year = scan.Digits(4, date.year);
  const bool extended = scan.Take("-");
  if (!year || !scan.Digits(2, date.month) || (extended && !scan.Take("-")) ||
    !scan.Digits(2, date.day))
  {
    return Wrong(text, "is no date; " + form);
  }
  if (scan.AtEnd())
  {
    return Wrong(text, "has no time, on which the sun's place depends; " + form);
  }
  Clock clock;
  if (!scan.Take("Tt ") || !ReadClock(scan, extended, clock))
  {
    return Wrong(text, "has no time that is understood; " + form);
  }
  if (scan.AtEnd())
  {
    return Wrong(text,
      "has no zone, without which it is another moment everywhere; Z or one as "
      "+02:00 is expected behind it");
  }
  int zone = 0;
  if (!ReadZone(scan, zone) || !scan.AtEnd())
  {
    return Wrong(text, "has no zone that is understood; Z or one as +02:00 is expected behind it");
  }
  const std::string wrong = CheckNumbers(date, clock);
  if (!wrong.empty())
  {
    return Wrong(text, wrong);
  }
  const std::int64_t minute =
    DaysOf(date) * Day + clock.hour * Hour + clock.minute * Minute - zone * Minute;
  // As many milliseconds of a day in UTC, also before 1970.
  if (clock.second == 60 && ((minute % Day) + Day) % Day != Day - Minute)
  {
    return Wrong(text, "has a second 60, as only 23:59:60 of UTC has; 0 to 59 is expected");
  }
  time.milliseconds = minute + clock.second * Second + clock.thousandths;
  time.zone = zone;
  return std::string();
}

//------------------------------------------------------------------------------
std::string ParseDuration(const std::string& text, std::int64_t& milliseconds)
{
  Scanner scan(text);
  double sum = 0.0;
  bool good = !text.empty();
  if (scan.Take("Pp"))
  {
    // Days, then behind a T hours, minutes and seconds, each once and in this order.
    std::string units = "D";
    bool days = true;
    bool any = false; // behind the T, if there is one
    while (good && !scan.AtEnd())
    {
      if (days && scan.Take("Tt"))
      {
        units = "HMS";
        days = any = false;
        continue;
      }
      double number = 0.0;
      good = scan.Number(number);
      const std::size_t unit = good && !scan.AtEnd() ? units.find(scan.Next()) : std::string::npos;
      good = good && unit != std::string::npos;
      if (good)
      {
        sum += number * static_cast<double>(SizeOf(units[unit]));
        scan.Take("DHMS");
        units.erase(0, unit + 1);
        any = true;
      }
    }
    good = good && any;
  }
  else
  {
    double number = 0.0;
    good = good && scan.Number(number);
    const std::string unit = scan.Rest();
    const std::int64_t size = unit == "s" ? Second
      : unit == "min"                     ? Minute
      : unit == "h"                       ? Hour
      : unit == "d"                       ? Day
                                          : 0;
    good = good && size != 0;
    sum = number * static_cast<double>(size);
  }
  constexpr double most = 1e15; // some ten thousand years
  if (!good || !(sum >= 1.0) || sum > most)
  {
    return Wrong(text, "is no duration above 0; one as 15min, 1h or PT15M is expected");
  }
  milliseconds = std::llround(sum);
  return std::string();
}

//------------------------------------------------------------------------------
std::string NameOf(const ClockTime& time, bool seconds)
{
  const std::int64_t local = time.milliseconds + time.zone * Minute;
  const std::int64_t days = local >= 0 ? local / Day : -((Day - 1 - local) / Day);
  const Date date = DateOf(days);
  const std::int64_t rest = local - days * Day;
  std::ostringstream name;
  name.fill('0');
  const auto add = [&name](int digits, std::int64_t number)
  { name << std::setw(digits) << number; };
  add(4, date.year);
  add(2, date.month);
  add(2, date.day);
  name << 'T';
  add(2, rest / Hour);
  add(2, rest % Hour / Minute);
  if (seconds || rest % Minute != 0)
  {
    add(2, rest % Minute / Second);
  }
  if (rest % Second != 0)
  {
    name << '.';
    add(3, rest % Second);
  }
  if (time.zone == 0)
  {
    name << 'Z';
    return name.str();
  }
  name << (time.zone < 0 ? '-' : '+');
  add(2, std::abs(time.zone) / 60);
  add(2, std::abs(time.zone) % 60);
  return name.str();
}

}
