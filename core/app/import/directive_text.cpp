// SPDX-License-Identifier: BSD-2-Clause
// DirectiveText begins a new line for long lists, so that editors can open the scene.
#include "core/app/import/directive_text.h"

#include <charconv>

namespace exphoton::cli {

std::string ExactText(double value) {
  char text[32];
  const auto result = std::to_chars(text, text + sizeof text, value);
  return {text, result.ptr};
}

std::string QuotedText(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (c == '\n') {
      quoted += "\\n";
    } else if (c == '\r') {
      quoted += "\\r";
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

std::string NumbersText(const std::vector<double>& numbers) {
  constexpr std::size_t kNumbersInLine = 12;
  std::string text = "[";
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0) text += i % kNumbersInLine == 0 ? "\n  " : " ";
    text += ExactText(numbers[i]);
  }
  return text + "]";
}

DirectiveText::DirectiveText(const std::string& directive, const std::vector<std::string>& names)
    : text_(directive) {
  for (const std::string& name : names) text_ += " " + QuotedText(name);
}

DirectiveText& DirectiveText::Numbers(const std::string& declaration,
                                      const std::vector<double>& numbers) {
  text_ += " \"" + declaration + "\" " + NumbersText(numbers);
  return *this;
}

DirectiveText& DirectiveText::String(const std::string& declaration, const std::string& text) {
  text_ += " \"" + declaration + "\" [" + QuotedText(text) + "]";
  return *this;
}

DirectiveText& DirectiveText::Copy(const ParsedParam& param, const std::string& name) {
  const std::string declaration = param.type + " " + name;
  if (param.strings.empty()) return Numbers(declaration, param.numbers);
  text_ += " \"" + declaration + "\" [";
  for (std::size_t i = 0; i < param.strings.size(); ++i)
    text_ += (i > 0 ? " " : "") + QuotedText(param.strings[i]);
  text_ += "]";
  return *this;
}

}  // namespace exphoton::cli
