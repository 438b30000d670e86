// SPDX-License-Identifier: BSD-2-Clause
// These tests open the report page of a study in headless Chromium, if it is installed. The page
// must make no network request and cause no console message.
#include <unistd.h>

#include <cstdlib>
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
  // Visit holds the browser's console messages, the URLs that it requested, and the
  // DOM of the page.
  struct Visit {
    std::string console, requests, dom;
  };
  Visit Open(const std::string& browser, const std::string& page) const {
    const std::string command =
        "cd '" + Path("") + "' && HOME='" + Path("") + "' timeout 60 " + browser +
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
};

TEST_F(PageTest, AsksForNothingFromTheNetworkAndHasNoErrorInABrowser) {
  const std::string browser = FindBrowser();
  if (browser.empty())
    GTEST_SKIP() << "no chromium, chromium-browser or google-chrome: install one to run this test";
  Write("box.pbrt", SmallScene());
  const ProgramResult study = Run({"study", "box.pbrt", "--integrators", "directlighting,path",
                                   "--vary", "spp=1,4", "--seeds", "2", "--out", "out"});
  ASSERT_EQ(study.status, 0) << study.err;
  const Visit visit = Open(browser, "out/report.html");
  EXPECT_NE(visit.dom.find("<h1>On box,"), std::string::npos);
  EXPECT_EQ(visit.console, "");
  EXPECT_EQ(visit.requests, "");
  // A faulty page shows that the test would notice errors and requests.
  Write("bad.html",
        "<!DOCTYPE html><img src=\"http://example.invalid/x.png\"><script>nothing()</script>");
  const Visit bad = Open(browser, "bad.html");
  EXPECT_NE(bad.console.find("nothing is not defined"), std::string::npos) << bad.console;
  EXPECT_NE(bad.requests.find("example.invalid"), std::string::npos) << bad.requests;
}

}  // namespace
}  // namespace exphoton
