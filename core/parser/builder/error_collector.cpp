// SPDX-License-Identifier: BSD-2-Clause
// ErrorCollector keeps the errors of a file in the order in which they were found.
#include "core/parser/builder/error_collector.h"

#include <utility>

namespace exphoton {

void ErrorCollector::AddOfSyntax(const Error& error) {
  std::string key = error.what();
  if (const auto& where = error.Where())
    key +=
        " " + where->file + " " + std::to_string(where->line) + " " + std::to_string(where->column);
  Add(error, key);
}

void ErrorCollector::Add(const Error& error, const std::string& key) {
  if (!keys_.insert(key).second) return;
  errors_.push_back(error);
  if (errors_.size() < kMaxErrors) return;
  errors_.push_back(Error(ExitStatus::Scene, "too many errors: the rest of the file is not read"));
  throw *Take();
}

std::optional<Error> ErrorCollector::Take(const Error* last) {
  if (last && !keys_.contains(last->what())) errors_.push_back(*last);
  if (errors_.empty()) return std::nullopt;
  Error first = std::move(errors_.front());
  first.AddOthers({errors_.begin() + 1, errors_.end()});
  errors_.clear();
  return first;
}

}  // namespace exphoton
