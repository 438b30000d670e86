// SPDX-License-Identifier: BSD-2-Clause
// Fill makes markup from the templates in page.html, shapes.svg and photon_plot.svg, which
// the build embeds. A template replaces each {{name}} by a value. Escaping happens only here:
// text is escaped, and markup made by Fill is inserted as it is.
#pragma once

#include <concepts>
#include <initializer_list>
#include <string>
#include <string_view>

namespace exphoton::study {

// Html is markup: complete HTML or SVG elements, or escaped text.
class Html {
 public:
  Html() = default;
  explicit Html(std::string markup) : markup_(std::move(markup)) {}
  const std::string& Markup() const { return markup_; }
  bool IsEmpty() const { return markup_.empty(); }
  Html& operator+=(const Html& other) {
    markup_ += other.markup_;
    return *this;
  }
  friend Html operator+(Html a, const Html& b) { return a += b; }

 private:
  std::string markup_;
};

Html Escape(std::string_view text);
std::string Coordinate(double value);  // at most two decimals

// Value is what replaces a name. Text is escaped, and numbers have at most two decimals.
struct Value {
  Value(const Html& html) : markup(html.Markup()) {}
  Value(const std::string& text) : markup(Escape(text).Markup()) {}
  Value(const char* text) : markup(Escape(text).Markup()) {}
  Value(double number) : markup(Coordinate(number)) {}
  Value(std::integral auto number) : markup(std::to_string(number)) {}
  std::string markup;
};

struct Field {
  std::string_view name;
  Value value;
};

// Throws std::logic_error if no template has this name, or if the fields are not exactly the names
// in the template.
Html Fill(std::string_view name, std::initializer_list<Field> fields = {});

// Returns the style sheet of the report.
Html PageStyle();

}  // namespace exphoton::study
