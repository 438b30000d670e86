// SPDX-License-Identifier: BSD-2-Clause
// FormatDiagnostic lays out a diagnostic. It does not print: Log prints warnings and notices, and
// the program prints the error that ends it.
#include "core/base/error.h"

#include <algorithm>
#include <string_view>

namespace exphoton {
namespace {

constexpr std::size_t kLineShown = 120;  // largest excerpt of a long line, in bytes
constexpr std::size_t kLeadShown = 60;   // largest part of the excerpt before the column

std::string PlaceText(const SourceLocation& where) {
  std::string text = where.file;
  if (where.line > 0) text += ":" + std::to_string(where.line);
  if (where.line > 0 && where.column > 0) text += ":" + std::to_string(where.column);
  return text;
}

bool IsContinuationByte(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

// Returns the line, and below it a caret under the column. Tabs are kept in both lines, so that
// they align. A control byte could disturb the terminal and is shown as '?'. A long line is cut to
// an excerpt around the column. The '\r' of a line end "\r\n" is left out.
std::string LineWithCaret(const SourceLocation& where) {
  std::string_view line = where.lineText;
  if (line.ends_with('\r')) line.remove_suffix(1);
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
  return shown + (isCutAfter ? "...\n" : "\n") + caret + "^\n";
}

}  // namespace

Error::Error(ExitStatus status, const std::string& text)
    : std::runtime_error(text), status_(status) {}

Error::Error(ExitStatus status, const std::string& text, SourceLocation where, std::string hint)
    : std::runtime_error(text), status_(status), where_(std::move(where)), hint_(std::move(hint)) {}

Error::Error(const Error& other) = default;
Error& Error::operator=(const Error& other) = default;
Error::~Error() = default;

void Error::AddOthers(const std::vector<Error>& others) {
  others_.insert(others_.end(), others.begin(), others.end());
}

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
