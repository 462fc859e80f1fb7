// SPDX-License-Identifier: BSD-3-Clause
#ifndef Taker_h
#define Taker_h

#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace reliefshade
{

/// Runs a step over bands in a thread of its own. One is waiting at most.
class Taker
{
public:
  explicit Taker(const std::function<void(vtkImageData*)>& step)
    : Step(step)
    , Thread([this] { this->Run(); })
  {
  }

  /// Waits for what is under way; what is waiting is forgotten.
  ~Taker() { this->Join(false); }
  Taker(const Taker&) = delete;
  void operator=(const Taker&) = delete;

  /// Waits until there is room for another. Throws what the step has thrown.
  void Give(const vtkSmartPointer<vtkImageData>& band);

  /// Waits for all. Throws what the step has thrown.
  void Finish();

private:
  void Run();
  void Join(bool whole);

  const std::function<void(vtkImageData*)>& Step;
  std::mutex Mutex;
  std::condition_variable Changed;
  vtkSmartPointer<vtkImageData> Waiting;
  bool Ended = false;
  std::exception_ptr Thrown;
  std::thread Thread; // last: it uses the others
};

}

#endif
