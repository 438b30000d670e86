// SPDX-License-Identifier: BSD-2-Clause
// BlockOrder sorts records so that every aligned run of 16, 256, 4096 ... records is spatially
// compact. It splits near the median along the longest axis, as a k-d tree does (Bentley 1975).
// A span is split at a multiple of the longest of these lengths that is shorter than the span, so
// only the last run of a length may be short.
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
  // Called for each sorted piece with its records, the index of its set, and the index of its first
  // record in the set.
  using Finish = std::function<void(std::span<Record>, std::size_t set, std::size_t begin)>;

  // Record::p is the position and must be finite.
  static void Sort(std::span<Record> records, ThreadPool& threads) {
    Sort({&records, 1}, threads, [](std::span<Record>, std::size_t, std::size_t) {});
  }
  // Sorts several sets, each by itself, at the same time: the first splits of a single set offer
  // too little work for all threads. finish is called once for every piece of a set, from any
  // thread. A piece may be empty. It begins at a multiple of kBlockPoints and ends at a multiple or
  // at the end of the set.
  static void Sort(std::span<const std::span<Record>> sets, ThreadPool& threads,
                   const Finish& finish) {
    // Enough pieces for many threads. One set of 64 pieces needs 6 rounds.
    constexpr std::size_t kMinPieces = 64;
    std::vector<Piece> pieces;
    for (std::size_t set = 0; set < sets.size(); ++set) pieces.push_back({sets[set], set, 0});
    for (int round = 0; pieces.size() < kMinPieces && round < 6; ++round) {
      std::vector<Piece> halves(2 * pieces.size());
      threads.For(std::int64_t(pieces.size()), [&](std::int64_t i, int) {
        const auto& [records, set, begin] = pieces[i];
        const std::size_t split = Split(records);
        halves[2 * i] = {records.first(split), set, begin};
        halves[2 * i + 1] = {records.subspan(split), set, begin + split};
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
      const std::size_t split = Split(records);
      SortPiece(records.first(split));
      records = records.subspan(split);
    }
  }

  // Partitions the records near their median, at a multiple of the longest of the lengths 16, 256,
  // 4096 ... that is shorter than the span. Returns the index of the split.
  static std::size_t Split(std::span<Record> records) {
    if (records.size() <= kBlockPoints) return records.size();
    std::size_t run = kBlockPoints;
    while (run * kBlockPoints < records.size()) run *= kBlockPoints;
    const std::size_t split = (records.size() + run - 1) / run / 2 * run;
    Bounds3 bounds;
    for (const Record& record : records) bounds.Extend(record.p);
    const int axis = MaxDimension(bounds.Diagonal());
    std::nth_element(records.begin(), records.begin() + std::ptrdiff_t(split), records.end(),
                     [axis](const Record& a, const Record& b) { return a.p[axis] < b.p[axis]; });
    return split;
  }
};

}  // namespace exphoton
