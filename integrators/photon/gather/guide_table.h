// SPDX-License-Identifier: BSD-2-Clause
// GuideTable keeps the cells of a GuideGrid for a whole pass. All threads share it, because the
// vertices of paths scatter over the scene. A cell is made when a path first asks for it. Cells
// depend on their keys alone, so it does not matter which thread makes them, or in which order.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "integrators/photon/gather/guide_grid.h"

namespace exphoton {

class GuideTable {
 public:
  // Keeps at most `maxBytes` of cells.
  explicit GuideTable(const GuideGrid& grid, std::size_t maxBytes = kMaxBytes);
  ~GuideTable();
  GuideTable(const GuideTable&) = delete;
  GuideTable& operator=(const GuideTable&) = delete;

  const GuideGrid& Grid() const { return grid_; }
  // Returns the cell that contains p, or null if the table is full and does not hold it. The cell
  // is valid as long as the table. Any number of threads may call this.
  const GuideCell* At(const Point3& p, Arena* scratch);

  std::size_t CellCount() const { return cells_.load(std::memory_order_relaxed); }
  std::size_t MemoryBytes() const {
    return bytes_.load(std::memory_order_relaxed) + kSlots * sizeof(Slot);
  }

 private:
  static constexpr std::size_t kMaxBytes = std::size_t(1) << 28;
  static constexpr std::size_t kSlots = std::size_t(1) << 18;
  static constexpr std::size_t kMaxCells = kSlots / 2;  // keeps probe sequences short

  struct Entry {
    GuideGrid::Key key;
    GuideCell cell;
  };
  using Slot = std::atomic<const Entry*>;

  GuideGrid grid_;
  std::size_t maxBytes_;
  std::vector<Slot> slots_;  // open addressing with linear probing; entries are never removed
  std::atomic<std::size_t> cells_{0}, bytes_{0};
};

}  // namespace exphoton
