// SPDX-License-Identifier: BSD-2-Clause
// BlockStore: memory for records that become blocks of points where they lie, so that building a
// map of many points takes no more memory than holding it.
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

template <class Block>
class BlockStore {
 public:
  using Record = typename Block::Record;
  static_assert(std::is_trivially_copyable_v<Block> && std::is_trivially_copyable_v<Record>);
  static_assert(sizeof(Block) <= kBlockPoints * sizeof(Record));

  BlockStore() = default;
  BlockStore(BlockStore&& other) noexcept
      : bytes_(std::move(other.bytes_)),
        count_(std::exchange(other.count_, 0)),
        capacity_(std::exchange(other.capacity_, 0)) {}
  BlockStore& operator=(BlockStore&& other) noexcept {
    bytes_ = std::move(other.bytes_);
    count_ = std::exchange(other.count_, 0);
    capacity_ = std::exchange(other.capacity_, 0);
    return *this;
  }

  std::size_t Size() const { return count_; }
  // What is written to; the rest of what was reserved takes no room in a machine's memory.
  std::size_t MemoryBytes() const {
    return (count_ + kBlockPoints - 1) / kBlockPoints * (kBlockPoints * sizeof(Record));
  }

  void Append(std::span<const Record> records) {
    const std::size_t before = count_;
    Resize(count_ + records.size());
    if (!records.empty()) std::memcpy(Raw() + before, records.data(), records.size_bytes());
  }
  // Records beyond those that there were are whatever memory holds: to be written before read.
  void Resize(std::size_t count) {
    if (count > capacity_) Reserve(std::max(2 * capacity_, count));
    count_ = count;
  }
  void Reserve(std::size_t count) {
    count = (count + kBlockPoints - 1) / kBlockPoints * kBlockPoints;
    if (count <= capacity_) return;
    Bytes larger(static_cast<std::byte*>(
        ::operator new(count * sizeof(Record), std::align_val_t(alignof(Block)))));
    if (count_ > 0) std::memcpy(larger.get(), bytes_.get(), count_ * sizeof(Record));
    bytes_ = std::move(larger);
    capacity_ = count;
  }

  std::span<Record> Records() { return {Raw(), count_}; }

  // From here on there are blocks, and records no more.
  void BecomeBlocks() {
    Record records[kBlockPoints];
    for (std::size_t begin = 0; begin < count_; begin += kBlockPoints) {
      const std::size_t count = std::min<std::size_t>(kBlockPoints, count_ - begin);
      std::memcpy(records, Raw() + begin, count * sizeof(Record));
      Block block;
      for (std::uint32_t lane = 0; lane < kBlockPoints; ++lane)
        block.Set(lane, records[std::min<std::size_t>(lane, count - 1)]);
      new (bytes_.get() + begin / kBlockPoints * sizeof(Block)) Block(block);
    }
  }
  const Block* Blocks() const { return reinterpret_cast<const Block*>(bytes_.get()); }

 private:
  struct Free {
    void operator()(std::byte* bytes) const {
      ::operator delete(bytes, std::align_val_t(alignof(Block)));
    }
  };
  using Bytes = std::unique_ptr<std::byte, Free>;

  Record* Raw() { return reinterpret_cast<Record*>(bytes_.get()); }

  Bytes bytes_;
  std::size_t count_ = 0, capacity_ = 0;  // records
};

}  // namespace exphoton
