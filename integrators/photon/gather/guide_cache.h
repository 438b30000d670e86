// SPDX-License-Identifier: BSD-2-Clause
// GuideCache keeps the cells of a GuideGrid that one thread has used lately. It is direct-mapped: a
// miss makes the cell and overwrites the slot. It suits gathers, because neighbouring pixels mostly
// gather in the same cells.
#pragma once

#include <vector>

#include "core/base/arena.h"
#include "integrators/photon/gather/guide_grid.h"

namespace exphoton {

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

}  // namespace exphoton
