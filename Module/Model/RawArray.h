// SPDX-License-Identifier: BSD-3-Clause
#ifndef RawArray_h
#define RawArray_h

#include "LargePages.h"
#include "ReservedMemory.h"

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace relief
{

/// Room for many numbers, of no value until they are written: so the threads that write them touch
/// the memory first, each its own part. Begins at a cache line.
template <class T>
class RawArray
{
  static_assert(std::is_trivially_destructible_v<T> && std::is_trivially_copyable_v<T>);

public:
  RawArray() = default;
  RawArray(RawArray&& other) noexcept { this->Swap(other); }
  RawArray& operator=(RawArray&& other) noexcept
  {
    this->Swap(other);
    return *this;
  }

  /// Makes room for so many numbers, of which none keeps its value; none gives all of it back. Room
  /// of that size is used again.
  void Allocate(std::size_t count)
  {
    if (count != this->Count || this->IsReserved())
    {
      this->GiveBack(); // first, so that never both take memory
      if (count > 0)
      {
        // Large ones have their pages to themselves, and get large ones.
        const std::size_t begin = count * sizeof(T) < LargePage ? Line : LargePage;
        const std::size_t bytes = (count * sizeof(T) + begin - 1) / begin * begin;
        std::size_t space = bytes + begin;
        this->Room = Owner(static_cast<unsigned char*>(::operator new(space)));
        void* first = this->Room.get();
        this->Values = static_cast<T*>(std::align(begin, bytes, first, space));
        UseLargePages(this->Values, bytes);
      }
      this->Count = count;
    }
  }

  /// Makes room for so many numbers, all 0, that takes memory only where it is written. Returns
  /// whether the system has any.
  bool Reserve(std::size_t count)
  {
    this->GiveBack();
    if (count > 0)
    {
      const std::size_t bytes = count * sizeof(T);
      void* room = ReserveMemory(bytes);
      if (!room)
      {
        return false;
      }
      this->Room = Owner(static_cast<unsigned char*>(room), Free{ bytes });
      this->Values = static_cast<T*>(room);
      this->Count = count;
    }
    return true;
  }

  /// Whether the room takes memory only where it is written.
  bool IsReserved() const { return this->Room.get_deleter().reserved > 0; }

  /// Forgets the numbers [begin, end) of reserved room, as far as they fill pages: these are 0
  /// again.
  void Forget(std::size_t begin, std::size_t end)
  {
    ForgetMemory(this->Values + begin, (end - begin) * sizeof(T));
  }

  /// Asks for large pages for the numbers [begin, end) of reserved room, which are to be filled
  /// all.
  void Enlarge(std::size_t begin, std::size_t end)
  {
    UseLargePages(this->Values + begin, (end - begin) * sizeof(T));
  }

  /// How many bytes of reserved room take memory; all of it elsewhere.
  std::size_t CountResident() const
  {
    const std::size_t bytes = this->Count * sizeof(T);
    return this->IsReserved() ? CountResidentMemory(this->Values, bytes) : bytes;
  }

  std::size_t size() const { return this->Count; }
  bool empty() const { return this->Count == 0; }
  T* data() { return this->Values; }
  const T* data() const { return this->Values; }
  T& operator[](std::size_t at) { return this->Values[at]; }
  const T& operator[](std::size_t at) const { return this->Values[at]; }

private:
  void Swap(RawArray& other) noexcept
  {
    std::swap(this->Room, other.Room);
    std::swap(this->Values, other.Values);
    std::swap(this->Count, other.Count);
  }

  void GiveBack()
  {
    this->Count = 0;
    this->Values = nullptr;
    this->Room = Owner();
  }

  static constexpr std::size_t Line = 64; // bytes
  struct Free
  {
    std::size_t reserved = 0; // bytes, of reserved room

    void operator()(unsigned char* room) const
    {
      if (this->reserved > 0)
      {
        ReleaseMemory(room, this->reserved);
      }
      else
      {
        ::operator delete(room);
      }
    }
  };
  using Owner = std::unique_ptr<unsigned char, Free>;
  Owner Room;
  T* Values = nullptr;
  std::size_t Count = 0;
};

}

#endif
