// SPDX-License-Identifier: BSD-2-Clause
// OptionParser parses the options of one command, prints its --help and reports usage errors. It
// hides CLI11, whose header takes seconds to compile, behind one source file.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class Option;
}

namespace exphoton::cli {

// Thrown for --help and --version: the text goes to standard output and the exit status is 0.
struct TextRequest {
  std::string text;
};

// OptionHandle refers to a declared option. Each call refines the declaration.
class OptionHandle {
 public:
  explicit OptionHandle(CLI::Option* option) : option_(option) {}

  OptionHandle& TypeName(const std::string& name);  // placeholder for the value in --help
  OptionHandle& DefaultText(const std::string& text);
  OptionHandle& Required();
  OptionHandle& TakeLast();   // if given several times, the last value wins
  OptionHandle& OnePerUse();  // for lists: each use of the option takes one value
  OptionHandle& OneOf(const std::vector<std::string>& words);
  OptionHandle& Between(int least, int greatest);
  OptionHandle& Between(std::int64_t least, std::int64_t greatest);
  OptionHandle& Between(double least, double greatest);
  OptionHandle& AtLeastZero();
  OptionHandle& Positive();

 private:
  CLI::Option* option_;
};

class OptionParser {
 public:
  // `name` is the command as the user types it: "exphoton compare".
  OptionParser(const std::string& description, const std::string& name);
  ~OptionParser();

  // `names` is "-o,--outfile" for an option, "scenes" for positional arguments. The target keeps
  // its value if the option is not given, and must outlive Parse.
  OptionHandle Add(const std::string& names, std::string& target, const std::string& help);
  OptionHandle Add(const std::string& names, int& target, const std::string& help);
  OptionHandle Add(const std::string& names, std::int64_t& target, const std::string& help);
  OptionHandle Add(const std::string& names, std::uint64_t& target, const std::string& help);
  OptionHandle Add(const std::string& names, float& target, const std::string& help);
  OptionHandle Add(const std::string& names, double& target, const std::string& help);
  OptionHandle Add(const std::string& names, std::optional<double>& target,
                   const std::string& help);
  OptionHandle Add(const std::string& names, std::optional<std::string>& target,
                   const std::string& help);
  OptionHandle Add(const std::string& names, std::vector<std::string>& target,
                   const std::string& help);
  OptionHandle AddFlag(const std::string& name, bool& target, const std::string& help);
  void AddVersion(const std::string& text);  // declares -V and --version
  // Begins a group: the options that are added next appear under this title in --help.
  void Group(const std::string& title);
  // Texts of --help above and below the options, wrapped to the terminal. A line that begins with
  // a blank is kept as it is.
  void Header(const std::string& text);
  void Footer(const std::string& text);
  bool Has(const std::string& name) const;  // takes the full name: "--outfile"
  std::vector<std::string> Names() const;   // full names without dashes

  // Fills the targets. Throws TextRequest for --help and --version, and a usage error for invalid
  // arguments.
  void Parse(const std::vector<std::string>& arguments);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace exphoton::cli
