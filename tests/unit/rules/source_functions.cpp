// SPDX-License-Identifier: BSD-2-Clause
// A scan over the characters of a source keeps a stack of open scopes. The text between the last
// statement and an opening brace decides what the brace opens.
#include "tests/unit/rules/source_functions.h"

#include <algorithm>
#include <cctype>
#include <regex>
#include <stdexcept>

namespace exphoton {
namespace {

// Returns the source with blanks in place of comments, literals and preprocessor lines.
class Blanker {
 public:
  explicit Blanker(const std::string& source) : text_(source) {}

  std::string Blank() {
    while (at_ < text_.size()) {
      if (StartsWith("//"))
        BlankTo(text_.find('\n', at_));
      else if (StartsWith("/*"))
        BlankTo(End(text_.find("*/", at_ + 2), 2));
      else if (StartsWith("R\"") && !FollowsName())
        BlankRawString();
      else if (text_[at_] == '"' || (text_[at_] == '\'' && !FollowsName()))
        BlankLiteral(text_[at_]);
      else if (text_[at_] == '#' && IsFirstOfLine())
        BlankDirective();
      else
        ++at_;
    }
    return text_;
  }

 private:
  bool StartsWith(const char* start) const { return text_.compare(at_, 2, start) == 0; }

  // An apostrophe after a digit separates digits, and R after a letter is part of a name.
  bool FollowsName() const {
    return at_ > 0 && std::isalnum(static_cast<unsigned char>(text_[at_ - 1]));
  }

  bool IsFirstOfLine() const {
    const std::size_t last = text_.find_last_not_of(" \t", at_ == 0 ? 0 : at_ - 1);
    return at_ == 0 || last == std::string::npos || text_[last] == '\n';
  }

  static std::size_t End(std::size_t found, std::size_t length) {
    return found == std::string::npos ? found : found + length;
  }

  void BlankTo(std::size_t end) {
    for (end = std::min(end, text_.size()); at_ < end; ++at_)
      if (text_[at_] != '\n') text_[at_] = ' ';
  }

  void BlankRawString() {
    const std::size_t open = text_.find('(', at_);
    const std::string close = ")" + text_.substr(at_ + 2, open - at_ - 2) + "\"";
    BlankTo(End(text_.find(close, open), close.size()));
  }

  void BlankLiteral(char quote) {
    std::size_t end = at_ + 1;
    while (end < text_.size() && text_[end] != quote) end += text_[end] == '\\' ? 2 : 1;
    BlankTo(end + 1);
  }

  void BlankDirective() {
    std::size_t end = text_.find('\n', at_);
    while (end != std::string::npos && text_[end - 1] == '\\') end = text_.find('\n', end + 1);
    BlankTo(end);
  }

  std::string text_;
  std::size_t at_ = 0;
};

enum class Scope { Declarations, Function, Other };

// A parameter list comes before any '=', except the '=' in the name of an operator.
std::size_t FindParameters(const std::string& head) {
  const std::size_t name = head.find("operator");
  const std::size_t start = name == std::string::npos ? 0 : name + 8;
  std::size_t open = head.find('(', start);
  if (name != std::string::npos && head.compare(start, 3, "()(") == 0) open = start + 2;
  const std::size_t assigned = name == std::string::npos ? head.find('=') : std::string::npos;
  return open < assigned ? open : std::string::npos;
}

int CountArguments(const std::string& head, std::size_t open) {
  int depth = 0, commas = 0;
  std::size_t at = open + 1;
  bool isEmpty = true;
  for (; at < head.size() && (head[at] != ')' || depth > 0); ++at) {
    if (std::string("(<[{").find(head[at]) != std::string::npos) ++depth;
    if (std::string(")>]}").find(head[at]) != std::string::npos) --depth;
    if (head[at] == ',' && depth == 0) ++commas;
    if (head[at] != ' ') isEmpty = false;
  }
  return isEmpty ? 0 : commas + 1;
}

class Scanner {
 public:
  explicit Scanner(const std::string& source) : text_(Blanker(source).Blank()) {}

  std::vector<SourceFunction> Scan() {
    for (at_ = 0; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '\n') ++line_;
      if (c == '(') ++parentheses_;
      if (c == ')') --parentheses_;
      if (c == '{')
        Open();
      else if (c == '}')
        Close();
      else if (c == ';' && parentheses_ == 0)
        head_.clear();
      else
        AddToHead(c == '\n' ? ' ' : c);
    }
    if (!scopes_.empty()) throw std::runtime_error("an opening brace has no closing one");
    return functions_;
  }

 private:
  bool IsInDeclarations() const {
    return std::all_of(scopes_.begin(), scopes_.end(),
                       [](Scope scope) { return scope == Scope::Declarations; });
  }

  void AddToHead(char c) {
    if (head_.empty() && c == ' ') return;
    if (head_.empty()) headLine_ = line_;
    head_ += c;
    if (head_ == "public:" || head_ == "private:" || head_ == "protected:") head_.clear();
  }

  // A brace without a blank before it belongs to an expression, such as an initialised member.
  Scope Classify() const {
    if (!IsInDeclarations() || parentheses_ > 0 || head_.empty()) return Scope::Other;
    static const std::regex kTemplate("^template <[^{]*?> (?=[a-zA-Z])");
    static const std::regex kNamespace("^(inline )?namespace\\b|^extern\\s*$");
    static const std::regex kType("^(enum |class |struct |union )"), kArguments("\\w\\(.*\\) $");
    const std::string head = std::regex_replace(head_, kTemplate, "");
    if (std::regex_search(head, kNamespace)) return Scope::Declarations;
    const std::size_t parameters = FindParameters(head_);
    if (std::regex_search(head, kType) && !std::regex_search(head, kArguments))
      return Scope::Declarations;
    if (head_.back() != ' ' || parameters == std::string::npos) return Scope::Other;
    return Scope::Function;
  }

  void Open() {
    const Scope scope = Classify();
    if (scope == Scope::Function) AddFunction();
    scopes_.push_back(scope);
    if (scope == Scope::Other && IsKept())
      head_ += '{';
    else
      head_.clear();
    kept_.push_back(scope == Scope::Other && !head_.empty());
  }

  // Initialisers of members and default arguments are part of a function's head.
  bool IsKept() const {
    return std::all_of(scopes_.begin(), scopes_.end() - 1,
                       [](Scope scope) { return scope == Scope::Declarations; });
  }

  void Close() {
    if (scopes_.empty()) throw std::runtime_error("a closing brace has no opening one");
    const Scope scope = scopes_.back();
    const bool isKept = kept_.back();
    scopes_.pop_back();
    kept_.pop_back();
    if (scope == Scope::Function && IsInDeclarations())
      functions_.back().lines = line_ - functions_.back().line + 1;
    if (isKept && IsInDeclarations())
      head_ += '}';
    else
      head_.clear();
  }

  // Only constructors and destructors have no type in front of their names.
  static bool HasNoType(const std::string& front) {
    static const std::regex kNoType("(template <.*> )?(explicit |constexpr |inline )*");
    return std::regex_match(front, kNoType);
  }

  void AddFunction() {
    const std::size_t open = FindParameters(head_);
    std::size_t start = open;
    const std::size_t name = head_.find("operator");
    if (name != std::string::npos && name < open)
      start = name;
    else
      while (start > 0 && (std::isalnum(static_cast<unsigned char>(head_[start - 1])) ||
                           std::string("_:~").find(head_[start - 1]) != std::string::npos))
        --start;
    SourceFunction function;
    function.name = head_.substr(start, open - start);
    function.line = headLine_;
    function.arguments = CountArguments(head_, open);
    static const std::regex kMacro("[A-Z_]{3,}");
    const bool isMacro = std::regex_match(function.name, kMacro);
    function.isConstructor = start != name && !isMacro && HasNoType(head_.substr(0, start));
    functions_.push_back(function);
  }

  const std::string text_;
  std::vector<SourceFunction> functions_;
  std::vector<Scope> scopes_;
  std::vector<bool> kept_;  // for each scope: whether its braces are part of a head
  std::string head_;
  std::size_t at_ = 0;
  int line_ = 1, headLine_ = 1, parentheses_ = 0;
};

}  // namespace

std::vector<SourceFunction> FindFunctions(const std::string& source) {
  return Scanner(source).Scan();
}

std::string BlankLiterals(const std::string& source) { return Blanker(source).Blank(); }

}  // namespace exphoton
