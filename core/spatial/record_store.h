// SPDX-License-Identifier: BSD-2-Clause
// RecordStore is a growing array of trivially copyable records. Unlike std::vector, it leaves new
// records uninitialised, so that the threads that fill them are the first to touch their memory.
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
  // Alignment of the first record: 64 bytes (one cache line), or 128 bytes if Real is double.
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
  // New records are uninitialised and must be written before they are read.
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
  // The capacity is a multiple of this.
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
