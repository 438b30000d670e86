// SPDX-License-Identifier: BSD-2-Clause
// ImportReport prints an entry when it is found. A named material is converted at each use, so
// equal entries of one place count once.
#include "core/app/import/import_report.h"

#include <algorithm>

namespace exphoton::cli {

bool ImportReport::Keep(const std::string& text, const SourceLocation& where) {
  std::string line = where.file + ":" + std::to_string(where.line) + ":" +
                     std::to_string(where.column) + ": " + text;
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  if (!known_.insert(line).second) return false;
  lines_.push_back(std::move(line));
  return true;
}

void ImportReport::Note(const std::string& text, const SourceLocation& where) {
  if (Keep(text, where)) log_.Notice(text, where);
}

void ImportReport::Replaced(const std::string& text, const SourceLocation& where) {
  if (!Keep(text, where)) return;
  ++replaced_;
  log_.Warning(text, where);
}

void ImportReport::LeftOut(const std::string& text, const SourceLocation& where) {
  if (!Keep(text, where)) return;
  ++leftOut_;
  log_.Warning(text, where);
}

std::string ImportReport::Comments() const {
  std::string text;
  for (const std::string& line : lines_) text += "#   " + line + "\n";
  return text;
}

std::string ImportReport::Summary() const {
  const auto part = [](int count, const char* what) {
    return std::to_string(count) + (count == 1 ? " thing is " : " things are ") + what;
  };
  return part(replaced_, "replaced by something similar") + ", and " + part(leftOut_, "left out");
}

}  // namespace exphoton::cli
