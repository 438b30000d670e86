// SPDX-License-Identifier: BSD-2-Clause
// How a diagnostic is laid out. Not who prints it (Log, or the program for an error that ends it).
#include "core/base/error.h"

#include <algorithm>

namespace exphoton {
namespace {

constexpr std::size_t kLineShown = 120;  // bytes of a long line that are shown round the column
constexpr std::size_t kLeadShown = 60;   // of these, at most before the column

std::string PlaceText(const SourceLocation& where) {
  std::string text = where.file;
  if (where.line > 0) text += ":" + std::to_string(where.line);
  if (where.line > 0 && where.column > 0) text += ":" + std::to_string(where.column);
  return text;
}

bool IsContinuationByte(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

// The line and below it a caret under the column. Tabs stay tabs in both, so that they line up; a
// byte that would disturb a terminal is shown as '?'; a long line is cut to what surrounds the
// column.
std::string LineWithCaret(const SourceLocation& where) {
  const std::string& line = where.lineText;
  const std::size_t column =
      std::min(where.column > 0 ? std::size_t(where.column - 1) : 0, line.size());
  std::size_t begin = 0, end = line.size();
  if (line.size() > kLineShown) {
    begin = column > kLeadShown ? column - kLeadShown : 0;
    end = std::min(begin + kLineShown, line.size());
    while (begin < column && IsContinuationByte(line[begin])) ++begin;
    while (end > column && end < line.size() && IsContinuationByte(line[end])) --end;
  }
  const bool isCutBefore = begin > 0, isCutAfter = end < line.size();
  std::string shown = isCutBefore ? "    ..." : "    ", caret = isCutBefore ? "       " : "    ";
  for (std::size_t i = begin; i < end; ++i) {
    const char c = line[i];
    const bool isControl = (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F;
    shown += isControl ? '?' : c;
    if (i < column && !IsContinuationByte(c)) caret += c == '\t' ? '\t' : ' ';
  }
  while (!isCutAfter && !shown.empty() && (shown.back() == ' ' || shown.back() == '?')) {
    shown.pop_back();  // of "\r\n"
  }
  return shown + (isCutAfter ? "...\n" : "\n") + caret + "^\n";
}

}  // namespace

std::string FormatDiagnostic(const std::string& severity, const std::string& text,
                             const std::optional<SourceLocation>& where, const std::string& hint) {
  const bool hasPlace = where && !where->file.empty();
  std::string result = (hasPlace ? PlaceText(*where) : "exphoton") + ": " + severity + ": " + text;
  if (result.back() != '\n') result += '\n';
  if (hasPlace) {
    if (where->line > 0 && !where->lineText.empty()) result += LineWithCaret(*where);
    for (auto from = where->includedFrom; from; from = from->includedFrom) {
      result += "    included from " + PlaceText(*from) + "\n";
    }
  }
  if (!hint.empty()) result += "    hint: " + hint + "\n";
  return result;
}

}  // namespace exphoton
