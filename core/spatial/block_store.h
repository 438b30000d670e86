// SPDX-License-Identifier: BSD-2-Clause
// BlockStore holds records and converts them to blocks of points in place. Building a map of many
// points therefore takes no more memory than the finished map.
#pragma once

#include <new>

#include "core/spatial/point_block.h"
#include "core/spatial/record_store.h"

namespace exphoton {

template <class Block>
class BlockStore : public RecordStore<typename Block::Record> {
 public:
  using Record = typename Block::Record;
  static_assert(std::is_trivially_copyable_v<Block>);
  static_assert(sizeof(Block) == kBlockPoints * sizeof(Record));
  static_assert(alignof(Block) <= RecordStore<Record>::kAlignment);

  // Counts the written part only. Reserved pages that were never written take no physical memory.
  std::size_t MemoryBytes() const {
    return (this->Size() + kBlockPoints - 1) / kBlockPoints * sizeof(Block);
  }

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
};

}  // namespace exphoton
