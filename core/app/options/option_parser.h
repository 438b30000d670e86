// SPDX-License-Identifier: BSD-2-Clause
// OptionParser: the options of one command, its --help, and errors as usage errors. It hides CLI11,
// whose header takes seconds to compile, behind one source file.
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

// Thrown for --help and --version: the text goes to standard output, the status is 0.
struct TextRequest {
  std::string text;
};

// One declared option; each call refines it.
class OptionHandle {
 public:
  explicit OptionHandle(CLI::Option* option) : option_(option) {}

  OptionHandle& TypeName(const std::string& name);  // what --help shows for the value
  OptionHandle& DefaultText(const std::string& text);
  OptionHandle& Required();
  OptionHandle& TakeLast();   // given twice, the later value wins
  OptionHandle& OnePerUse();  // of a list: each use of the option takes one value
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
  // `name` is the command as a user types it: "exphoton compare".
  OptionParser(const std::string& description, const std::string& name);
  ~OptionParser();

  // `names` is "-o,--outfile" for an option, "scenes" for the arguments without a name. The target
  // keeps its value where the option is not given, and must outlive Parse.
  OptionHandle Add(const std::string& names, std::string& target, const std::string& help);
  OptionHandle Add(const std::string& names, int& target, const std::string& help);
  OptionHandle Add(const std::string& names, std::int64_t& target, const std::string& help);
  OptionHandle Add(const std::string& names, std::uint64_t& target, const std::string& help);
  OptionHandle Add(const std::string& names, float& target, const std::string& help);
  OptionHandle Add(const std::string& names, double& target, const std::string& help);
  OptionHandle Add(const std::string& names, std::optional<double>& target,
                   const std::string& help);
  OptionHandle Add(const std::string& names, std::vector<std::string>& target,
                   const std::string& help);
  OptionHandle AddFlag(const std::string& name, bool& target, const std::string& help);
  void AddVersion(const std::string& text);  // --version
  void Footer(const std::string& text);      // below the list of --help
  bool Has(const std::string& name) const;   // "--outfile"

  // Fills the targets. Throws TextRequest for --help and --version, a usage error for arguments
  // that the options do not allow.
  void Parse(const std::vector<std::string>& arguments);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace exphoton::cli
