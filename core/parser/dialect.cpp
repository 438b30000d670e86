// SPDX-License-Identifier: BSD-2-Clause
// RecogniseDialect parses the file only if its text contains a word that could decide, because
// parsing a large scene twice takes noticeable time.
#include "core/parser/dialect.h"

#include <algorithm>

#include "core/base/log.h"
#include "core/parser/builder/graphics_state.h"
#include "core/parser/syntax/parser.h"

namespace exphoton {
namespace {

bool BelongsToVersion2(const Directive& directive) {
  switch (directive.spec->id) {
    case DirectiveId::Renderer:
    case DirectiveId::MakeNamedMaterial:
      return true;
    case DirectiveId::AreaLightSource:
      return directive.strings[0] == "diffuse";
    case DirectiveId::Texture:
      return directive.strings[1] == "spectrum";
    default:
      return false;
  }
}

class DialectScanner final : public DirectiveHandler {
 public:
  struct Found {  // thrown to end the scan
    std::string directive;
    SourceLocation where;
  };
  explicit DialectScanner(const LoadOptions& options) : options_(options) {}

  void Handle(Directive directive) override {
    if (options_.stop && *options_.stop) throw LoadingStopped();
    if (BelongsToVersion2(directive))
      throw Found{std::string(directive.spec->name), directive.Where()};
  }
  bool Keep(const Error&) override { return true; }  // loading finds it again
  void Finish(const SourceLocation&) override {}

 private:
  const LoadOptions& options_;
};

// Returns whether the text has a word without which the file is of version 1.
bool MayBelongToVersion2(const std::string& text) {
  static constexpr std::string_view kWords[] = {"Include", "Renderer", "MakeNamedMaterial",
                                                "\"diffuse\"", "\"spectrum\""};
  return std::any_of(std::begin(kWords), std::end(kWords),
                     [&](std::string_view word) { return text.find(word) != std::string::npos; });
}

}  // namespace

Dialect RecogniseDialect(SceneSource& source, const std::string& path, const LoadOptions& options,
                         Log& log) {
  Log silent(Log::Level::Quiet, Log::Sink::Memory);
  DialectScanner scanner(options);
  try {
    if (MayBelongToVersion2(source.Read(path, false)))
      ParseScene(source, path, scanner, silent, options.limits);
  } catch (const DialectScanner::Found& found) {
    log.Notice("scene language version 2, recognised by " + found.directive + " at " +
                   LocationText(found.where) + ": LookAt and defaults follow that version",
               {}, "--dialect v1 keeps the meanings of version 1");
    return Dialect::V2;
  } catch (const Error&) {
    // Loading finds the error again and reports it.
  } catch (const SourceError&) {
  }
  return Dialect::V1;
}

}  // namespace exphoton
