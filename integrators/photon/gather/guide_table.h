// SPDX-License-Identifier: BSD-2-Clause
// GuideTable and GuideCache keep cells of a GuideGrid. A table keeps all cells of all threads, as
// long as the photons stay the same. A cache holds the cells that one thread has used lately, for
// the case that the table is full.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "integrators/photon/gather/guide_grid.h"

namespace exphoton {

// GuideCache is direct-mapped: a miss makes the cell and overwrites the slot.
class GuideCache {
 public:
  explicit GuideCache(const GuideGrid& grid) : grid_(grid), slots_(kSlots) {}

  // Returns the cell that contains p. It is valid until the next call.
  const GuideCell& At(const Point3& p) {
    const GuideGrid::Key key = grid_.KeyOf(p);
    Slot& slot = slots_[key.Hash() % kSlots];
    if (!slot.isUsed || !(slot.key == key)) {
      slot.cell = grid_.MakeCell(key, &scratch_);
      slot.key = key;
      slot.isUsed = true;
    }
    return slot.cell;
  }

 private:
  struct Slot {
    GuideGrid::Key key;
    bool isUsed = false;
    GuideCell cell;
  };
  static constexpr std::size_t kSlots = 256;

  GuideGrid grid_;
  std::vector<Slot> slots_;
  Arena scratch_;
};

// GuideTable makes a cell when a gather or a path first asks for it. Cells depend on their keys
// alone, so it does not matter which thread makes them, or in which order.
class GuideTable {
 public:
  // Keeps at most `maxBytes` of cells, and at most slots / 2 cells.
  explicit GuideTable(const GuideGrid& grid, std::size_t maxBytes = kMaxBytes,
                      std::size_t slots = kSlots);
  ~GuideTable();
  GuideTable(const GuideTable&) = delete;
  GuideTable& operator=(const GuideTable&) = delete;

  const GuideGrid& Grid() const { return grid_; }
  // Returns the cell that contains p, or null if the table is full and does not hold it. The cell
  // is valid as long as the table. Any number of threads may call this.
  const GuideCell* At(const Point3& p, Arena* scratch);

  std::size_t CellCount() const { return cells_.load(std::memory_order_relaxed); }
  std::size_t MemoryBytes() const {
    return bytes_.load(std::memory_order_relaxed) + slots_.size() * sizeof(Slot);
  }

 private:
  static constexpr std::size_t kMaxBytes = std::size_t(1) << 28;
  static constexpr std::size_t kSlots = std::size_t(1) << 18;

  struct Entry {
    GuideGrid::Key key;
    GuideCell cell;
  };
  using Slot = std::atomic<const Entry*>;

  GuideGrid grid_;
  std::size_t maxBytes_;
  // Open addressing with linear probing; entries are never removed. Half of the slots stay free, so
  // that probe sequences are short.
  std::vector<Slot> slots_;
  std::atomic<std::size_t> cells_{0}, bytes_{0};
};

}  // namespace exphoton
