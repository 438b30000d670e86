// SPDX-License-Identifier: BSD-2-Clause
// GuideTable is a hash table without locks. A thread publishes a finished cell by one exchange of a
// pointer. If two threads make the same cell, the second one drops its own, which is equal.
#include "integrators/photon/gather/guide_table.h"

namespace exphoton {

namespace {

// Requests all cache lines of the cell at once. Reading them one after the other would wait for
// each.
const GuideCell* Fetched(const GuideCell& cell) {
  constexpr std::size_t kCacheLine = 64 / sizeof(Real);
  const Real* const rows = cell.X();
  for (std::size_t i = 0; i < 4 * cell.RowLength(); i += kCacheLine) __builtin_prefetch(rows + i);
  return &cell;
}

}  // namespace

GuideTable::GuideTable(const GuideGrid& grid, std::size_t maxBytes, std::size_t slots)
    : grid_(grid), maxBytes_(maxBytes), slots_(slots) {}

GuideTable::~GuideTable() {
  for (const Slot& slot : slots_) delete slot.load(std::memory_order_relaxed);
}

const GuideCell* GuideTable::At(const Point3& p, Arena* scratch) {
  const GuideGrid::Key key = grid_.KeyOf(p);
  std::unique_ptr<const Entry> made;
  for (std::size_t i = key.Hash() % slots_.size();; i = (i + 1) % slots_.size()) {
    const Entry* found = slots_[i].load(std::memory_order_acquire);
    if (!found) {
      if (!made) {
        if (cells_.load(std::memory_order_relaxed) >= slots_.size() / 2 ||
            bytes_.load(std::memory_order_relaxed) >= maxBytes_)
          return nullptr;
        made = std::make_unique<const Entry>(Entry{key, grid_.MakeCell(key, scratch)});
      }
      if (slots_[i].compare_exchange_strong(found, made.get(), std::memory_order_acq_rel)) {
        cells_.fetch_add(1, std::memory_order_relaxed);
        bytes_.fetch_add(sizeof(Entry) + made->cell.MemoryBytes(), std::memory_order_relaxed);
        return &made.release()->cell;
      }
    }
    // Another thread may have filled the slot in the meantime, perhaps with this key.
    if (found->key == key) return Fetched(found->cell);
  }
}

}  // namespace exphoton
