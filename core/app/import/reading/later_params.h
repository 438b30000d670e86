// SPDX-License-Identifier: BSD-2-Clause
// LaterParams reads the parameters of one directive of version 3 or 4. It remembers which of them
// were read, so that every other one is reported.
#pragma once

#include <initializer_list>
#include <set>
#include <string>

#include "core/app/import/import_report.h"
#include "core/params/param_set.h"

namespace exphoton::cli {

class LaterParams {
 public:
  // `subject` is for messages: Material "matte".
  LaterParams(const ParamSet& params, std::string subject, ImportReport& report)
      : params_(params), subject_(std::move(subject)), report_(report) {}

  // Each Take marks the parameter as read. They throw Error(Scene) for values of another kind.
  const ParsedParam* Take(const std::string& name);  // null if absent
  double TakeNumber(const std::string& name, double fallback);
  bool TakeBool(const std::string& name, bool fallback);
  std::string TakeString(const std::string& name, const std::string& fallback);
  // Marks parameters that do not change the picture.
  void Ignore(std::initializer_list<const char*> names);

  bool Has(const std::string& name) const { return params_.Find(name) != nullptr; }
  // Reports all parameters that were not read.
  void ReportRest();

  void Note(const std::string& text) const { report_.Note(subject_ + " " + text, Where()); }
  void Replaced(const std::string& text) const { report_.Replaced(subject_ + " " + text, Where()); }
  // Reports a parameter that was read, but has no equivalent.
  void LeftOut(const ParsedParam& param, const std::string& reason = "") const;
  void Replaced(const ParsedParam& param, const std::string& text) const;

  const SourceLocation& Where() const { return params_.where; }
  const std::string& Subject() const { return subject_; }
  ImportReport& Report() const { return report_; }

 private:
  const ParamSet& params_;
  std::string subject_;
  ImportReport& report_;
  std::set<std::string> taken_;
};

}  // namespace exphoton::cli
