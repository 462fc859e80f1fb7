// SPDX-License-Identifier: BSD-3-Clause
#ifndef Timing_h
#define Timing_h

/// @file
/// Times that mean something on a machine that does other things as well: processor time where one
/// thread works, rivals in turn, and the least of several repetitions.

#include <algorithm>
#include <chrono>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

namespace bench
{

enum class Clock
{
  Thread,  ///< processor time of the calling thread
  Process, ///< and of all others of this program
  Wall
};

inline double Seconds(Clock clock)
{
#ifdef CLOCK_THREAD_CPUTIME_ID
  if (clock != Clock::Wall)
  {
    timespec now;
    clock_gettime(
      clock == Clock::Thread ? CLOCK_THREAD_CPUTIME_ID : CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1.0e-9 * static_cast<double>(now.tv_nsec);
  }
#endif
  (void)clock;
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Something to be timed against others.
struct Rival
{
  std::string name;
  double samples = 1.0; ///< done in a run
  std::function<void()> run;
  Clock clock = Clock::Thread;
  std::function<void()> before;    ///< not timed, may be empty
  std::vector<double> nanoseconds; ///< a sample, one number for each repetition

  double Least() const
  {
    return *std::min_element(this->nanoseconds.begin(), this->nanoseconds.end());
  }
  double Median() const
  {
    std::vector<double> sorted = this->nanoseconds;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
};

/// Runs each rival once to warm up, then all in turn, so that what disturbs one disturbs the
/// others.
inline void Race(std::vector<Rival>& rivals, int repetitions, bool warmUp = true)
{
  for (int k = warmUp ? -1 : 0; k < repetitions; ++k)
  {
    for (Rival& rival : rivals)
    {
      if (rival.before)
      {
        rival.before();
      }
      const double start = Seconds(rival.clock);
      rival.run();
      const double end = Seconds(rival.clock);
      if (k >= 0)
      {
        rival.nanoseconds.push_back(1.0e9 * (end - start) / rival.samples);
      }
    }
  }
}

/// The least time of one function, in ns a sample.
inline double LeastTime(double samples, int repetitions, const std::function<void()>& run)
{
  std::vector<Rival> rivals(1);
  rivals[0].samples = samples;
  rivals[0].run = run;
  Race(rivals, repetitions);
  return rivals[0].Least();
}

}

#endif
