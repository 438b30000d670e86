// SPDX-License-Identifier: BSD-2-Clause
// SortIntoBlocks: puts records into an order in which every aligned run of 16, 256, 4096 ... lies
// close together: medians along the longest side, as in a k-d tree (Bentley 1975), at multiples of
// these lengths. Only the last run of a length may be short.
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/math/bounds.h"
#include "core/spatial/point_block.h"

namespace exphoton {

template <class Record>
class BlockOrder {
 public:
  // Calls for records that are in their order: of which set, and from where in it.
  using Finish = std::function<void(std::span<Record>, std::size_t set, std::size_t begin)>;

  // Record::p is a position, and finite.
  static void Sort(std::span<Record> records, ThreadPool& threads) {
    Sort({&records, 1}, threads, [](std::span<Record>, std::size_t, std::size_t) {});
  }
  // Several sets, each for itself; at once, because the first step of each is no work for several
  // threads. finish is called once for every piece of a set, from any thread; a piece begins at a
  // multiple of kBlockPoints, and ends at one or at the end of the set.
  static void Sort(std::span<const std::span<Record>> sets, ThreadPool& threads,
                   const Finish& finish) {
    constexpr std::size_t kEnough = 64;  // pieces
    std::vector<Piece> pieces;
    for (std::size_t set = 0; set < sets.size(); ++set) pieces.push_back({sets[set], set, 0});
    for (int round = 0; pieces.size() < kEnough && round < 6; ++round) {
      std::vector<Piece> halves(2 * pieces.size());
      threads.For(std::int64_t(pieces.size()), [&](std::int64_t i, int) {
        const auto& [records, set, begin] = pieces[i];
        const std::size_t middle = Split(records);
        halves[2 * i] = {records.first(middle), set, begin};
        halves[2 * i + 1] = {records.subspan(middle), set, begin + middle};
      });
      pieces = std::move(halves);
    }
    threads.For(std::int64_t(pieces.size()), [&](std::int64_t i, int) {
      const auto& [records, set, begin] = pieces[i];
      SortPiece(records);
      finish(records, set, begin);
    });
  }

 private:
  struct Piece {
    std::span<Record> records;
    std::size_t set = 0, begin = 0;
  };

  static void SortPiece(std::span<Record> records) {
    while (records.size() > kBlockPoints) {
      const std::size_t middle = Split(records);
      SortPiece(records.first(middle));
      records = records.subspan(middle);
    }
  }

  // Parts the records at a multiple of the longest run that is shorter than they; gives the place.
  static std::size_t Split(std::span<Record> records) {
    if (records.size() <= kBlockPoints) return records.size();
    std::size_t run = kBlockPoints;
    while (run * kBlockPoints < records.size()) run *= kBlockPoints;
    const std::size_t middle = (records.size() + run - 1) / run / 2 * run;
    Bounds3 bounds;
    for (const Record& record : records) bounds.Extend(record.p);
    const int axis = MaxDimension(bounds.Diagonal());
    std::nth_element(records.begin(), records.begin() + std::ptrdiff_t(middle), records.end(),
                     [axis](const Record& a, const Record& b) { return a.p[axis] < b.p[axis]; });
    return middle;
  }
};

}  // namespace exphoton
