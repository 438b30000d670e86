// SPDX-License-Identifier: BSD-2-Clause
// Log: warnings and notices for people, on standard error. The same text twice is printed once and
// counted. Thread-safe. A render owns one.
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
  enum class Sink { StandardError, Memory };    // Memory: kept for tests (Messages)

  explicit Log(Level level = Level::Normal, Sink sink = Sink::StandardError)
      : level_(level), sink_(sink) {}

  void Warning(const std::string& text, const std::optional<SourceLocation>& where = {},
               const std::string& hint = {});
  void Notice(const std::string& text, const std::optional<SourceLocation>& where = {},
              const std::string& hint = {});
  void Verbose(const std::string& text);  // printed only at Level::Verbose

  // Says how often repeated messages came; call once at the end.
  void Summarize();

  int WarningCount() const;
  std::vector<std::string> Messages() const;  // everything said, formatted (Sink::Memory)

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
