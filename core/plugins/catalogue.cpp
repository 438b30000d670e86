// SPDX-License-Identifier: BSD-2-Clause
// The plugin catalogue as text for a terminal and as Markdown.
#include "core/plugins/catalogue.h"

#include <algorithm>
#include <vector>

#include "core/base/terminal.h"
#include "core/params/suggestions.h"

namespace exphoton {
namespace {

constexpr int kPageColumns = 96;

struct Entry {
  std::string name, summary;
  PluginKind kind;
  const ParamTableBase* parameters;
};

std::vector<Entry> EntriesOf(PluginRegistry& registry, PluginKind kind) {
  std::vector<Entry> entries;
  for (const std::string& name : registry.Available(kind)) {
    const PluginFactory& factory = registry.Find(kind, name, {});
    entries.push_back({name, registry.Load(kind, name, {}).summary, kind, factory.parameters});
  }
  return entries;
}

PluginKind KindAt(int index) { return static_cast<PluginKind>(index); }

std::string Plural(PluginKind kind) { return std::string(PluginKindName(kind)) + 's'; }

std::string Capitalized(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = char(text[0] - 'a' + 'A');
  return text;
}

// Returns the text of the default column: the default, "required", or "automatic" if the plugin
// chooses.
std::string DefaultColumn(const ParamDecl& decl) {
  if (decl.isRequired) return "required";
  return decl.defaultText.empty() ? "automatic" : decl.defaultText;
}

std::string RangeColumn(const ParamDecl& decl) {
  std::string text = decl.type == ParamType::File ? "a file" : RangeText(decl);
  for (const std::string& choice : decl.choices) {
    text += (text.empty() ? "\"" : ", \"") + choice + '"';
  }
  if (!decl.unit.empty()) text += (text.empty() ? "in " : ", in ") + decl.unit;
  return text;
}

std::string MeaningColumn(const ParamDecl& decl) {
  if (!decl.namedDefault) return decl.doc;
  return decl.doc + "; default where --integrator names this integrator: " +
         std::to_string(int(*decl.namedDefault));
}

// The parameters of a plugin in two parts: basic and further ones. Without basic parameters, all
// are in the first part.
struct Parts {
  std::vector<ParamDecl> basic, further;
};

Parts PartsOf(const ParamTableBase& table) {
  Parts parts;
  for (const ParamDecl& decl : table.Declarations())
    (decl.isBasic ? parts.basic : parts.further).push_back(decl);
  if (parts.basic.empty()) parts.basic.swap(parts.further);
  return parts;
}

constexpr const char* kFurther = "Further parameters, and switches for research";

// Returns a cell of a Markdown table. It escapes '|', which would end the cell, and '<', which
// would begin a tag.
std::string Cell(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '|' || c == '<') result += '\\';
    result += c;
  }
  return result.empty() ? " " : ' ' + result + ' ';
}

std::string MarkdownRows(const std::vector<ParamDecl>& declarations) {
  std::string text =
      "| parameter | type | default | range | meaning |\n| --- | --- | --- | --- | --- |\n";
  for (const ParamDecl& decl : declarations) {
    const std::string value = DefaultColumn(decl);
    const bool isLiteral = !decl.isRequired && !decl.defaultText.empty();
    text += "| `" + decl.name + "` |" + Cell(ParamTypeName(decl.type)) + '|' +
            (isLiteral ? " `" + value + "` " : Cell(value)) + '|' + Cell(RangeColumn(decl)) + '|' +
            Cell(MeaningColumn(decl)) + "|\n";
  }
  return text;
}

std::string MarkdownTable(const ParamTableBase& table) {
  if (table.Declarations().empty()) return "No parameters.\n";
  const Parts parts = PartsOf(table);
  std::string text = MarkdownRows(parts.basic);
  if (!parts.further.empty())
    text += std::string("\n") + kFurther + ":\n\n" + MarkdownRows(parts.further);
  return text;
}

std::string PageOf(PluginRegistry& registry, const std::string& folder) {
  std::string text =
      "<!-- Generated from the plugins' own declarations by `exphoton plugins --write-reference`. "
      "-->\n\n"
      "# " +
      Capitalized(folder) + '\n';
  for (int i = 0; i < kPluginKindCount; ++i) {
    if (PluginKindFolder(KindAt(i)) != folder) continue;
    for (const Entry& entry : EntriesOf(registry, KindAt(i))) {
      text += "\n## " + Capitalized(PluginKindName(entry.kind)) + " `" + entry.name + "`\n\n" +
              Capitalized(entry.summary) + ".\n\n" + MarkdownTable(*entry.parameters);
    }
  }
  return text;
}

std::string ParameterList(const std::vector<ParamDecl>& declarations) {
  const int columns = OutputColumns();
  std::string text;
  for (const ParamDecl& decl : declarations) {
    const std::string range = RangeColumn(decl);
    text += "\n  ";
    text += ParamTypeName(decl.type);
    text += ' ' + decl.name + "  " + DefaultColumn(decl);
    if (!range.empty()) text += "  (" + range + ')';
    text += '\n' + WrappedText(MeaningColumn(decl), 6, columns);
  }
  return text;
}

}  // namespace

std::string ListPlugins(PluginRegistry& registry) {
  const int columns = OutputColumns();
  std::string text;
  for (int i = 0; i < kPluginKindCount; ++i) {
    const std::vector<Entry> entries = EntriesOf(registry, KindAt(i));
    if (entries.empty()) continue;
    if (!text.empty()) text += '\n';
    text += Plural(KindAt(i)) + '\n';
    std::size_t width = 0;
    for (const Entry& entry : entries) width = std::max(width, entry.name.size());
    for (const Entry& entry : entries) {
      const std::string lines = WrappedText(entry.summary, int(width) + 4, columns);
      text += "  " + entry.name + std::string(width - entry.name.size() + 2, ' ') +
              lines.substr(std::min(lines.size(), width + 4));
    }
  }
  return text;
}

std::string DescribePlugin(PluginRegistry& registry, const std::string& name) {
  std::string text;
  std::vector<std::string> known;
  for (int i = 0; i < kPluginKindCount; ++i) {
    for (const Entry& entry : EntriesOf(registry, KindAt(i))) {
      known.push_back(entry.name);
      if (entry.name != name) continue;
      if (!text.empty()) text += '\n';
      text += PluginKindName(entry.kind);
      text += " \"" + name + "\": " + entry.summary + '\n';
      const Parts parts = PartsOf(*entry.parameters);
      text += parts.basic.empty() ? "\n  no parameters\n" : ParameterList(parts.basic);
      if (!parts.further.empty())
        text += std::string("\n") + kFurther + ":\n" + ParameterList(parts.further);
    }
  }
  if (text.empty()) {
    throw Error(ExitStatus::CommandLine, "there is no plugin \"" + name + '"', {},
                DidYouMean(name, known));
  }
  return text;
}

std::map<std::string, std::string> ReferencePages(PluginRegistry& registry) {
  std::map<std::string, std::string> pages;
  std::string index =
      "<!-- Generated from the plugins' own declarations by `exphoton plugins --write-reference`. "
      "-->\n\n"
      "# Reference: the plugins and their parameters\n\n";
  for (int i = 0; i < kPluginKindCount; ++i) {
    const std::string folder = PluginKindFolder(KindAt(i)), file = folder + ".md";
    if (!pages.count(file)) pages[file] = PageOf(registry, folder);
    std::string names;
    for (const Entry& entry : EntriesOf(registry, KindAt(i))) {
      names += (names.empty() ? "`" : ", `") + entry.name + '`';
    }
    // The lines after the first are indented, as Markdown wants it for one item of a list.
    if (!names.empty())
      index += WrappedText("- [" + Capitalized(Plural(KindAt(i))) + "](" + file + "): " + names, 2,
                           kPageColumns)
                   .substr(2);
  }
  pages["README.md"] = index;
  return pages;
}

}  // namespace exphoton
