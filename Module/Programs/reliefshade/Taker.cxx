// SPDX-License-Identifier: BSD-3-Clause
#include "Taker.h"

#include <utility>

namespace reliefshade
{

//------------------------------------------------------------------------------
void Taker::Run()
{
  std::unique_lock<std::mutex> lock(this->Mutex);
  for (;;)
  {
    this->Changed.wait(lock, [this] { return this->Waiting || this->Ended; });
    if (!this->Waiting)
    {
      return;
    }
    vtkSmartPointer<vtkImageData> band;
    std::swap(band, this->Waiting);
    this->Changed.notify_all();
    lock.unlock();
    std::exception_ptr thrown;
    try
    {
      this->Step(band);
    }
    catch (...)
    {
      thrown = std::current_exception();
    }
    band = nullptr;
    lock.lock();
    if (thrown)
    {
      this->Thrown = thrown;
      this->Ended = true;
      this->Changed.notify_all();
      return;
    }
  }
}

//------------------------------------------------------------------------------
void Taker::Give(const vtkSmartPointer<vtkImageData>& band)
{
  std::unique_lock<std::mutex> lock(this->Mutex);
  this->Changed.wait(lock, [this] { return !this->Waiting || this->Thrown; });
  if (this->Thrown)
  {
    std::rethrow_exception(this->Thrown);
  }
  this->Waiting = band;
  this->Changed.notify_all();
}

//------------------------------------------------------------------------------
void Taker::Join(bool whole)
{
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->Waiting = whole ? this->Waiting : nullptr;
    this->Ended = true;
    this->Changed.notify_all();
  }
  if (this->Thread.joinable())
  {
    this->Thread.join();
  }
}

//------------------------------------------------------------------------------
void Taker::Finish()
{
  this->Join(true);
  if (this->Thrown)
  {
    std::rethrow_exception(this->Thrown);
  }
}

}
