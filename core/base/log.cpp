// SPDX-License-Identifier: BSD-2-Clause
// Log formats, prints and counts warnings and notices.
#include "core/base/log.h"

#include <cstdio>

#include "core/base/terminal.h"

namespace exphoton {
namespace {

// Writes each message in one call, so that messages of several processes do not interleave. On a
// terminal it first erases a progress bar on the current line; the bar is redrawn below the
// message.
void Print(const std::string& message, const std::string& severity) {
  const std::string text = (IsRedrawable() ? "\r\x1b[K" : "") + Colored(message, severity);
  std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace

void Log::Warning(const std::string& text, const std::optional<SourceLocation>& where,
                  const std::string& hint) {
  Say("warning", text, where, hint);
}

void Log::Notice(const std::string& text, const std::optional<SourceLocation>& where,
                 const std::string& hint) {
  if (level_ != Level::Quiet) Say("note", text, where, hint);
}

void Log::Verbose(const std::string& text, const std::optional<SourceLocation>& where) {
  if (level_ == Level::Verbose) Say("note", text, where, {});
}

void Log::Say(const char* severity, const std::string& text,
              const std::optional<SourceLocation>& where, const std::string& hint) {
  const std::lock_guard lock(mutex_);
  const std::string kind = severity;
  if (kind == "warning") ++warnings_;
  if (++counts_[kind + ": " + text] > 1) return;
  const std::string message = FormatDiagnostic(kind, text, where, hint);
  messages_.push_back(message);
  if (sink_ == Sink::StandardError) Print(message, kind);
}

void Log::Summarize() {
  const std::lock_guard lock(mutex_);
  for (auto& [text, count] : counts_) {
    if (count < 2) continue;
    const std::string severity = text.substr(0, text.find(':'));
    const std::string message =
        "exphoton: " + text + " (" + std::to_string(count) + " times in all)\n";
    count = 1;
    if (sink_ == Sink::Memory) {
      messages_.push_back(message);
    } else {
      Print(message, severity);
    }
  }
}

int Log::WarningCount() const {
  const std::lock_guard lock(mutex_);
  return warnings_;
}

std::vector<std::string> Log::Messages() const {
  const std::lock_guard lock(mutex_);
  return messages_;
}

}  // namespace exphoton
