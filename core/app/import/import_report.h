// SPDX-License-Identifier: BSD-2-Clause
// ImportReport lists everything of a scene of version 3 or 4 that the converted scene expresses
// otherwise. It prints each entry with its place, and keeps all of them for the head of the file.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/log.h"

namespace exphoton::cli {

class ImportReport {
 public:
  explicit ImportReport(Log& log) : log_(log) {}

  // The picture stays the same, up to its noise.
  void Note(const std::string& text, const SourceLocation& where);
  // The picture changes: something similar takes the place of what the scene describes.
  void Replaced(const std::string& text, const SourceLocation& where);
  // The picture changes: nothing takes its place.
  void LeftOut(const std::string& text, const SourceLocation& where);

  bool IsExact() const { return replaced_ + leftOut_ == 0; }
  // Returns the entries as comment lines for the scene, in the order in which they were found.
  std::string Comments() const;
  // Returns a sentence for the end: "3 things were replaced and 1 was left out".
  std::string Summary() const;

 private:
  // Returns whether the entry is new.
  bool Keep(const std::string& text, const SourceLocation& where);

  Log& log_;
  std::set<std::string> known_;
  std::vector<std::string> lines_;
  int replaced_ = 0, leftOut_ = 0;
};

}  // namespace exphoton::cli
