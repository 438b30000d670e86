// SPDX-License-Identifier: BSD-2-Clause
// NonFiniteLog keeps descriptions of the first few non-finite camera samples. The selection does
// not depend on threads or tiles.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <tuple>
#include <vector>

#include "core/files/byte_archive.h"
#include "core/math/vec.h"

namespace exphoton {

// Keeps the dropped samples that come first in scanline order, regardless of the order of Add.
class NonFiniteLog {
 public:
  void Add(Point2i pixel, std::int64_t index, std::string text) {
    const std::lock_guard lock(mutex_);
    reports_.emplace(std::tuple(pixel.y, pixel.x, index), std::move(text));
    if (reports_.size() > kKept) reports_.erase(std::prev(reports_.end()));
  }
  std::vector<std::string> Texts() const {
    std::vector<std::string> texts;
    for (const auto& report : reports_) texts.push_back(report.second);
    return texts;
  }

  // Saves the descriptions, or adds saved ones.
  void Transfer(ByteArchive* archive) {
    const std::lock_guard lock(mutex_);
    auto report = reports_.begin();
    for (std::size_t left = archive->Count(reports_.size(), 24); left > 0; --left) {
      std::tuple<int, int, std::int64_t> key;
      std::string text;
      if (!archive->IsLoading()) std::tie(key, text) = *report++;
      archive->Values(&std::get<0>(key), &std::get<1>(key), &std::get<2>(key));
      archive->Text(&text);
      if (archive->IsLoading()) reports_.emplace(key, text);
      if (reports_.size() > kKept) reports_.erase(std::prev(reports_.end()));
    }
  }

 private:
  static constexpr std::size_t kKept = 8;

  std::mutex mutex_;
  std::map<std::tuple<int, int, std::int64_t>, std::string> reports_;
};

}  // namespace exphoton
