// SPDX-License-Identifier: BSD-2-Clause
// Parser loops over the tokens of a scene. Each directive is a name, then numbers or strings, then
// parameters. After an error it goes on at the next directive, if the handler keeps the error.
#include "core/parser/syntax/parser.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/base/log.h"
#include "core/params/suggestions.h"
#include "core/parser/syntax/tokenizer.h"

namespace exphoton {
namespace {

constexpr std::size_t kMaxLocatedValues = 16;  // longer lists have one location

enum class ValueKind { Numbers, Strings, Either };
struct TypeSpec {
  std::string_view name;
  ValueKind kind;
};
constexpr std::array<TypeSpec, 18> kTypes{{
    {"integer", ValueKind::Numbers},
    {"float", ValueKind::Numbers},
    {"bool", ValueKind::Strings},
    {"point", ValueKind::Numbers},
    {"vector", ValueKind::Numbers},
    {"normal", ValueKind::Numbers},
    {"color", ValueKind::Numbers},
    {"string", ValueKind::Strings},
    {"texture", ValueKind::Strings},
    {"rgb", ValueKind::Numbers},
    {"xyz", ValueKind::Numbers},
    {"blackbody", ValueKind::Numbers},
    {"spectrum", ValueKind::Either},
    {"point2", ValueKind::Numbers},
    {"point3", ValueKind::Numbers},
    {"vector2", ValueKind::Numbers},
    {"vector3", ValueKind::Numbers},
    {"normal3", ValueKind::Numbers},
}};

std::string Quoted(std::string_view text) { return "\"" + Printable(text) + "\""; }

std::string Describe(const Token& token) {
  switch (token.kind) {
    case TokenKind::End:
      return "the end of the file";
    case TokenKind::Word:
      return Printable(token.text);
    case TokenKind::String:
      return "the string " + Quoted(token.text);
    case TokenKind::Number:
      return "a number";
    case TokenKind::OpenBracket:
      return "'['";
    case TokenKind::CloseBracket:
      return "']'";
  }
  return {};
}

class Parser {
 public:
  Parser(Tokenizer tokens, DirectiveHandler& handler, Log& log)
      : tokens_(std::move(tokens)), handler_(handler), log_(log), grammar_(handler.Grammar()) {}

  void Run() {
    Try([&] { Advance(); });
    while (token_.kind != TokenKind::End) Try([&] { ParseDirective(); });
    if (!isInList_) handler_.Finish(tokens_.Here());
  }

 private:
  void Advance() {
    try {
      token_ = tokens_.Next();
    } catch (const SyntaxError&) {
      token_.kind = TokenKind::Number;
      throw;
    }
  }
  SourceLocation Here() const { return tokens_.Locate(token_.position); }
  [[noreturn]] void Fail(const std::string& text, const std::string& hint = {}) const {
    throw SyntaxError(ExitStatus::Scene, text, Here(), hint);
  }

  template <class Work>
  void Try(const Work& work);
  void SkipUnknown();
  void SkipToDirective();
  void SkipToken();
  bool IsAtDirective() const;

  void ParseDirective();
  [[noreturn]] void FailUnknown() const;
  void ParseInclude(const TextPosition& where);
  void ParseNumbers(Directive* directive);
  void ParseStrings(Directive* directive);
  void ParseParameters(ParamSet* params);
  ParsedParam ParseDeclaration();
  void ParseValues(ParsedParam* param, ValueKind kind);
  void ParseValue(ParsedParam* param, ValueKind kind);

  Tokenizer tokens_;
  DirectiveHandler& handler_;
  Log& log_;
  SceneGrammar grammar_;
  Token token_;            // lookahead: the token to parse next
  bool isInList_ = false;  // whether it is between brackets
  // The directive that is being parsed; nullopt: none. One without a specification is unknown.
  std::optional<Directive> directive_;
};

// Runs a part of the parser. After an error that the handler keeps, skips the rest of the
// directive.
template <class Work>
void Parser::Try(const Work& work) {
  try {
    return work();
  } catch (const SyntaxError& error) {
    if (!handler_.Keep(error)) throw;
  }
  if (directive_ && !directive_->spec) SkipUnknown();
  SkipToDirective();
  if (directive_) handler_.Recover(*directive_);
}

// Skips an unknown directive, and takes the strings that the nearest known directive has.
void Parser::SkipUnknown() {
  const auto nearest = Nearest(token_.text, DirectiveNames(grammar_));
  SkipToken();
  if (!nearest) return;
  const DirectiveSpec& spec = *FindDirective(*nearest, grammar_);
  directive_->spec = &spec;
  for (int i = 0; i < spec.strings && token_.kind == TokenKind::String; ++i) {
    directive_->strings.emplace_back(token_.text);
    SkipToken();
  }
}

// Lists do not nest, so a bracket shows by itself whether a list begins or ends.
void Parser::SkipToDirective() {
  for (; token_.kind != TokenKind::End && !IsAtDirective(); SkipToken()) {
    if (token_.kind == TokenKind::OpenBracket) isInList_ = true;
    if (token_.kind == TokenKind::CloseBracket) isInList_ = false;
  }
}

void Parser::SkipToken() {
  try {
    Advance();
  } catch (const SyntaxError&) {  // of a directive that has an error already
  }
}

bool Parser::IsAtDirective() const {
  return !isInList_ && token_.kind == TokenKind::Word &&
         (FindDirective(token_.text, grammar_) || Nearest(token_.text, DirectiveNames(grammar_)));
}

void Parser::FailUnknown() const {
  const std::string name = Printable(token_.text);
  if (grammar_ == SceneGrammar::Later)
    Fail("versions 3 and 4 have no directive " + name,
         FindDirective(token_.text) ? "it is of versions 1 and 2, which are rendered as they are"
                                    : DidYouMean(token_.text, DirectiveNames(grammar_)));
  if (const std::string_view version = LaterVersionOf(token_.text); !version.empty())
    throw LaterVersionError(version, name, Here());
  Fail("unknown directive " + name, DidYouMean(token_.text, DirectiveNames()));
}

void Parser::ParseDirective() {
  isInList_ = false;
  directive_.reset();
  if (token_.kind != TokenKind::Word) Fail("expected a directive, found " + Describe(token_));
  Directive& directive = directive_.emplace();
  directive.params.where = Here();
  directive.spec = FindDirective(token_.text, grammar_);
  if (!directive.spec) FailUnknown();
  const TextPosition where = token_.position;
  Advance();
  if (directive.spec->id == DirectiveId::Include) return ParseInclude(where);
  if (directive.spec->numbers > 0) ParseNumbers(&directive);
  if (directive.spec->hasWord) {
    if (token_.kind != TokenKind::Word || FindDirective(token_.text, grammar_))
      Fail(std::string(directive.spec->name) + " takes a word, found " + Describe(token_));
    directive.strings.emplace_back(token_.text);
    Advance();
  }
  if (directive.spec->strings > 0) ParseStrings(&directive);
  if (directive.spec->hasParameters) ParseParameters(&directive.params);
  handler_.Handle(std::move(directive));
}

// Opens the included file before reading the token after the file name, since that token follows
// the included text.
void Parser::ParseInclude(const TextPosition& where) {
  if (token_.kind != TokenKind::String)
    Fail("Include takes the name of a file in quotes, found " + Describe(token_));
  if (token_.text.empty()) Fail("Include names no file");
  tokens_.Include(std::string(token_.text), where);
  Advance();
}

void Parser::ParseNumbers(Directive* directive) {
  const int count = directive->spec->numbers;
  const std::string name(directive->spec->name);
  const bool isBracketed = token_.kind == TokenKind::OpenBracket;
  isInList_ = isBracketed;
  if (isBracketed) Advance();
  for (int i = 0; i < count; ++i) {
    if (token_.kind != TokenKind::Number)
      Fail(name + " takes " + std::to_string(count) + " numbers, found " + Describe(token_) +
           " after " + std::to_string(i));
    directive->numbers.push_back(token_.number);
    Advance();
  }
  if (token_.kind == TokenKind::Number)
    Fail(name + " takes " + std::to_string(count) + " numbers, found one more");
  if (!isBracketed) return;
  if (token_.kind != TokenKind::CloseBracket) Fail("expected ']', found " + Describe(token_));
  isInList_ = false;
  Advance();
}

void Parser::ParseStrings(Directive* directive) {
  const std::string name(directive->spec->name);
  for (int i = 0; i < directive->spec->strings; ++i) {
    if (token_.kind != TokenKind::String) {
      const char* what = directive->spec->strings == 3
                             ? " takes a name, a type and a class in quotes, found "
                             : " takes a name in quotes, found ";
      Fail(name + what + Describe(token_));
    }
    directive->strings.emplace_back(token_.text);
    Advance();
  }
  // The medium outside may be missing.
  if (directive->spec->id == DirectiveId::MediumInterface && token_.kind == TokenKind::String) {
    directive->strings.emplace_back(token_.text);
    Advance();
  }
}

void Parser::ParseParameters(ParamSet* params) {
  while (token_.kind == TokenKind::String) {
    ParsedParam param = ParseDeclaration();
    if (params->Find(param.name))
      log_.Verbose("parameter \"" + param.name + "\" is given twice: the last one counts",
                   param.where);
    // ParamSet searches linearly; real directives have fewer than 50 parameters.
    constexpr std::size_t kMaxParameters = 1000;
    if (params->All().size() == kMaxParameters)
      Fail("more than " + std::to_string(kMaxParameters) + " parameters of one directive");
    params->Add(std::move(param));
  }
  if (token_.kind != TokenKind::Word && token_.kind != TokenKind::End)
    Fail("expected a parameter or a directive, found " + Describe(token_));
}

// Parses a declaration "type name" and the values that follow.
ParsedParam Parser::ParseDeclaration() {
  constexpr std::string_view kBlanks = " \t\r\n\f\v";
  const std::string declaration(token_.text);
  std::vector<std::string> words;
  for (std::size_t at = declaration.find_first_not_of(kBlanks); at != std::string::npos;) {
    const std::size_t end = std::min(declaration.find_first_of(kBlanks, at), declaration.size());
    words.push_back(declaration.substr(at, end - at));
    at = declaration.find_first_not_of(kBlanks, end);
  }
  if (words.size() != 2) Fail("expected a parameter \"type name\", found " + Quoted(declaration));
  const auto type = std::find_if(kTypes.begin(), kTypes.end(),
                                 [&](const TypeSpec& spec) { return spec.name == words[0]; });
  if (type == kTypes.end()) {
    std::vector<std::string> known;
    for (const TypeSpec& spec : kTypes) known.emplace_back(spec.name);
    Fail("unknown parameter type " + Quoted(words[0]), DidYouMean(words[0], known));
  }
  ParsedParam param;
  param.type = std::move(words[0]);
  param.name = std::move(words[1]);
  param.where = Here();
  Advance();
  ParseValues(&param, type->kind);
  return param;
}

void Parser::ParseValues(ParsedParam* param, ValueKind kind) {
  if (token_.kind != TokenKind::OpenBracket) return ParseValue(param, kind);
  const SourceLocation bracket = Here();
  isInList_ = true;
  Advance();
  while (token_.kind != TokenKind::CloseBracket) {
    if (token_.kind == TokenKind::End)
      throw Error(ExitStatus::Scene, "the list that begins here has no ']'", bracket);
    ParseValue(param, kind);
  }
  isInList_ = false;
  Advance();
}

void Parser::ParseValue(ParsedParam* param, ValueKind kind) {
  const auto name = [&] { return "parameter \"" + param->name + "\""; };  // built only for errors
  const bool isBareBool =
      token_.kind == TokenKind::Word && (token_.text == "true" || token_.text == "false");
  const bool isAllowedBool = isBareBool && grammar_ == SceneGrammar::Later && param->type == "bool";
  if (token_.kind != TokenKind::Number && token_.kind != TokenKind::String && !isAllowedBool) {
    Fail(name() + " has " + Describe(token_) + " for a value",
         isBareBool ? "write \"" + std::string(token_.text) + "\" in quotes" : std::string());
  }
  const bool isNumber = token_.kind == TokenKind::Number;
  if (kind != ValueKind::Either && isNumber != (kind == ValueKind::Numbers))
    Fail(name() + " of type " + param->type + " takes " +
         (isNumber ? "strings in quotes, found a number" : "numbers, found " + Describe(token_)));
  if (isNumber ? !param->strings.empty() : !param->numbers.empty())
    Fail(name() + " mixes numbers and strings");
  const std::size_t count = param->numbers.size() + param->strings.size();
  if (count < kMaxLocatedValues) param->valueWhere.push_back(Here());
  if (count == kMaxLocatedValues) param->valueWhere.clear();
  if (isNumber)
    param->numbers.push_back(token_.number);
  else
    param->strings.emplace_back(token_.text);
  Advance();
}

}  // namespace

void ParseScene(SceneSource& source, const std::string& path, DirectiveHandler& handler, Log& log,
                const SceneLimits& limits) {
  Parser(Tokenizer(source, path, limits.includes), handler, log).Run();
}

}  // namespace exphoton
