// SPDX-License-Identifier: BSD-2-Clause
// Error is the exception that loading a scene throws. It holds the exit status, an optional place
// in a scene file and a hint. Rendering throws only when resources run out or under --strict.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace exphoton {

enum class ExitStatus { Ok = 0, CommandLine = 1, Scene = 2, File = 3, Resource = 4, Internal = 5 };

// SourceLocation is a place in a scene file. Lines and columns count from 1; columns count bytes.
struct SourceLocation {
  std::string file;
  int line = 0, column = 0;
  std::string lineText;  // the offending line, printed above the caret; may be empty
  std::shared_ptr<const SourceLocation> includedFrom;
};

class Error : public std::runtime_error {
 public:
  Error(ExitStatus status, const std::string& text);
  Error(ExitStatus status, const std::string& text, SourceLocation where, std::string hint = {});
  Error(const Error& other);
  Error& operator=(const Error& other);
  ~Error() override;

  ExitStatus Status() const { return status_; }
  const std::optional<SourceLocation>& Where() const { return where_; }
  const std::string& Hint() const { return hint_; }

  // The errors that were found after this one, in the same file or run.
  const std::vector<Error>& Others() const { return others_; }
  void AddOthers(const std::vector<Error>& others);

 private:
  ExitStatus status_;
  std::optional<SourceLocation> where_;
  std::string hint_;
  std::vector<Error> others_;
};

// Returns "file:line:col: error: text", followed by the source line, a caret, the include chain and
// the hint. Without a place it returns "exphoton: error: text" and the hint. The result ends in a
// newline.
std::string FormatDiagnostic(const std::string& severity, const std::string& text,
                             const std::optional<SourceLocation>& where, const std::string& hint);

}  // namespace exphoton
