// SPDX-License-Identifier: BSD-2-Clause
// OptionParser is implemented with CLI11. No other file includes CLI11.
#include "core/app/options/option_parser.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <sstream>

#include "core/app/options/values.h"
#include "core/base/terminal.h"
#include "core/params/suggestions.h"

namespace exphoton::cli {
namespace {

// Returns whether a text has the form of a whole number, even of one that does not fit 64 bits.
bool IsWholeNumber(const std::string& text) {
  const std::size_t sign = text.starts_with('-') || text.starts_with('+') ? 1 : 0;
  std::int64_t value = 0;
  return (text.size() > sign && text.find_first_not_of("0123456789", sign) == std::string::npos) ||
         CLI::detail::lexical_cast(text, value);
}

// Returns a message for a text that is no whole number. CLI11 would say "could not convert".
std::string FitsWhole(const std::string& text) {
  return IsWholeNumber(text) ? "" : '"' + text + "\" is not a whole number";
}

// Returns a message for a number that does not fit 64 bits without a sign. CLI11 would wrap it.
std::string FitsUnsigned(const std::string& text) {
  errno = 0;
  std::strtoull(text.c_str(), nullptr, 0);
  const bool fits = IsWholeNumber(text) && text.find('-') == std::string::npos && errno != ERANGE;
  return fits ? "" : text + " is not a whole number from 0 to 18446744073709551615";
}

// Returns a message for an empty value, which often comes from an unset variable of a shell.
std::string IsNotEmpty(const std::string& text) { return text.empty() ? "the value is empty" : ""; }
// Positional arguments are checked where they are used: scenes and files must exist.
CLI::Option* WithoutEmpty(CLI::Option* option) {
  return option->get_positional() ? option : option->check(IsNotEmpty);
}

bool IsNumber(const std::string& text, double* value) {
  return CLI::detail::lexical_cast(text, *value);
}
// These return a message for a text that is no number, or one out of range. CLI11 would not name
// the kind of value, and would print the largest double with all digits.
std::string FitsNumber(const std::string& text) {
  double value = 0;
  return IsNumber(text, &value) ? "" : text + " is not a number";
}
std::string FitsAtLeastZero(const std::string& text) {
  double value = 0;
  return IsNumber(text, &value) && value >= 0 ? "" : text + " is not a number of at least 0";
}
std::string FitsPositive(const std::string& text) {
  double value = 0;
  return IsNumber(text, &value) && value > 0 ? "" : text + " is not a number above 0";
}

constexpr int kHelpColumn = 28;

// Wraps a command over lines that a shell joins again.
std::string WrappedCommand(const std::string& line, std::size_t indent, int columns) {
  std::istringstream words(WrappedText(line, int(indent) + 4, columns - 2));
  std::string result;
  for (std::string part; std::getline(words, part);)
    result += (result.empty() ? part.substr(4) : " \\\n" + part);
  return result + '\n';
}

// Wraps an indented line: a command, or a command and, after two blanks, its description.
std::string WrappedIndented(const std::string& line, int columns) {
  const std::size_t indent = line.find_first_not_of(' ');
  if (Characters(line) <= columns || indent == std::string::npos) return line + '\n';
  const std::size_t gap = line.find("  ", indent);
  if (gap == std::string::npos) return WrappedCommand(line, indent, columns);
  const std::size_t column = line.find_first_not_of(' ', gap);
  return line.substr(0, column) +
         WrappedText(line.substr(column), int(column), columns).substr(column);
}

std::string WrappedLines(const std::string& text, int columns) {
  std::string result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    result += line.empty()     ? "\n"
              : line[0] == ' ' ? WrappedIndented(line, columns)
                               : WrappedText(line, 0, columns);
  return result;
}

}  // namespace

OptionHandle& OptionHandle::TypeName(const std::string& name) {
  option_->type_name(name);
  return *this;
}
OptionHandle& OptionHandle::DefaultText(const std::string& text) {
  option_->default_str(text);
  return *this;
}
OptionHandle& OptionHandle::Required() {
  option_->required();
  return *this;
}
OptionHandle& OptionHandle::TakeLast() {
  option_->take_last();
  return *this;
}
OptionHandle& OptionHandle::OnePerUse() {
  option_->allow_extra_args(false);
  return *this;
}
OptionHandle& OptionHandle::OneOf(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : "|") + word;
  option_->type_name(list);
  option_->check([words, list](const std::string& text) -> std::string {
    if (std::find(words.begin(), words.end(), text) != words.end()) return "";
    const std::string hint = DidYouMean(text, words);
    return "\"" + text + "\" is none of " + list + (hint.empty() ? "" : "; " + hint);
  });
  return *this;
}
OptionHandle& OptionHandle::Between(int least, int greatest) {
  option_->check(CLI::Range(least, greatest).description(""));
  return *this;
}
OptionHandle& OptionHandle::Between(std::int64_t least, std::int64_t greatest) {
  option_->check(CLI::Range(least, greatest).description(""));
  return *this;
}
OptionHandle& OptionHandle::Between(double least, double greatest) {
  option_->check(CLI::Range(least, greatest).description(""));
  return *this;
}
OptionHandle& OptionHandle::AtLeastZero() {
  option_->check(FitsAtLeastZero);
  return *this;
}
OptionHandle& OptionHandle::Positive() {
  option_->check(FitsPositive);
  return *this;
}

struct OptionParser::Implementation {
  Implementation(const std::string& aDescription, const std::string& aName)
      : app(aDescription, aName), description(aDescription), name(aName) {}

  std::string Help() const;
  std::string HelpOf(const CLI::Option& option, int columns) const;
  // Returns "did you mean" for the first unknown option of the arguments.
  std::string HintFor(const std::vector<std::string>& unknown) const;
  // Records an option that was added to the current group.
  OptionHandle Keep(CLI::Option* option) {
    option->group(group);
    return OptionHandle(option);
  }

  CLI::App app;
  std::string description, name, version, header, footer;
  std::string group = "Options";
  std::vector<std::string> groups{"Options"};  // in their order in --help
};

OptionParser::OptionParser(const std::string& description, const std::string& name)
    : implementation_(new Implementation(description, name)) {
  implementation_->app.set_help_flag("-h,--help", "print this text")->group("Options");
}
OptionParser::~OptionParser() = default;

OptionHandle OptionParser::Add(const std::string& names, std::string& target,
                               const std::string& help) {
  return implementation_->Keep(WithoutEmpty(implementation_->app.add_option(names, target, help)));
}
OptionHandle OptionParser::Add(const std::string& names, int& target, const std::string& help) {
  return implementation_->Keep(
      implementation_->app.add_option(names, target, help)->check(FitsWhole));
}
OptionHandle OptionParser::Add(const std::string& names, std::int64_t& target,
                               const std::string& help) {
  return implementation_->Keep(
      implementation_->app.add_option(names, target, help)->check(FitsWhole));
}
OptionHandle OptionParser::Add(const std::string& names, std::uint64_t& target,
                               const std::string& help) {
  return implementation_->Keep(
      implementation_->app.add_option(names, target, help)->check(FitsUnsigned));
}
OptionHandle OptionParser::Add(const std::string& names, float& target, const std::string& help) {
  return implementation_->Keep(
      implementation_->app.add_option(names, target, help)->check(FitsNumber));
}
OptionHandle OptionParser::Add(const std::string& names, double& target, const std::string& help) {
  return implementation_->Keep(
      implementation_->app.add_option(names, target, help)->check(FitsNumber));
}
OptionHandle OptionParser::Add(const std::string& names, std::optional<double>& target,
                               const std::string& help) {
  return implementation_->Keep(
      implementation_->app.add_option(names, target, help)->check(FitsNumber));
}
OptionHandle OptionParser::Add(const std::string& names, std::optional<std::string>& target,
                               const std::string& help) {
  return implementation_->Keep(WithoutEmpty(implementation_->app.add_option(names, target, help)));
}
OptionHandle OptionParser::Add(const std::string& names, std::vector<std::string>& target,
                               const std::string& help) {
  return implementation_->Keep(WithoutEmpty(implementation_->app.add_option(names, target, help)));
}
OptionHandle OptionParser::AddFlag(const std::string& name, bool& target, const std::string& help) {
  return implementation_->Keep(implementation_->app.add_flag(name, target, help));
}
void OptionParser::AddVersion(const std::string& text) {
  implementation_->version = text;
  implementation_->Keep(
      implementation_->app.set_version_flag("-V,--version", text, "print the version"));
}
void OptionParser::Group(const std::string& title) {
  implementation_->group = title;
  implementation_->groups.push_back(title);
}
void OptionParser::Header(const std::string& text) { implementation_->header = text; }
void OptionParser::Footer(const std::string& text) { implementation_->footer = text; }

std::vector<std::string> OptionParser::Names() const {
  std::vector<std::string> names;
  for (const CLI::Option* option : implementation_->app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back(name);
  return names;
}

bool OptionParser::Has(const std::string& name) const {
  return implementation_->app.get_option_no_throw(name) != nullptr;
}

std::string OptionParser::Implementation::HintFor(const std::vector<std::string>& unknown) const {
  std::vector<std::string> known;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& word : option->get_lnames()) known.push_back("--" + word);
  for (const std::string& word : unknown)
    if (word.starts_with("-")) return DidYouMean(word.substr(0, word.find('=')), known);
  return "";
}

std::string OptionParser::Implementation::HelpOf(const CLI::Option& option, int columns) const {
  std::string text;
  for (const std::string& word : option.get_snames()) text += (text.empty() ? "-" : ", -") + word;
  for (const std::string& word : option.get_lnames()) text += (text.empty() ? "--" : ", --") + word;
  if (option.get_positional()) text = option.get_name(true);
  const std::string type = option.get_type_size() == 0 ? "" : option.get_type_name();
  const bool isWhole = type == "INT" || type == "UINT", isText = type.empty() || type == "TEXT";
  if (!isText) text += isWhole ? " N" : type == "FLOAT" ? " X" : ' ' + type;
  std::string label = "  " + text;
  const std::string help = WrappedText(option.get_description(), kHelpColumn, columns);
  if (int(label.size()) + 2 > kHelpColumn) return label + '\n' + help;
  label.resize(kHelpColumn, ' ');
  return label + help.substr(std::min(help.size(), std::size_t(kHelpColumn)));
}

std::string OptionParser::Implementation::Help() const {
  const int columns = OutputColumns();
  std::string usage = "Usage: " + name + " [options]";
  for (const CLI::Option* option : app.get_options())
    if (option->get_positional())
      usage += option->get_required() ? ' ' + option->get_name(true)
                                      : " [" + option->get_name(true) + ']';
  std::string text = WrappedText(description, 0, columns) + usage + '\n' +
                     (header.empty() ? "" : '\n' + WrappedLines(header, columns));
  std::string positionals;
  for (const CLI::Option* option : app.get_options())
    if (option->get_positional()) positionals += HelpOf(*option, columns);
  if (!positionals.empty()) text += "\nArguments:\n" + positionals;
  for (const std::string& title : groups) {
    std::string list;
    for (const CLI::Option* option : app.get_options())
      if (!option->get_positional() && option->get_group() == title)
        list += HelpOf(*option, columns);
    if (!list.empty()) text += '\n' + title + ":\n" + list;
  }
  return text + (footer.empty() ? "" : '\n' + WrappedLines(footer, columns));
}

void OptionParser::Parse(const std::vector<std::string>& arguments) {
  CLI::App& app = implementation_->app;
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::CallForHelp&) {
    throw TextRequest{implementation_->Help()};
  } catch (const CLI::CallForVersion&) {
    throw TextRequest{implementation_->version + "\n"};
  } catch (const CLI::ExtrasError& error) {
    const std::string hint = implementation_->HintFor(app.remaining());
    FailUsage(error.what(), hint.empty() ? "--help lists the options" : hint);
  } catch (const CLI::ParseError& error) {
    // CLI11 writes "--spp: At Most 1 required but received 2".
    const std::string text = error.what();
    const std::size_t repeated = text.find(": At Most 1 required");
    FailUsage(repeated == text.npos ? text : text.substr(0, repeated) + " is given more than once",
              "--help lists the options");
  }
}

}  // namespace exphoton::cli
