// SPDX-License-Identifier: BSD-3-Clause
#ifndef Ranks_h
#define Ranks_h

#include <functional>

namespace reliefshade
{

/// The processes that share a run, as mpirun starts them; usually one. All of them make the same
/// calls in the same order.
class Ranks
{
public:
  virtual ~Ranks() = default;
  virtual int GetRank() const { return 0; }
  virtual int GetCount() const { return 1; }

  /// The first process that is not well, once all have said whether they are; the number of
  /// processes if all are.
  virtual int FindFailed(bool well) { return well ? 1 : 0; }

  /// Ends what MPI began. Where the others do not know of it that this one fails, they are ended.
  virtual void Leave(bool together) { (void)together; }

  /// Whether a step of all has failed, and all know of it.
  bool HasFailed() const { return this->Failed; }

  /// Runs a step that may fail on some, and waits for all. Throws what it has thrown, where that is
  /// the first process on which it failed; on all others an OtherRank.
  void Together(const std::function<void()>& step);

  /// The same, the first one's step before those of all others.
  void FirstAhead(const std::function<void()>& step);

private:
  bool Failed = false;
};

/// A failure that another process tells.
struct OtherRank
{
};

/// Whether this process is one of several, by what mpirun tells it, and their number.
int countRanks();

/// Those of this run. MPI is there only where processes are several. Throws a Failure where the
/// program knows no MPI.
Ranks& ranks();

/// The same if anybody has asked for them; else null.
Ranks* startedRanks();

}

#endif
