// SPDX-License-Identifier: BSD-2-Clause
// Tokenizer implements the lexical rules of scene files. Numbers are parsed by std::from_chars,
// independent of the locale.
#include "core/parser/syntax/tokenizer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/math/real.h"
#include "core/params/scene_path.h"

namespace exphoton {
namespace {

constexpr std::size_t kMaxShownColumn = 1000;  // in bytes; errors further right show no source line
constexpr std::size_t kShownAfterColumn = 100;

bool IsBlank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v';
}
bool IsDigit(char c) { return c >= '0' && c <= '9'; }
bool IsLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
// Returns whether c can be part of a number or word. "12abc" is therefore one malformed number and
// not two tokens.
bool IsWordPart(char c) { return IsLetter(c) || IsDigit(c) || c == '.' || c == '+' || c == '-'; }

std::string ShowCharacter(char c) {
  if (c > ' ' && c < 127) return std::string("'") + c + "'";
  constexpr char kHex[] = "0123456789abcdef";
  const auto byte = static_cast<unsigned char>(c);
  return std::string("byte 0x") + kHex[byte >> 4] + kHex[byte & 15];
}

}  // namespace

std::string Printable(std::string_view text, std::size_t limit) {
  std::string shown(text.substr(0, limit));
  for (char& c : shown)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = ' ';
  if (text.size() > limit) shown += "...";
  return shown;
}

Tokenizer::Tokenizer(SceneSource& source, const std::string& path, std::int64_t maxIncludes)
    : source_(source), maxIncludes_(maxIncludes) {
  const std::string name = path == "-" ? "<stdin>" : path;
  try {
    Open(name, source_.Read(path, false), nullptr);
  } catch (const SourceError& error) {
    throw Error(ExitStatus::File, "cannot read the scene \"" + name + "\": " + error.what());
  }
}

void Tokenizer::Open(std::string name, std::string text,
                     std::shared_ptr<const SourceLocation> from) {
  auto file = std::make_unique<File>();
  file->identity = source_.Identity(name);
  file->name = std::move(name);
  file->text = std::move(text);
  file->includedFrom = std::move(from);
  if (file->text.starts_with("\xef\xbb\xbf")) file->offset = file->lineStart = 3;
  file_ = file.get();
  files_.push_back(std::move(file));
}

void Tokenizer::Include(const std::string& name, const TextPosition& where) {
  const std::vector<std::string> candidates =
      ScenePathCandidates(name, file_->name, files_.front()->name);
  const auto found =
      std::find_if(candidates.begin(), candidates.end(),
                   [this](const std::string& candidate) { return source_.Has(candidate); });
  const std::string path = found == candidates.end() ? candidates.front() : *found;
  const std::string identity = source_.Identity(path);
  for (std::size_t i = 0; i < files_.size(); ++i) {
    if (files_[i]->identity != identity) continue;
    std::string chain;
    for (std::size_t j = i; j < files_.size(); ++j) chain += files_[j]->name + " -> ";
    Fail("the file includes itself: " + chain + path, where);
  }
  if (int(files_.size()) > kMaxIncludeDepth)
    Fail("files are included more than " + std::to_string(kMaxIncludeDepth) + " deep", where);
  if (++includes_ > maxIncludes_)
    Fail("the scene includes more than " + std::to_string(maxIncludes_) + " files", where,
         "a file counts each time that it is included; --limits includes=N allows N");
  auto from = std::make_shared<const SourceLocation>(Locate(where));
  try {
    Open(path, source_.Read(path, true), std::move(from));
  } catch (const SourceError& error) {
    throw SyntaxError(
        ExitStatus::Scene,
        "cannot read the included file \"" + Printable(path, 200) + "\": " + error.what(),
        Locate(where),
        found == candidates.end() ? Printable(TriedPathsText(candidates), 800) : std::string());
  }
}

TextPosition Tokenizer::Position() const { return {file_->line, file_->lineStart, file_->offset}; }

SourceLocation Tokenizer::Here() const { return Locate(Position()); }

SourceLocation Tokenizer::Locate(const TextPosition& position) const {
  SourceLocation where;
  where.file = file_->name;
  where.line = int(position.line);
  const std::size_t before = position.offset - position.lineStart;
  where.column = int(std::min<std::size_t>(before, 1 << 30)) + 1;
  where.includedFrom = file_->includedFrom;
  if (before <= kMaxShownColumn) {
    const std::string_view text(file_->text);
    const std::string_view start = text.substr(position.lineStart, before + kShownAfterColumn);
    // Values have locations, too, so the search takes much of the time of reading a scene.
    // find_first_of would call memchr for each character.
    const auto end = std::ranges::find_if(start, [](char c) { return c == '\n' || c == '\r'; });
    where.lineText.assign(start.begin(), end);
    for (char& c : where.lineText)
      if ((static_cast<unsigned char>(c) < 32 && c != '\t') || c == 127) c = ' ';
  }
  return where;
}

void Tokenizer::Fail(const std::string& text, const TextPosition& where,
                     const std::string& hint) const {
  throw Error(ExitStatus::Scene, text, Locate(where), hint);
}

bool Tokenizer::SkipBlanks() {
  const std::string& text = file_->text;
  std::size_t at = file_->offset;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    // Lines end with LF, CR LF or, in old Mac OS files, CR alone.
    const bool isLoneReturn = c == '\r' && (at + 1 == text.size() || text[at + 1] != '\n');
    if (c == '\n' || isLoneReturn) {
      ++file_->line;
      file_->lineStart = at + 1;
    } else if (c == '#') {
      const std::size_t end = text.find_first_of("\r\n", at);
      at = (end == std::string::npos ? text.size() : end) - 1;
    } else if (!IsBlank(c)) {
      break;
    }
  }
  file_->offset = at;
  return at < text.size();
}

Token Tokenizer::Next() {
  while (!SkipBlanks()) {
    if (files_.size() == 1) return {TokenKind::End, {}, 0, Position()};
    files_.pop_back();
    file_ = files_.back().get();
  }
  const char c = file_->text[file_->offset];
  if (c == '"') return ReadString();
  if (c == '[' || c == ']') {
    const TextPosition start = Position();
    ++file_->offset;
    return {c == '[' ? TokenKind::OpenBracket : TokenKind::CloseBracket, {}, 0, start};
  }
  if (IsDigit(c) || c == '.' || c == '+' || c == '-') return ReadNumber();
  if (IsLetter(c)) return ReadWord();
  if (c == '\0') Fail("a NUL byte: this is not a text file", Position());
  const std::string_view text = file_->text;
  if (file_->offset == 0 && (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")))
    Fail("the file is in UTF-16", Position(), "save it in UTF-8");
  Fail("unexpected " + ShowCharacter(c), Position());
}

Token Tokenizer::ReadWord() {
  const TextPosition start = Position();
  const std::string& text = file_->text;
  std::size_t end = start.offset;
  while (end < text.size() && (IsLetter(text[end]) || IsDigit(text[end]))) ++end;
  if (end - start.offset > kMaxStringBytes) Fail("a word of more than 1 MiB", start);
  file_->offset = end;
  return {TokenKind::Word, std::string_view(text).substr(start.offset, end - start.offset), 0,
          start};
}

Token Tokenizer::ReadNumber() {
  const TextPosition start = Position();
  const char* const begin = file_->text.data() + start.offset;
  const char* const end = file_->text.data() + file_->text.size();
  const char* first = begin + (*begin == '+' ? 1 : 0);  // from_chars accepts no plus sign
  const char* magnitude = first + (first == begin && *first == '-' ? 1 : 0);
  Token token{TokenKind::Number, {}, 0, start};
  std::from_chars_result result{first, std::errc::invalid_argument};
  if (magnitude < end && (IsDigit(*magnitude) || *magnitude == '.'))  // rejects "nan" and "+-1"
    result = std::from_chars(first, end, token.number);
  const bool isWhole = result.ptr == end || !IsWordPart(*result.ptr);
  if (result.ec == std::errc{} && isWhole &&
      std::abs(token.number) <= double(std::numeric_limits<Real>::max())) {
    file_->offset = std::size_t(result.ptr - file_->text.data());
    return token;
  }
  const char* stop = begin;
  while (stop < end && IsWordPart(*stop)) ++stop;
  const std::string shown = Printable({begin, std::size_t(stop - begin)}, 40);
  file_->offset = std::size_t(stop - file_->text.data());
  const bool isNumber = result.ec != std::errc::invalid_argument && isWhole;
  throw SyntaxError(
      ExitStatus::Scene,
      isNumber ? "the number " + shown + " is out of range" : "\"" + shown + "\" is not a number",
      Locate(start));
}

Token Tokenizer::ReadString() {
  const TextPosition start = Position();
  const std::string& text = file_->text;
  const std::size_t first = start.offset + 1;
  bool isPlain = true;  // no escape so far: the token is a view of the file
  file_->offset = first;
  for (;;) {
    const std::size_t at = file_->offset;
    const char c = at < text.size() ? text[at] : '\n';
    if (c == '\n' || c == '\r')
      Fail("the string that begins here has no closing quote on its line", start);
    if (c == '\0') Fail("a NUL byte in a string", Position());
    if ((isPlain ? at - first : unescaped_.size()) > kMaxStringBytes)
      Fail("a string of more than 1 MiB", start);
    if (c == '"') {
      ++file_->offset;
      const std::string_view plain = std::string_view(text).substr(first, at - first);
      return {TokenKind::String, isPlain ? plain : std::string_view(unescaped_), 0, start};
    }
    if (c == '\\') {
      if (isPlain) unescaped_.assign(text, first, at - first);
      isPlain = false;
      AppendEscape(start);
      continue;
    }
    if (!isPlain) unescaped_ += c;
    ++file_->offset;
  }
}

// Reads the escape sequence at a backslash, by the rules of version 1: \ddd is decimal, and a
// backslash before any other character yields that character.
void Tokenizer::AppendEscape(TextPosition start) {
  const std::string& text = file_->text;
  const TextPosition escape = Position();
  std::size_t at = escape.offset + 1;
  if (at >= text.size()) Fail("the string that begins here has no closing quote", start);
  const char c = text[at++];
  constexpr std::string_view kNames = "ntrbf", kMeanings = "\n\t\r\b\f";
  if (c == '\r' && at < text.size() && text[at] == '\n') ++at;
  if (c == '\n' || c == '\r') {  // a line continuation
    ++file_->line;
    file_->lineStart = at;
  } else if (const std::size_t index = kNames.find(c); index != std::string_view::npos) {
    unescaped_ += kMeanings[index];
  } else if (IsDigit(c)) {
    int value = 0;
    const auto [end, error] =
        std::from_chars(&text[at - 1], text.data() + std::min(at + 2, text.size()), value);
    if (error != std::errc{} || end != &text[at - 1] + 3 || value < 1 || value > 255)
      Fail("an escape must have three decimal digits from \\001 to \\255", escape);
    unescaped_ += char(value);
    at += 2;
  } else if (c == '\0') {
    Fail("a NUL byte in a string", escape);
  } else {
    unescaped_ += c;
  }
  file_->offset = at;
}

}  // namespace exphoton
