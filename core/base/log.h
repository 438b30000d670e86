// SPDX-License-Identifier: BSD-2-Clause
// Log prints warnings and notices for people to standard error. It prints a repeated message once
// and counts the repetitions. It is thread-safe. Each render owns one.
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"

namespace exphoton {

class Log {
 public:
  enum class Level { Quiet, Normal, Verbose };  // Quiet: warnings only
  enum class Sink { StandardError, Memory };    // Memory: for tests, see Messages

  explicit Log(Level level = Level::Normal, Sink sink = Sink::StandardError)
      : level_(level), sink_(sink) {}

  void Warning(const std::string& text, const std::optional<SourceLocation>& where = {},
               const std::string& hint = {});
  void Notice(const std::string& text, const std::optional<SourceLocation>& where = {},
              const std::string& hint = {});
  // Printed only at Level::Verbose.
  void Verbose(const std::string& text, const std::optional<SourceLocation>& where = {});

  // Prints how often each repeated message occurred. Call this once, at the end.
  void Summarize();

  int WarningCount() const;
  std::vector<std::string> Messages() const;  // all formatted messages (Sink::Memory)

 private:
  void Say(const char* severity, const std::string& text,
           const std::optional<SourceLocation>& where, const std::string& hint);

  Level level_;
  Sink sink_;
  mutable std::mutex mutex_;
  std::map<std::string, int> counts_;
  std::vector<std::string> messages_;
  int warnings_ = 0;
};

}  // namespace exphoton
