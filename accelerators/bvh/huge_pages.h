// SPDX-License-Identifier: BSD-2-Clause
// HugePageVector is a vector whose memory uses huge pages where the system has them. It is for
// arrays with random access: with small pages almost every read would miss the TLB.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <new>
#include <vector>

namespace exphoton {

template <class T>
struct HugePageAllocator {
  using value_type = T;

  HugePageAllocator() = default;
  template <class U>
  HugePageAllocator(const HugePageAllocator<U>&) {}

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes < kPage) return static_cast<T*>(::operator new(bytes, kSmall));
    void* memory = ::operator new(bytes, kLarge);
    madvise(memory, bytes, MADV_HUGEPAGE);  // only a hint: a refusal does no harm
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) {
    ::operator delete(memory, count * sizeof(T) < kPage ? kSmall : kLarge);
  }
  friend bool operator==(const HugePageAllocator&, const HugePageAllocator&) { return true; }

 private:
  static constexpr std::size_t kPage = std::size_t(1) << 21;
  static constexpr auto kLarge = std::align_val_t(kPage);
  // The alignment is at least one cache line.
  static constexpr auto kSmall = std::align_val_t(alignof(T) < 64 ? 64 : alignof(T));
};

// RawHugePageAllocator leaves numbers uninitialised on resize. It is for arrays that threads fill.
template <class T>
struct RawHugePageAllocator : HugePageAllocator<T> {
  RawHugePageAllocator() = default;
  template <class U>
  RawHugePageAllocator(const RawHugePageAllocator<U>&) {}
  template <class U>
  void construct(U* place) {
    ::new (static_cast<void*>(place)) U;
  }
};

template <class T>
using UninitializedHugePageVector = std::vector<T, RawHugePageAllocator<T>>;
template <class T>
using HugePageVector = std::vector<T, HugePageAllocator<T>>;

}  // namespace exphoton
