// SPDX-License-Identifier: BSD-2-Clause
// RefuseLaterVersion: one directive or film decides that the file is of a later version. Names of
// plugins, which scenes of earlier versions may have too, only decide between versions 3 and 4.
#include "core/parser/later_version.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "core/parser/syntax/directive.h"
#include "core/parser/syntax/tokenizer.h"

namespace exphoton {
namespace {

// The decisive directives are near the beginning, and lists of vertices are long.
constexpr std::size_t kMostBytes = 1 << 18;

struct Named {
  std::string_view directive, name;
};
constexpr std::array<Named, 3> kFilmsOf4{
    {{"Film", "rgb"}, {"Film", "gbuffer"}, {"Film", "spectral"}}};
constexpr std::array<Named, 18> kPluginsOf4{{{"Material", "diffuse"},
                                             {"Material", "coateddiffuse"},
                                             {"Material", "coatedconductor"},
                                             {"Material", "conductor"},
                                             {"Material", "dielectric"},
                                             {"Material", "thindielectric"},
                                             {"Material", "diffusetransmission"},
                                             {"Material", "interface"},
                                             {"Sampler", "zsobol"},
                                             {"Sampler", "paddedsobol"},
                                             {"Sampler", "pmj02bn"},
                                             {"Sampler", "independent"},
                                             {"Shape", "bilinearmesh"},
                                             {"Integrator", "simplepath"},
                                             {"Integrator", "simplevolpath"},
                                             {"Integrator", "lightpath"},
                                             {"Integrator", "randomwalk"},
                                             {"Integrator", "function"}}};
// The film "image" and WorldEnd are of versions 1 to 3.
constexpr std::array<Named, 7> kPluginsOf3{{{"Film", "image"},
                                            {"Material", "disney"},
                                            {"Material", "fourier"},
                                            {"Sampler", "02sequence"},
                                            {"Sampler", "maxmindist"},
                                            {"Integrator", "directlighting"},
                                            {"Integrator", "whitted"}}};

template <class List>
bool Contains(const List& list, std::string_view directive, std::string_view name) {
  return std::any_of(list.begin(), list.end(), [&](const Named& each) {
    return each.directive == directive && each.name == name;
  });
}

struct Evidence {
  std::string sign;  // the first decisive directive: "Integrator"; empty: none
  SourceLocation where;
  bool isOf3 = false, isOf4 = false;
};

void Judge(const Tokenizer& tokens, std::string_view directive, const Token& next,
           const TextPosition& position, Evidence* evidence) {
  const std::string_view name = next.kind == TokenKind::String ? next.text : std::string_view();
  const bool isFilm = Contains(kFilmsOf4, directive, name);
  const std::string_view version = LaterVersionOf(directive);
  if (evidence->sign.empty() && (isFilm || !version.empty())) {
    evidence->sign = directive;
    if (isFilm) evidence->sign += " \"" + std::string(name) + "\"";
    evidence->where = tokens.Locate(position);
  }
  evidence->isOf4 |= IsOfVersion4(directive, name);
  evidence->isOf3 |= directive == "WorldEnd" || Contains(kPluginsOf3, directive, name);
}

Evidence Search(SceneSource& source, const std::string& path, const LoadOptions& options) {
  Evidence evidence;
  Tokenizer tokens(source, path, options.limits.includes);
  Token token = tokens.Next();
  while (token.kind != TokenKind::End && token.position.offset < kMostBytes) {
    if (token.kind != TokenKind::Word) {
      token = tokens.Next();
      continue;
    }
    const std::string directive(token.text);
    const TextPosition position = token.position;
    token = tokens.Next();
    Judge(tokens, directive, token, position, &evidence);
  }
  return evidence;
}

// Returns whether the text has a word without which the file is of version 1 or 2.
bool MayBeLater(std::string_view text) {
  static constexpr std::string_view kWords[] = {
      "Attribute ", "Attribute\t", "ColorSpace",      "Import",          "Integrator",  "Option",
      "\"rgb\"",    "\"gbuffer\"", "MakeNamedMedium", "MediumInterface", "\"spectral\""};
  text = text.substr(0, kMostBytes);
  return std::any_of(std::begin(kWords), std::end(kWords), [&](std::string_view word) {
    return text.find(word) != std::string_view::npos;
  });
}

}  // namespace

bool IsOfVersion4(std::string_view directive, std::string_view name) {
  return LaterVersionOf(directive) == "4" || Contains(kFilmsOf4, directive, name) ||
         Contains(kPluginsOf4, directive, name);
}

void RefuseLaterVersion(SceneSource& source, const std::string& path, const LoadOptions& options) {
  Evidence evidence;
  try {
    if (!MayBeLater(source.Read(path, false))) return;
    evidence = Search(source, path, options);
  } catch (const Error&) {  // loading finds it again
  } catch (const SourceError&) {
  }
  if (evidence.sign.empty()) return;
  const bool isKnown = evidence.isOf3 || evidence.isOf4;
  throw LaterVersionError(!isKnown         ? "3 or 4"
                          : evidence.isOf4 ? "4"
                                           : "3",
                          evidence.sign, evidence.where);
}

}  // namespace exphoton
