// SPDX-License-Identifier: BSD-2-Clause
// OptionParser is implemented with CLI11. No other file includes CLI11.
#include "core/app/options/option_parser.h"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdlib>

#include "core/app/options/values.h"

namespace exphoton::cli {
namespace {

// Returns a message for a number that does not fit 64 bits without a sign. CLI11 would wrap it.
std::string FitsUnsigned(const std::string& text) {
  errno = 0;
  std::strtoull(text.c_str(), nullptr, 0);
  const bool fits = text.find('-') == std::string::npos && errno != ERANGE;
  return fits ? "" : text + " is not a whole number from 0 to 18446744073709551615";
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
  option_->check(CLI::IsMember(words));
  return *this;
}
OptionHandle& OptionHandle::Between(int least, int greatest) {
  option_->check(CLI::Range(least, greatest));
  return *this;
}
OptionHandle& OptionHandle::Between(std::int64_t least, std::int64_t greatest) {
  option_->check(CLI::Range(least, greatest));
  return *this;
}
OptionHandle& OptionHandle::Between(double least, double greatest) {
  option_->check(CLI::Range(least, greatest));
  return *this;
}
OptionHandle& OptionHandle::AtLeastZero() {
  option_->check(CLI::NonNegativeNumber);
  return *this;
}
OptionHandle& OptionHandle::Positive() {
  option_->check(CLI::PositiveNumber);
  return *this;
}

struct OptionParser::Implementation {
  Implementation(const std::string& description, const std::string& name)
      : app(description, name) {}

  CLI::App app;
  std::string version;
};

OptionParser::OptionParser(const std::string& description, const std::string& name)
    : implementation_(new Implementation(description, name)) {}
OptionParser::~OptionParser() = default;

OptionHandle OptionParser::Add(const std::string& names, std::string& target,
                               const std::string& help) {
  return OptionHandle(implementation_->app.add_option(names, target, help));
}
OptionHandle OptionParser::Add(const std::string& names, int& target, const std::string& help) {
  return OptionHandle(implementation_->app.add_option(names, target, help));
}
OptionHandle OptionParser::Add(const std::string& names, std::int64_t& target,
                               const std::string& help) {
  return OptionHandle(implementation_->app.add_option(names, target, help));
}
OptionHandle OptionParser::Add(const std::string& names, std::uint64_t& target,
                               const std::string& help) {
  return OptionHandle(implementation_->app.add_option(names, target, help)->check(FitsUnsigned));
}
OptionHandle OptionParser::Add(const std::string& names, float& target, const std::string& help) {
  return OptionHandle(implementation_->app.add_option(names, target, help));
}
OptionHandle OptionParser::Add(const std::string& names, double& target, const std::string& help) {
  return OptionHandle(implementation_->app.add_option(names, target, help));
}
OptionHandle OptionParser::Add(const std::string& names, std::optional<double>& target,
                               const std::string& help) {
  return OptionHandle(implementation_->app.add_option(names, target, help));
}
OptionHandle OptionParser::Add(const std::string& names, std::vector<std::string>& target,
                               const std::string& help) {
  return OptionHandle(implementation_->app.add_option(names, target, help));
}
OptionHandle OptionParser::AddFlag(const std::string& name, bool& target, const std::string& help) {
  return OptionHandle(implementation_->app.add_flag(name, target, help));
}
void OptionParser::AddVersion(const std::string& text) {
  implementation_->version = text;
  implementation_->app.set_version_flag("--version", text);
}
void OptionParser::Footer(const std::string& text) { implementation_->app.footer(text); }

bool OptionParser::Has(const std::string& name) const {
  return implementation_->app.get_option_no_throw(name) != nullptr;
}

void OptionParser::Parse(const std::vector<std::string>& arguments) {
  CLI::App& app = implementation_->app;
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::CallForHelp&) {
    throw TextRequest{app.help()};
  } catch (const CLI::CallForVersion&) {
    throw TextRequest{implementation_->version + "\n"};
  } catch (const CLI::ParseError& error) {
    FailUsage(error.what(), "--help lists the options");
  }
}

}  // namespace exphoton::cli
