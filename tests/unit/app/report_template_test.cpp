// SPDX-License-Identifier: BSD-2-Clause
// These tests check the templates of the report: escaping, fields, and that the templates in the
// files are exactly those that the sources fill.
#include "core/app/report/template.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <stdexcept>

namespace exphoton::study {
namespace {

namespace fs = std::filesystem;

TEST(ReportTemplate, EscapesTextButNotMarkup) {
  EXPECT_EQ(Fill("alarm", {{"text", "a < b & \"c\""}}).Markup(),
            "<span class=\"alarm\">a &lt; b &amp; &quot;c&quot;</span>");
  EXPECT_EQ(Fill("alarm", {{"text", Fill("no-chart")}}).Markup(),
            "<span class=\"alarm\">" + Fill("no-chart").Markup() + "</span>");
}

TEST(ReportTemplate, ReplacesNoNamesInValues) {
  EXPECT_EQ(Fill("alarm", {{"text", "{{text}}"}}).Markup(),
            "<span class=\"alarm\">{{text}}</span>");
}

TEST(ReportTemplate, WritesNumbersWithAtMostTwoDecimals) {
  const Html line =
      Fill("svg-line", {{"x1", 1.239}, {"y1", 2.5}, {"x2", -.001}, {"y2", 7}, {"classes", "c"}});
  EXPECT_EQ(line.Markup(), "<line x1=\"1.24\" y1=\"2.5\" x2=\"0\" y2=\"7\" class=\"c\"/>");
}

TEST(ReportTemplate, RejectsUnknownTemplatesAndFieldsThatDoNotFit) {
  EXPECT_THROW(Fill("no-such-template"), std::logic_error);
  EXPECT_THROW(Fill("alarm"), std::logic_error);
  EXPECT_THROW(Fill("alarm", {{"other", "x"}}), std::logic_error);
  EXPECT_THROW(Fill("alarm", {{"text", "x"}, {"more", "y"}}), std::logic_error);
  EXPECT_THROW(Fill("alarm", {{"text", "x"}, {"text", "y"}}), std::logic_error);
}

std::string ReadText(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

void Collect(const std::string& text, const std::regex& expression, std::set<std::string>* names) {
  for (std::sregex_iterator it(text.begin(), text.end(), expression), end; it != end; ++it)
    names->insert((*it)[1].str());
}

TEST(ReportTemplate, TheSourcesFillEveryTemplateAndNoOther) {
  const fs::path app = fs::path(EXPHOTON_SOURCE_DIR) / "core/app";
  std::set<std::string> defined, filled;
  for (const auto& entry : fs::recursive_directory_iterator(app)) {
    const fs::path& path = entry.path();
    if (path.extension() == ".html" || path.extension() == ".svg")
      Collect(ReadText(path), std::regex("<!-- template (\\S+) -->"), &defined);
    if (path.extension() == ".cpp")
      Collect(ReadText(path), std::regex("Fill\\(\\s*\"([a-z-]+)\""), &filled);
  }
  EXPECT_GT(defined.size(), 40u);
  EXPECT_EQ(defined, filled);
}

TEST(ReportTemplate, NoSourceOfTheReportWritesMarkup) {
  const fs::path report = fs::path(EXPHOTON_SOURCE_DIR) / "core/app/report";
  int checked = 0;
  for (const auto& entry : fs::recursive_directory_iterator(report)) {
    if (entry.path().extension() != ".cpp" || entry.path().filename() == "template.cpp") continue;
    ++checked;
    std::set<std::string> found;
    Collect(ReadText(entry.path()), std::regex("(\"[^\"\\n]*</?[a-z]+[ >/])"), &found);
    EXPECT_TRUE(found.empty()) << entry.path() << ": " << *found.begin();
  }
  EXPECT_GE(checked, 6);
}

}  // namespace
}  // namespace exphoton::study
