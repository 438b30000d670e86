// SPDX-License-Identifier: BSD-2-Clause
// DirectiveText composes the text of one directive of a scene file. Numbers are written with the
// fewest digits that read back as the same double.
#pragma once

#include <string>
#include <vector>

#include "core/params/param_set.h"

namespace exphoton::cli {

std::string ExactText(double value);
std::string QuotedText(const std::string& text);  // with escapes
std::string NumbersText(const std::vector<double>& numbers);

class DirectiveText {
 public:
  DirectiveText(const std::string& directive, const std::vector<std::string>& names);

  DirectiveText& Numbers(const std::string& declaration, const std::vector<double>& numbers);
  DirectiveText& Number(const std::string& declaration, double number) {
    return Numbers(declaration, {number});
  }
  DirectiveText& String(const std::string& declaration, const std::string& text);
  // Writes the parameter under this name and with its own type and values.
  DirectiveText& Copy(const ParsedParam& param, const std::string& name);

  // Returns the directive with the line end.
  std::string Text() const { return text_ + "\n"; }

 private:
  std::string text_;
};

}  // namespace exphoton::cli
