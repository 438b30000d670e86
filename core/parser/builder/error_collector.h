// SPDX-License-Identifier: BSD-2-Clause
// ErrorCollector lets the loading of a scene go on after an error, so that one run reports all
// independent errors of a file.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/error.h"

namespace exphoton {

// DependentError is an error about a name or a block that an earlier part of the file lacks.
class DependentError : public Error {
 public:
  using Error::Error;
};

class ErrorCollector {
 public:
  static constexpr std::size_t kMaxErrors = 20;

  // Calls `work` and keeps an Error(Scene) or Error(File) that it throws. An error with the same
  // text as an earlier one is probably its consequence and is dropped. Other exceptions pass. After
  // kMaxErrors errors, throws them. Returns whether `work` succeeded.
  template <class Work>
  bool Try(const Work& work) {
    try {
      work();
      return true;
    } catch (const DependentError& error) {
      if (!dropsDependent_) Add(error, error.what());
      return false;
    } catch (const Error& error) {
      if (error.Status() != ExitStatus::Scene && error.Status() != ExitStatus::File) throw;
      Add(error, error.what());
      return false;
    }
  }
  // Keeps an error of the syntax, as Try does. Errors with the same text at other places count too.
  void AddOfSyntax(const Error& error);
  // Decides whether Try drops errors of the class DependentError, because text was lost on which
  // they may depend.
  void DropDependent(bool drops) { dropsDependent_ = drops; }
  bool IsEmpty() const { return errors_.empty(); }
  // Returns the first error, which carries the others; nullopt if there is none. `last`, if given,
  // is an error that ended the loading.
  std::optional<Error> Take(const Error* last = nullptr);

 private:
  void Add(const Error& error, const std::string& key);
  std::vector<Error> errors_;
  std::set<std::string> keys_;
  bool dropsDependent_ = false;
};

}  // namespace exphoton
