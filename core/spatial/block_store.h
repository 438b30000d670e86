// SPDX-License-Identifier: BSD-2-Clause
// BlockStore: memory for records that become blocks of points where they lie, so that building a
// map of many points takes no more memory than holding it.
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

  // What is written to; the rest of what was reserved takes no room in a machine's memory.
  std::size_t MemoryBytes() const {
    return (this->Size() + kBlockPoints - 1) / kBlockPoints * sizeof(Block);
  }

  // From here on the records from `begin`, a multiple of kBlockPoints, to `end`, another or the end
  // of all, are blocks, and records no more. Threads may do so with different ones.
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
