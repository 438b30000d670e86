// SPDX-License-Identifier: BSD-2-Clause
// RecordStore: a growing array of plain records that, unlike a vector, does not write to what it
// grows by: threads fill it, and so it is they who first touch it.
#pragma once

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

#include "core/math/real.h"

namespace exphoton {

template <class Record>
class RecordStore {
 public:
  static_assert(std::is_trivially_copyable_v<Record>);
  // Of the first record: a line of the cache, two in double.
  static constexpr std::size_t kAlignment = 16 * sizeof(Real);

  RecordStore() = default;
  RecordStore(RecordStore&& other) noexcept
      : memory_(std::move(other.memory_)),
        count_(std::exchange(other.count_, 0)),
        capacity_(std::exchange(other.capacity_, 0)) {}
  RecordStore& operator=(RecordStore&& other) noexcept {
    memory_ = std::move(other.memory_);
    count_ = std::exchange(other.count_, 0);
    capacity_ = std::exchange(other.capacity_, 0);
    return *this;
  }

  std::size_t Size() const { return count_; }
  std::span<Record> Records() { return {memory_.get(), count_}; }
  const Record* Data() const { return memory_.get(); }

  void Append(std::span<const Record> records) {
    const std::size_t before = count_;
    Resize(count_ + records.size());
    if (!records.empty()) std::memcpy(memory_.get() + before, records.data(), records.size_bytes());
  }
  // Records beyond those that there were are whatever memory holds: to be written before read.
  void Resize(std::size_t count) {
    if (count > capacity_) Reserve(std::max(2 * capacity_, count));
    count_ = count;
  }
  void Reserve(std::size_t count) {
    count = (count + kUnit - 1) / kUnit * kUnit;
    if (count <= capacity_) return;
    Memory larger(
        static_cast<Record*>(::operator new(count * sizeof(Record), std::align_val_t(kAlignment))));
    if (count_ > 0) std::memcpy(larger.get(), memory_.get(), count_ * sizeof(Record));
    memory_ = std::move(larger);
    capacity_ = count;
  }

 private:
  // There is memory for a multiple of so many.
  static constexpr std::size_t kUnit = 16;

  struct Free {
    void operator()(Record* records) const {
      ::operator delete(records, std::align_val_t(kAlignment));
    }
  };
  using Memory = std::unique_ptr<Record[], Free>;

  Memory memory_;
  std::size_t count_ = 0, capacity_ = 0;
};

}  // namespace exphoton
