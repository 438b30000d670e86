// SPDX-License-Identifier: BSD-2-Clause
// Error: what is thrown while a scene loads, with the exit status it leads to, a place in a scene
// file and a hint. Nothing throws while rendering, except out of resources or under --strict.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace exphoton {

enum class ExitStatus { Ok = 0, CommandLine = 1, Scene = 2, File = 3, Resource = 4, Internal = 5 };

// A place in a scene file. line and column count from 1; column in bytes.
struct SourceLocation {
  std::string file;
  int line = 0, column = 0;
  std::string lineText;  // the offending line, for the caret; may be empty
  std::shared_ptr<const SourceLocation> includedFrom;
};

class Error : public std::runtime_error {
 public:
  Error(ExitStatus status, const std::string& text) : std::runtime_error(text), status_(status) {}
  Error(ExitStatus status, const std::string& text, SourceLocation where, std::string hint = {})
      : std::runtime_error(text),
        status_(status),
        where_(std::move(where)),
        hint_(std::move(hint)) {}

  ExitStatus Status() const { return status_; }
  const std::optional<SourceLocation>& Where() const { return where_; }
  const std::string& Hint() const { return hint_; }

 private:
  ExitStatus status_;
  std::optional<SourceLocation> where_;
  std::string hint_;
};

// "file:line:col: error: text" with the line, a caret, the include chain and the hint; or
// "exphoton: error: text" where there is no place. Ends in a newline.
std::string FormatDiagnostic(const std::string& severity, const std::string& text,
                             const std::optional<SourceLocation>& where, const std::string& hint);

}  // namespace exphoton
