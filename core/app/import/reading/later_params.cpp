// SPDX-License-Identifier: BSD-2-Clause
// LaterParams finds parameters by name only: versions 3 and 4 use several types for one meaning.
#include "core/app/import/reading/later_params.h"

namespace exphoton::cli {
namespace {

[[noreturn]] void FailKind(const ParsedParam& param, const std::string& subject, const char* kind) {
  throw Error(ExitStatus::Scene,
              "parameter \"" + param.name + "\" of " + subject + " takes " + kind, param.where);
}

}  // namespace

const ParsedParam* LaterParams::Take(const std::string& name) {
  taken_.insert(name);
  return params_.Find(name);
}

double LaterParams::TakeNumber(const std::string& name, double fallback) {
  const ParsedParam* param = Take(name);
  if (!param) return fallback;
  if (param->numbers.size() != 1) FailKind(*param, subject_, "one number");
  return param->numbers[0];
}

bool LaterParams::TakeBool(const std::string& name, bool fallback) {
  const ParsedParam* param = Take(name);
  if (!param) return fallback;
  if (param->strings.size() != 1 || (param->strings[0] != "true" && param->strings[0] != "false"))
    FailKind(*param, subject_, "true or false");
  return param->strings[0] == "true";
}

std::string LaterParams::TakeString(const std::string& name, const std::string& fallback) {
  const ParsedParam* param = Take(name);
  if (!param) return fallback;
  if (param->strings.size() != 1) FailKind(*param, subject_, "one string");
  return param->strings[0];
}

void LaterParams::Ignore(std::initializer_list<const char*> names) {
  for (const char* name : names) taken_.insert(name);
}

void LaterParams::ReportRest() {
  for (const ParsedParam& param : params_.All()) {
    // A parameter that Attribute gives in advance is not meant for every directive.
    const bool isOwn = param.where.file == Where().file && param.where.line >= Where().line;
    if (isOwn && !taken_.contains(param.name)) LeftOut(param);
  }
}

void LaterParams::LeftOut(const ParsedParam& param, const std::string& reason) const {
  report_.LeftOut(subject_ + ": parameter \"" + param.name + "\" is left out" +
                      (reason.empty() ? "" : ": " + reason),
                  param.where);
}

void LaterParams::Replaced(const ParsedParam& param, const std::string& text) const {
  report_.Replaced(subject_ + ": parameter \"" + param.name + "\" " + text, param.where);
}

}  // namespace exphoton::cli
