// SPDX-License-Identifier: BSD-2-Clause
// Tokenizer splits scene text, including included files, into words, strings, numbers and brackets.
// It does not distinguish directives. The text view of a token is valid until the next token is
// read. Number tokens allocate no memory, since meshes have millions of them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/parser/syntax/scene_limits.h"
#include "core/parser/syntax/source.h"

namespace exphoton {

// SyntaxError is an error after which reading can go on at a later directive.
class SyntaxError : public Error {
 public:
  using Error::Error;
};

enum class TokenKind { End, Word, String, Number, OpenBracket, CloseBracket };

// TextPosition is a position in the file being read and cheap to copy. Tokenizer::Locate converts
// it to a SourceLocation while that file is still open.
struct TextPosition {
  std::uint32_t line = 0;
  std::size_t lineStart = 0, offset = 0;
};

struct Token {
  TokenKind kind = TokenKind::End;
  std::string_view text;  // the Word, or the contents of the String
  double number = 0;      // finite and in the range of Real
  TextPosition position;
};

class Tokenizer {
 public:
  static constexpr std::size_t kMaxStringBytes = 1 << 20;  // limit for one string or word
  static constexpr int kMaxIncludeDepth = 32;

  // Throws Error(File) if `path` cannot be read. Include fails after maxIncludes calls.
  Tokenizer(SceneSource& source, const std::string& path,
            std::int64_t maxIncludes = SceneLimits().includes);

  // Returns the next token. At the end of an included file, continues after its Include directive.
  // Throws SyntaxError for a malformed number, which the next call skips, and Error(Scene) for
  // other text that is no token.
  Token Next();
  // Continues with the text of `name`, as written by the Include at `where`. Throws SyntaxError if
  // it cannot be read, and Error(Scene) if there are too many files or the file includes itself.
  void Include(const std::string& name, const TextPosition& where);

  // Converts the position of a token in the file being read.
  SourceLocation Locate(const TextPosition& position) const;
  // Returns the location after the last token, for errors about missing text.
  SourceLocation Here() const;

 private:
  struct File {
    std::string name, identity, text;
    std::shared_ptr<const SourceLocation> includedFrom;
    std::size_t offset = 0, lineStart = 0;
    std::uint32_t line = 1;
  };

  void Open(std::string name, std::string text, std::shared_ptr<const SourceLocation> from);
  bool SkipBlanks();  // false at the end of the file
  Token ReadString();
  void AppendEscape(TextPosition start);
  Token ReadNumber();
  Token ReadWord();
  TextPosition Position() const;
  [[noreturn]] void Fail(const std::string& text, const TextPosition& where,
                         const std::string& hint = {}) const;

  SceneSource& source_;
  std::int64_t maxIncludes_, includes_ = 0;
  std::vector<std::unique_ptr<File>> files_;  // innermost file last; never empty
  File* file_ = nullptr;
  std::string unescaped_;
};

// Replaces control characters and cuts the text to `limit` bytes, for use in messages.
std::string Printable(std::string_view text, std::size_t limit = 60);

}  // namespace exphoton
