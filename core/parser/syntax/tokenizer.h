// SPDX-License-Identifier: BSD-2-Clause
// Tokenizer: scene text to words, strings, numbers and brackets, through included files. It knows
// no directive. Text views of a token stay valid until the next one is read; nothing is allocated
// for a number, since meshes have millions.
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

enum class TokenKind { End, Word, String, Number, OpenBracket, CloseBracket };

// A place, cheap to copy; Tokenizer::Locate makes words of it while its file is being read.
struct TextPosition {
  std::uint32_t line = 0;
  std::size_t lineStart = 0, offset = 0;
};

struct Token {
  TokenKind kind = TokenKind::End;
  std::string_view text;  // of a Word, or the characters of a String
  double number = 0;      // finite, and within the range of Real
  TextPosition position;
};

class Tokenizer {
 public:
  static constexpr std::size_t kMaxStringBytes = 1 << 20;  // of a string or a word
  static constexpr int kMaxIncludeDepth = 32;

  // Throws Error(File) where `path` cannot be read. Include fails after maxIncludes calls.
  Tokenizer(SceneSource& source, const std::string& path,
            std::int64_t maxIncludes = SceneLimits().includes);

  // The next token. At the end of an included file it goes on behind the Include.
  Token Next();
  // Goes on with the text of `name`, as named by a directive at `where`. Throws Error(Scene).
  void Include(const std::string& name, const TextPosition& where);

  // Of a token of the file that is being read.
  SourceLocation Locate(const TextPosition& position) const;
  // The place behind the last token: what is missing is missing here.
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
  std::vector<std::unique_ptr<File>> files_;  // the innermost last; never empty
  File* file_ = nullptr;
  std::string unescaped_;
};

// Text as it can be shown in a message: at most `limit` bytes, without control characters.
std::string Printable(std::string_view text, std::size_t limit = 60);

}  // namespace exphoton
