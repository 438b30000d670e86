// SPDX-License-Identifier: BSD-2-Clause
// Template texts are split at their marker lines once, when the first template is filled.
#include "core/app/report/template.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "core/app/report/embedded.h"
#include "core/base/format.h"

namespace exphoton::study {
namespace {

using Templates = std::map<std::string_view, std::string_view>;

// A marker line `<!-- template NAME -->` begins a template, which ends before the line break in
// front of the next marker or the end of the file. Text before the first marker is a comment.
void SplitTemplates(std::string_view text, Templates* templates) {
  constexpr std::string_view kStart = "<!-- template ", kEnd = " -->\n";
  for (std::size_t at = text.find(kStart); at != std::string_view::npos;) {
    const std::size_t nameAt = at + kStart.size(), nameEnd = text.find(kEnd, nameAt);
    const std::size_t bodyAt = nameEnd + kEnd.size();
    at = text.find(kStart, bodyAt);
    const std::size_t bodyEnd = std::min(at, text.size()) - 1;
    const auto name = text.substr(nameAt, nameEnd - nameAt);
    if (!templates->emplace(name, text.substr(bodyAt, bodyEnd - bodyAt)).second)
      throw std::logic_error("two templates are named \"" + std::string(name) + "\"");
  }
}

std::string_view FindTemplate(std::string_view name) {
  static const Templates kTemplates = [] {
    Templates all;
    for (const char* file : {kPageHtml, kShapesSvg, kPhotonPlotSvg}) SplitTemplates(file, &all);
    return all;
  }();
  const auto it = kTemplates.find(name);
  if (it == kTemplates.end())
    throw std::logic_error("no template is named \"" + std::string(name) + "\"");
  return it->second;
}

}  // namespace

Html Escape(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return Html(escaped);
}

std::string Coordinate(double value) {
  std::string number = Format("%.2f", std::isfinite(value) ? value : 0);
  while (number.back() == '0') number.pop_back();
  if (number.back() == '.') number.pop_back();
  return number == "-0" ? "0" : number;
}

Html Fill(std::string_view name, std::initializer_list<Field> fields) {
  const std::string_view text = FindTemplate(name);
  std::string markup;
  std::size_t used = 0, at = 0;  // `used` is a bit for each field
  for (std::size_t open; (open = text.find("{{", at)) != std::string_view::npos;) {
    markup += text.substr(at, open - at);
    const std::size_t close = text.find("}}", open);
    const std::string_view wanted = text.substr(open + 2, close - open - 2);
    const auto field = std::find_if(fields.begin(), fields.end(),
                                    [&](const Field& f) { return f.name == wanted; });
    if (field == fields.end())
      throw std::logic_error("template \"" + std::string(name) + "\" needs a value for \"" +
                             std::string(wanted) + "\"");
    markup += field->value.markup;
    used |= std::size_t(1) << (field - fields.begin());
    at = close + 2;
  }
  if (used + 1 != std::size_t(1) << fields.size())
    throw std::logic_error("template \"" + std::string(name) + "\" does not use all values");
  return Html(markup += text.substr(at));
}

Html PageStyle() { return Html(kPageCss); }

}  // namespace exphoton::study
