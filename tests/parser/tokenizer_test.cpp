// SPDX-License-Identifier: BSD-2-Clause
// These tests check the lexical rules: numbers, strings, comments, and bytes that text
// may not contain.
#include "core/parser/syntax/tokenizer.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <clocale>
#include <limits>

#include "tests/parser/parse_support.h"

namespace exphoton {
namespace {

std::vector<Token> TokensOf(const std::string& text, std::vector<std::string>* strings = nullptr) {
  MemorySource source({{"scene.pbrt", text}});
  Tokenizer tokenizer(source, "scene.pbrt");
  std::vector<Token> tokens;
  for (Token token = tokenizer.Next(); token.kind != TokenKind::End; token = tokenizer.Next()) {
    tokens.push_back(token);
    if (strings) strings->emplace_back(token.text);
  }
  return tokens;
}

double NumberOf(const std::string& text) {
  const std::vector<Token> tokens = TokensOf(text);
  EXPECT_EQ(tokens.size(), 1u) << text;
  return tokens.at(0).number;
}

std::string StringOf(const std::string& text) {
  std::vector<std::string> strings;
  EXPECT_EQ(TokensOf(text, &strings).size(), 1u) << text;
  return strings.at(0);
}

std::string TokenErrorOf(const std::string& text) {
  try {
    TokensOf(text);
  } catch (const Error& error) {
    EXPECT_EQ(error.Status(), ExitStatus::Scene);
    return Diagnostic(error);
  }
  return "";
}

std::string Compressed(const std::string& text) {
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
  std::string bytes(text.size() + 100, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = uInt(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = uInt(bytes.size());
  deflate(&stream, Z_FINISH);
  bytes.resize(bytes.size() - stream.avail_out);
  deflateEnd(&stream);
  return bytes;
}

TEST(Tokenizer, ReadsNumbersAsCWritesThem) {
  EXPECT_EQ(NumberOf("1."), 1);
  EXPECT_EQ(NumberOf(".5"), .5);
  EXPECT_EQ(NumberOf("+3"), 3);
  EXPECT_EQ(NumberOf("-.5"), -.5);
  EXPECT_EQ(NumberOf("1e-3"), 1e-3);
  EXPECT_EQ(NumberOf("+.5e+3"), 500);
  EXPECT_EQ(NumberOf("-0"), 0);
  EXPECT_TRUE(std::signbit(NumberOf("-0")));
  EXPECT_EQ(NumberOf("2147483647"), 2147483647);
}

TEST(Tokenizer, RefusesWhatIsNoNumber) {
  for (const char* text :
       {"0x10", "1e", "-", "+", ".", "1..2", "1-2", "12abc", "+-1", "--1", "-nan", "+inf", "1e+"}) {
    EXPECT_EQ(TokenErrorOf(text), "scene.pbrt:1:1: error: \"" + std::string(text) +
                                      "\" is not a number\n    " + text + "\n    ^\n");
  }
}

TEST(Tokenizer, RefusesNumbersOutOfRange) {
  for (const char* text : {"1e999", "-1e999", "1e-999"}) {
    EXPECT_EQ(TokenErrorOf(text), "scene.pbrt:1:1: error: the number " + std::string(text) +
                                      " is out of range\n    " + text + "\n    ^\n");
  }
#ifndef EXPHOTON_DOUBLE
  EXPECT_NE(TokenErrorOf("1e39"), "");  // finite in double, not in Real
#endif
  EXPECT_EQ(TokenErrorOf("3e38 -3e38 1e-300"), "");
}

TEST(Tokenizer, DoesNotTakeNanAndInfForNumbers) {
  EXPECT_EQ(TokensOf("nan")[0].kind, TokenKind::Word);
  EXPECT_EQ(TokensOf("inf")[0].kind, TokenKind::Word);
}

TEST(Tokenizer, ReadsNumbersAlikeInEveryLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* locale : {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", ""}) {
    std::setlocale(LC_ALL, locale);  // no effect if the locale is not installed
    EXPECT_EQ(NumberOf("1.5"), 1.5);
  }
  std::setlocale(LC_ALL, before.c_str());
}

TEST(Tokenizer, KnowsTheEscapesOfVersion1) {
  EXPECT_EQ(StringOf(R"("a\n\t\r\b\f\"\\b")"), "a\n\t\r\b\f\"\\b");
  EXPECT_EQ(StringOf(R"("\065\126")"), "A~");
  EXPECT_EQ(StringOf("\"one\\\ntwo\""), "onetwo");
  EXPECT_EQ(StringOf("\"one\\\r\ntwo\""), "onetwo");
  EXPECT_EQ(StringOf(R"("\q")"), "q");
  EXPECT_EQ(StringOf("\"\""), "");
  EXPECT_EQ(StringOf("\"r\xc3\xa4ume\""), "r\xc3\xa4ume");
}

TEST(Tokenizer, RefusesBadEscapesAndOpenStrings) {
  EXPECT_EQ(TokenErrorOf("\"\\25\""),
            "scene.pbrt:1:2: error: an escape must have three decimal digits from \\001 to "
            "\\255\n    \"\\25\"\n     ^\n");
  EXPECT_NE(TokenErrorOf("\"\\256\""), "");
  EXPECT_NE(TokenErrorOf("\"\\000\""), "");
  EXPECT_EQ(TokenErrorOf("1 \"abc\n2"),
            "scene.pbrt:1:3: error: the string that begins here has no closing quote on its "
            "line\n    1 \"abc\n      ^\n");
  EXPECT_NE(TokenErrorOf("\"abc"), "");
  EXPECT_NE(TokenErrorOf("\"abc\\"), "");
  EXPECT_NE(TokenErrorOf("\""), "");
}

TEST(Tokenizer, LimitsTheLengthOfStringsAndWords) {
  const std::string mebibyte(1 << 20, 'x'), tooLong(10'000'000, 'x');
  EXPECT_EQ(StringOf('"' + mebibyte + '"').size(), mebibyte.size());
  EXPECT_NE(TokenErrorOf('"' + tooLong + '"').find("a string of more than 1 MiB"),
            std::string::npos);
  EXPECT_NE(TokenErrorOf("\"\\n" + tooLong + '"').find("a string of more than 1 MiB"),
            std::string::npos);
  EXPECT_NE(TokenErrorOf(tooLong).find("a word of more than 1 MiB"), std::string::npos);
  EXPECT_LT(TokenErrorOf('"' + tooLong).size(), 1000u);
}

TEST(Tokenizer, RefusesBytesThatAreNoText) {
  using namespace std::string_literals;
  EXPECT_EQ(
      TokenErrorOf("Scale \0"s),
      "scene.pbrt:1:7: error: a NUL byte: this is not a text file\n    Scale  \n          ^\n");
  EXPECT_NE(TokenErrorOf("\"a\0b\""s), "");
  EXPECT_NE(TokenErrorOf("\x80").find("unexpected byte 0x80"), std::string::npos);
  for (const std::string& text : {"\xff\xfeL\0"s, "\xfe\xff\0L"s})
    EXPECT_EQ(TokenErrorOf(text).find("scene.pbrt:1:1: error: the file is in UTF-16\n"), 0u)
        << text;
  EXPECT_NE(TokenErrorOf("1 \xff\xfe").find("unexpected byte 0xff"), std::string::npos);
  EXPECT_NE(TokenErrorOf("'").find("unexpected '''"), std::string::npos);
}

TEST(Tokenizer, SkipsByteOrderMarkCommentsAndEveryBlank) {
  EXPECT_EQ(TokensOf("\xef\xbb\xbf"
                     "1 # one [ \" \r\n2\f3\v4\t5#")
                .size(),
            5u);
  EXPECT_EQ(TokensOf("").size(), 0u);
  EXPECT_EQ(TokensOf("# only a comment").size(), 0u);
}

TEST(Tokenizer, CountsLinesAndColumnsFromOne) {
  const std::string text = "1\r\n  2 # x\n\t\"a\\\nb\" 4";
  for (const char* mark : {"", "\xef\xbb\xbf"}) {  // a byte order mark has no column
    MemorySource source({{"scene.pbrt", mark + text}});
    Tokenizer tokenizer(source, "scene.pbrt");
    const int expected[4][2] = {{1, 1}, {2, 3}, {3, 2}, {4, 4}};
    for (const auto& [line, column] : expected) {
      const SourceLocation where = tokenizer.Locate(tokenizer.Next().position);
      EXPECT_EQ(where.line, line);
      EXPECT_EQ(where.column, column);
    }
  }
}

TEST(Tokenizer, ShowsOnlyTheStartOfAVeryLongLine) {
  EXPECT_LT(TokenErrorOf("? " + std::string(5'000'000, '1')).size(), 1000u);
  EXPECT_LT(TokenErrorOf(std::string(500'000, '1') + " ?").size(), 1000u);
}

TEST(Tokenizer, ReadsGzipByItsMagicNumber) {
  const std::string text = "1 2 3 " + std::string(100'000, ' ') + "4";
  EXPECT_EQ(TokensOf(Compressed(text)).size(), 4u);
  EXPECT_EQ(TokensOf(Compressed("1 2 ") + Compressed("3")).size(), 3u);
}

TEST(Tokenizer, RefusesTruncatedAndDamagedGzip) {
  std::string bytes = Compressed("1 2 3 4 5 6 7 8 9 10 11 12");
  for (std::size_t size = 2; size < bytes.size(); ++size)
    EXPECT_THROW(Gunzip(std::string_view(bytes).substr(0, size)), SourceError) << size;
  bytes[bytes.size() - 6] = char(bytes[bytes.size() - 6] ^ 1);  // damages the checksum
  EXPECT_THROW(Gunzip(bytes), SourceError);
}

TEST(Tokenizer, SaysWhyTheSceneCannotBeRead) {
  MemorySource source({});
  try {
    Tokenizer tokenizer(source, "none.pbrt");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.Status(), ExitStatus::File);
    EXPECT_EQ(Diagnostic(error),
              "exphoton: error: cannot read the scene \"none.pbrt\": no such file\n");
  }
}

TEST(Tokenizer, DoesNotSkipTheRestOfAFileWithLineEndsOfOldMacsAtAComment) {
  EXPECT_EQ(TokensOf("# made by hand\r1 2 # two\r\r3\r").size(), 3u);
  EXPECT_EQ(TokensOf("# made by hand\r\n1 2 # two\r\n3\r\n#").size(), 3u);
  // Every kind of line end must give the same line numbers.
  for (const std::string end : {"\r", "\n", "\r\n"}) {
    const std::string text = "# first" + end + end + "Identity # third" + end + "Identty" + end;
    EXPECT_NE(ParseErrorOf(text).find("scene.pbrt:4:1: error: unknown directive Identty"),
              std::string::npos)
        << ParseErrorOf(text);
  }
}

}  // namespace
}  // namespace exphoton
