// SPDX-License-Identifier: BSD-2-Clause
// These tests open the report page of a study in headless Chromium. The page must make no network
// request, cause no console message, and be laid out well on a desktop and on a phone. Without a
// browser they are skipped, but where CI is set they fail.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>

#include "tests/cli/program.h"

namespace exphoton {
namespace {

// Returns the path of an installed browser, or "" if there is none.
std::string FindBrowser() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
      if (access((folder + "/" + name).c_str(), X_OK) == 0) return folder + "/" + name;
  return "";
}

class PageTest : public ProgramTest {
 protected:
  void SetUp() override {
    browser_ = FindBrowser();
    if (!browser_.empty()) return;
    const char* const advice =
        "no chromium, chromium-browser or google-chrome: "
        "./dev test --browser installs one and runs this test";
    if (std::getenv("CI")) FAIL() << advice;
    GTEST_SKIP() << advice;
  }
  // Visit holds the browser's console messages, the URLs that it requested, and the
  // DOM of the page.
  struct Visit {
    std::string console, requests, dom;
  };
  Visit Open(const std::string& page, const std::string& options = "") const {
    const std::string command =
        "cd '" + Path("") + "' && HOME='" + Path("") + "' timeout 60 " + browser_ + " " + options +
        " --headless --no-sandbox --disable-gpu --user-data-dir=profile --no-first-run"
        " --disable-background-networking --disable-component-update --disable-sync"
        " --disable-extensions --disable-default-apps --disable-domain-reliability"
        " --host-resolver-rules='MAP * ~NOTFOUND' --enable-logging=stderr --log-net-log=net.json"
        " --dump-dom 'file://" +
        Path(page) + "' >dom.html 2>console.txt";
    EXPECT_EQ(std::system(command.c_str()), 0) << Read("console.txt");
    Visit visit;
    visit.dom = Read("dom.html");
    std::istringstream lines(Read("console.txt"));
    for (std::string line; std::getline(lines, line);)
      if (line.find("CONSOLE") != std::string::npos) visit.console += line + "\n";
    // The browser itself contacts its vendor for updates and for the time. These requests
    // do not count.
    const std::string log = Read("net.json");
    const std::regex url("\"url\":\"((?:https?|wss?|ftp)://([^/\"]*)[^\"]*)\"");
    const std::regex own("(.*\\.)?(google|googleapis|gvt1|gstatic)\\.com(:\\d+)?");
    for (std::sregex_iterator it(log.begin(), log.end(), url), end; it != end; ++it)
      if (!std::regex_match((*it)[2].str(), own)) visit.requests += (*it)[1].str() + "\n";
    return visit;
  }

  // Lays the page out in a viewport of this size and returns the lines of page_measure.js. The
  // viewport is a frame, because windows of browsers have a smallest width.
  std::vector<std::string> Measure(const std::string& page, int width, int height,
                                   bool opensSections) const {
    std::string text = Read(page);
    std::ifstream file(std::string(EXPHOTON_SOURCE_DIR) + "/tests/cli/page_measure.js");
    std::ostringstream script;
    script << file.rdbuf();
    text.insert(text.rfind("</body>"), "<script>" + script.str() + "</script>");
    Write("measured.html", text);
    Write("frame.html",
          "<!DOCTYPE html><body><pre id=\"lines\"></pre><script>addEventListener('message', e => "
          "document.getElementById('lines').textContent += e.data)</script><iframe width=\"" +
              std::to_string(width) + "\" height=\"" + std::to_string(height) +
              "\" src=\"measured.html" + (opensSections ? "#open" : "") + "\"></iframe>");
    const std::string dom = Open("frame.html", "--virtual-time-budget=20000").dom;
    const std::size_t start = dom.find("<pre id=\"lines\">"), end = dom.find("</pre>");
    std::vector<std::string> lines;
    if (start == std::string::npos || end == std::string::npos) return lines;
    std::istringstream stream(dom.substr(start + 16, end - start - 16));
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }

  // Makes the study of four lines with 16 settings whose page the tests look at.
  void MakeStudy() const {
    Write("box.pbrt", SmallScene());
    const ProgramResult reference = Run({"box.pbrt", "--integrator", "path", "--spp", "512",
                                         "--resolution", "48x36", "--float", "-o", "half.exr"});
    ASSERT_EQ(reference.status, 0) << reference.err;
    const ProgramResult study =
        Run({"study", "box.pbrt", "--integrators", "directlighting,path,bidirectional", "--setting",
             "three bounces of light: path maxdepth=3", "--vary", "spp=1,4,16,64", "--seeds", "3",
             "--resolution", "48x36", "--reference", "half.exr", "--out", "out"});
    ASSERT_EQ(study.status, 0) << study.err;
  }

  std::string browser_;
};

std::string LinesWith(const std::vector<std::string>& lines, const std::string& start) {
  std::string found;
  for (const std::string& line : lines)
    if (line.starts_with(start)) found += line + "\n";
  return found;
}

// Place is a part of the page: its size, and its right and lower edges.
struct Place {
  int width = 0, height = 0, right = 0, bottom = 0;
};
std::vector<Place> PlacesOf(const std::vector<std::string>& lines, const std::string& selector) {
  std::vector<Place> places;
  const std::string start = "place: " + selector + ": ";
  for (const std::string& line : lines) {
    Place p;
    if (line.starts_with(start) && std::sscanf(line.c_str() + start.size(), "%d x %d to %d %d",
                                               &p.width, &p.height, &p.right, &p.bottom) == 4)
      places.push_back(p);
  }
  return places;
}

TEST_F(PageTest, AsksForNothingFromTheNetworkAndHasNoErrorInABrowser) {
  Write("box.pbrt", SmallScene());
  const ProgramResult study = Run({"study", "box.pbrt", "--integrators", "directlighting,path",
                                   "--vary", "spp=1,4", "--seeds", "2", "--out", "out"});
  ASSERT_EQ(study.status, 0) << study.err;
  const Visit visit = Open("out/report.html");
  EXPECT_NE(visit.dom.find("<h1>On box,"), std::string::npos);
  EXPECT_EQ(visit.console, "");
  EXPECT_EQ(visit.requests, "");
  // A faulty page shows that the test would notice errors and requests.
  Write("bad.html",
        "<!DOCTYPE html><img src=\"http://example.invalid/x.png\"><script>nothing()</script>");
  const Visit bad = Open("bad.html");
  EXPECT_NE(bad.console.find("nothing is not defined"), std::string::npos) << bad.console;
  EXPECT_NE(bad.requests.find("example.invalid"), std::string::npos) << bad.requests;
}

TEST_F(PageTest, TheFirstScreenHoldsSentenceChartAndPictures) {
  MakeStudy();
  const auto lines = Measure("out/report.html", 1280, 800, false);
  EXPECT_EQ(LinesWith(lines, "viewport"), "viewport: 1280 800\n");
  // The sentence, one chart, three pictures and the reference, each with two enlarged parts.
  const std::vector<std::pair<std::string, std::size_t>> parts{{"h1", 1},
                                                               {"svg.chart", 1},
                                                               {".poster", 4},
                                                               {".poster .whole img", 4},
                                                               {".poster .crop", 8},
                                                               {".poster .crop img", 8},
                                                               {".poster .values", 3}};
  for (const auto& [selector, count] : parts) {
    const std::vector<Place> places = PlacesOf(lines, selector);
    EXPECT_EQ(places.size(), count) << selector;
    for (const Place& place : places) {
      EXPECT_LE(place.bottom, 800) << selector;
      EXPECT_LE(place.right, 1280) << selector;
      EXPECT_GT(place.height, 10) << selector;
    }
  }
  for (const Place& picture : PlacesOf(lines, ".poster .whole img")) EXPECT_GE(picture.width, 400);
  for (const Place& chart : PlacesOf(lines, "svg.chart")) EXPECT_GE(chart.width, 800);
}

TEST_F(PageTest, NoTextCoversAnotherAndNothingLeavesThePage) {
  MakeStudy();
  for (const auto& [width, height] : {std::pair(1280, 800), {900, 800}, {390, 844}}) {
    for (const bool opensSections : {false, true}) {
      const auto lines = Measure("out/report.html", width, height, opensSections);
      EXPECT_FALSE(LinesWith(lines, "texts: ").empty()) << width;
      EXPECT_EQ(LinesWith(lines, "overlap: "), "") << width << (opensSections ? " open" : "");
      EXPECT_EQ(LinesWith(lines, "outside: "), "") << width << (opensSections ? " open" : "");
    }
  }
}

TEST_F(PageTest, TheMeasuresNoticeAFaultyPage) {
  Write("bad.html",
        "<!DOCTYPE html><body style=\"margin:0\"><p>one<p style=\"margin-top:-2em\">two"
        "<div style=\"width:500px\">wide</div><details><summary>s</summary><p>three"
        "<p style=\"margin-top:-2em\">four</details></body>");
  const auto closed = Measure("bad.html", 390, 844, false);
  EXPECT_EQ(LinesWith(closed, "overlap: "), "overlap: \"one\" and \"two\"\n");
  EXPECT_NE(LinesWith(closed, "outside: ").find("DIV"), std::string::npos);
  const auto open = Measure("bad.html", 390, 844, true);
  EXPECT_NE(LinesWith(open, "overlap: ").find("\"three\" and \"four\""), std::string::npos);
}

}  // namespace
}  // namespace exphoton
