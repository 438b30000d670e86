// SPDX-License-Identifier: BSD-2-Clause
// ParamTableBase: matches the parameters of a scene file with their declarations and reports
// unknown parameters.
#include "core/params/param_table.h"

#include <algorithm>
#include <filesystem>

#include "core/base/log.h"
#include "core/params/param_reader.h"
#include "core/params/scene_path.h"
#include "core/params/suggestions.h"

namespace exphoton {
namespace {

bool Contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

const ParsedParam* FindWithOverrides(const std::string& name, const ParamSet& params,
                                     const BindContext& context) {
  if (context.overrides) {
    if (const ParsedParam* param = context.overrides->Find(name)) return param;
  }
  return params.Find(name);
}

std::optional<SourceLocation> Place(const SourceLocation& where) {
  return where.file.empty() ? std::optional<SourceLocation>() : where;
}

// Further unknown parameters of a directive are counted, not listed, because exporters and damaged
// files can have very many.
constexpr int kMaxUnknownListed = 10;

void ReportUnknown(const ParsedParam& param, const std::vector<std::string>& known,
                   const BindContext& context) {
  if (context.siblingNames && Contains(context.siblingNames(), param.name)) {
    if (context.log) {
      context.log->Notice("parameter \"" + param.name + "\" does not apply to " + context.what +
                              "; another plugin of this kind has it",
                          Place(param.where));
    }
    return;
  }
  const std::string text = "unknown parameter \"" + param.name + "\" of " + context.what;
  std::string hint = DidYouMean(param.name, known);
  if (hint.empty() && known.empty()) hint = context.what + " has no parameters";
  if (context.isStrict) throw Error(ExitStatus::Scene, text, param.where, hint);
  if (context.log) context.log->Warning(text, Place(param.where), hint);
}

// Returns whether a parameter of the wrong type keeps its default, as in pbrt-v1, which looks up
// parameters by name and type. Warns of it.
bool IsLeftAtDefault(const ParamDecl& decl, const ParsedParam& param, const BindContext& context) {
  const bool isLenient = !context.isStrict && !decl.isRequired;
  if (!isLenient || ParamReader(decl, param, context).HasAcceptedType()) return false;
  const std::string type(AcceptedTypes(decl.type)[0]);
  if (context.log) {
    context.log->Warning("parameter \"" + decl.name + "\" of " + context.what +
                             " keeps its default: it must be of type \"" + type + "\", not \"" +
                             param.type + '"',
                         Place(param.where), "write \"" + type + ' ' + decl.name + '"');
  }
  return true;
}

}  // namespace

ParamTableBase::~ParamTableBase() = default;

ParamDraft::~ParamDraft() = default;

ParamDraft::ParamDraft(const char* name, const ParamMember& paramMember, const char* doc)
    : member(&paramMember) {
  decl.name = name;
  decl.doc = doc;
  decl.type = member->type;
  if (member->type == ParamType::Integer) {
    decl.lowest = member->lowest;
    decl.highest = member->highest;
  }
}

void ParamTableBase::Add(const ParamDraft& draft, const void* defaults, std::ptrdiff_t offset) {
  AddSlot(draft.decl, {offset, draft.member, draft.choiceValues}, defaults);
}

void ParamTableBase::AddBase(const ParamTableBase& base, const void* defaults,
                             std::ptrdiff_t offset) {
  for (std::size_t i = 0; i < base.slots_.size(); ++i) {
    Slot slot = base.slots_[i];
    slot.offset += offset;
    AddSlot(base.declarations_[i], std::move(slot), defaults);
  }
  AddRemoved(base.removed_);
}

void ParamTableBase::AddRemoved(const std::vector<RemovedParam>& removed) {
  removed_.insert(removed_.end(), removed.begin(), removed.end());
}

void ParamTableBase::AddSlot(ParamDecl decl, Slot slot, const void* defaults) {
  const void* member = static_cast<const char*>(defaults) + slot.offset;
  if (slot.member->choice) {
    const auto& values = slot.choiceValues;
    const auto found = std::find(values.begin(), values.end(), slot.member->choice(member));
    decl.defaultText =
        found == values.end() ? "" : '"' + decl.choices[std::size_t(found - values.begin())] + '"';
  } else {
    decl.defaultText = slot.member->text(member);
  }
  declarations_.push_back(std::move(decl));
  slots_.push_back(std::move(slot));
}

void ParamTableBase::Assign(std::size_t i, const ParsedParam& param, const BindContext& context,
                            void* settings) const {
  const Slot& slot = slots_[i];
  std::any value = ParamReader(declarations_[i], param, context).Read();
  if (slot.member->choice) value = slot.choiceValues[std::size_t(std::any_cast<int>(value))];
  slot.member->assign(static_cast<char*>(settings) + slot.offset, value);
}

void ParamTableBase::RefuseRemoved(const std::string& name, const std::string& what,
                                   const SourceLocation& where) const {
  for (const RemovedParam& removed : removed_) {
    if (removed.name != name) continue;
    throw Error(
        ExitStatus::Scene,
        "parameter \"" + name + "\" of " + what + " no longer exists: " + removed.replacement,
        where, removed.hint);
  }
}

void ParamTableBase::BindValues(const ParamSet& params, const BindContext& context,
                                void* settings) const {
  for (const ParsedParam& param : params.All())
    RefuseRemoved(param.name, context.what, param.where);
  std::vector<std::string> known;
  for (const ParamDecl& decl : declarations_) known.push_back(decl.name);
  int unknown = 0;
  for (const ParsedParam& param : params.All()) {
    if (Contains(known, param.name)) continue;
    if (++unknown <= kMaxUnknownListed || context.isStrict) ReportUnknown(param, known, context);
  }
  if (unknown > kMaxUnknownListed && context.log)
    context.log->Warning(
        std::to_string(unknown - kMaxUnknownListed) + " more unknown parameters of " + context.what,
        Place(params.where));
  for (std::size_t i = 0; i < declarations_.size(); ++i) {
    const ParamDecl& decl = declarations_[i];
    if (const ParsedParam* param = FindWithOverrides(decl.name, params, context)) {
      if (IsLeftAtDefault(decl, *param, context)) continue;
      Assign(i, *param, context, settings);
      if (decl.isIgnored && context.log)
        context.log->Verbose(
            "parameter \"" + decl.name + "\" of " + context.what + " has no effect: " + decl.doc,
            Place(param->where));
    } else if (!decl.version2Default.empty() && context.dialect == Dialect::V2) {
      ParsedParam param;
      param.type = AcceptedTypes(decl.type)[0];
      param.name = decl.name;
      param.numbers = decl.version2Default;
      Assign(i, param, context, settings);
    } else if (decl.isRequired) {
      throw Error(ExitStatus::Scene,
                  context.what + " needs the parameter \"" +
                      std::string(AcceptedTypes(decl.type)[0]) + ' ' + decl.name + '"',
                  params.where);
    }
  }
}

// Returns the paths that were tried, if the parameter names a file and none of them exists.
std::string ParamTableBase::MissingFileHint(const ParsedParam& param) const {
  const bool isFile =
      std::any_of(declarations_.begin(), declarations_.end(), [&](const ParamDecl& decl) {
        return decl.name == param.name && decl.type == ParamType::File;
      });
  std::error_code ignored;
  if (!isFile || param.strings.size() != 1 ||
      std::filesystem::exists(ResolveScenePath(param.strings[0], param.where), ignored))
    return "";
  return TriedPathsText(
      ScenePathCandidates(param.strings[0], param.where.file, MainFileOf(param.where)));
}

void ParamTableBase::Locate(const ParamError& error, const ParamSet& params,
                            const BindContext& context) const {
  const ParsedParam* param = FindWithOverrides(error.param, params, context);
  const std::string subject =
      error.param.empty() ? context.what : "parameter \"" + error.param + "\" of " + context.what;
  const std::string hint = error.hint.empty() && param ? MissingFileHint(*param) : error.hint;
  throw Error(ExitStatus::Scene, subject + ' ' + error.text, param ? param->where : params.where,
              hint);
}

}  // namespace exphoton
