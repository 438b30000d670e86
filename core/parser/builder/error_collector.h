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
    } catch (const Error& error) {
      if (error.Status() != ExitStatus::Scene && error.Status() != ExitStatus::File) throw;
      Add(error);
      return false;
    }
  }
  bool IsEmpty() const { return errors_.empty(); }
  // Returns the first error, which carries the others; nullopt if there is none. `last`, if given,
  // is an error that ended the loading.
  std::optional<Error> Take(const Error* last = nullptr);

 private:
  void Add(const Error& error);

  std::vector<Error> errors_;
  std::set<std::string> texts_;
};

}  // namespace exphoton
