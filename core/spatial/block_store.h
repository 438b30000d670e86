// SPDX-License-Identifier: BSD-2-Clause
// RecordStore is a growing array of records, or refers to records that exist. BlockStore is a
// RecordStore that converts its records to blocks of points in place. Building a map of many points
// therefore takes no more memory than the finished map.
#pragma once

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

#include "core/spatial/point_block.h"

namespace exphoton {

// RecordStore holds trivially copyable records. Unlike std::vector, it leaves new records
// uninitialised, so that the threads that fill them are the first to touch their memory.
template <class Record>
class RecordStore {
 public:
  static_assert(std::is_trivially_copyable_v<Record>);
  // Alignment of the first record: 64 bytes (one cache line), or 128 bytes if Real is double.
  static constexpr std::size_t kAlignment = 16 * sizeof(Real);

  RecordStore() = default;
  // Refers to `count` records that `owner` keeps. They must be aligned to kAlignment, must not be
  // changed, and fill whole units of kUnit records.
  RecordStore(const void* records, std::size_t count, std::shared_ptr<const void> owner)
      : memory_(static_cast<Record*>(const_cast<void*>(records)), Free{std::move(owner)}),
        count_(count),
        capacity_((count + kUnit - 1) / kUnit * kUnit) {}
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
    std::shared_ptr<const void> owner;  // null: the memory belongs to this store
    void operator()(Record* records) const {
      if (!owner) ::operator delete(records, std::align_val_t(kAlignment));
    }
  };
  using Memory = std::unique_ptr<Record[], Free>;

  Memory memory_;
  std::size_t count_ = 0, capacity_ = 0;
};

template <class Block>
class BlockStore : public RecordStore<typename Block::Record> {
 public:
  using Record = typename Block::Record;
  using RecordStore<Record>::RecordStore;
  static_assert(std::is_trivially_copyable_v<Block>);
  static_assert(sizeof(Block) == kBlockPoints * sizeof(Record));
  static_assert(alignof(Block) <= RecordStore<Record>::kAlignment);

  // Counts the written part only. Reserved pages that were never written take no physical memory.
  std::size_t MemoryBytes() const { return BlockCount() * sizeof(Block); }

  // Converts the records [begin, end) to blocks in place; they can no longer be read as records.
  // `begin` is a multiple of kBlockPoints; `end` is a multiple or the end of the store. Threads may
  // convert disjoint ranges concurrently.
  void BecomeBlocks(std::size_t begin, std::size_t end) {
    Record records[kBlockPoints];
    for (; begin < end; begin += kBlockPoints) {
      const std::size_t count = std::min<std::size_t>(kBlockPoints, end - begin);
      Record* const place = this->Records().data() + begin;
      std::memcpy(records, place, count * sizeof(Record));
      Block block;
      for (std::uint32_t lane = 0; lane < kBlockPoints; ++lane)
        block.Set(lane, records[std::min<std::size_t>(lane, count - 1)]);
      new (static_cast<void*>(place)) Block(block);
    }
  }
  const Block* Blocks() const { return reinterpret_cast<const Block*>(this->Data()); }
  std::size_t BlockCount() const { return (this->Size() + kBlockPoints - 1) / kBlockPoints; }
  // Returns the memory of all blocks, once all records are converted.
  std::span<const std::byte> Bytes() const {
    return {reinterpret_cast<const std::byte*>(this->Data()), BlockCount() * sizeof(Block)};
  }
};

}  // namespace exphoton
