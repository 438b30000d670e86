// SPDX-License-Identifier: BSD-2-Clause
// The terminal functions query the system and the environment at each call, because a test may
// change both.
#include "core/base/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <sstream>

namespace exphoton {
namespace {

bool IsSet(const char* name) {
  const char* value = std::getenv(name);
  return value && *value;
}

}  // namespace

bool IsRedrawable() {
  const char* terminal = std::getenv("TERM");
  return isatty(STDERR_FILENO) && terminal && std::strcmp(terminal, "dumb") != 0;
}

bool UsesColor() {
  if (IsSet("NO_COLOR")) return false;
  if (IsSet("CLICOLOR_FORCE")) return std::strcmp(std::getenv("CLICOLOR_FORCE"), "0") != 0;
  return IsRedrawable();
}

int TerminalColumns() {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return size.ws_col;
}

int OutputColumns() {
  const char* given = std::getenv("COLUMNS");
  if (const int columns = given ? std::atoi(given) : 0; columns >= 40) return columns;
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return std::clamp<int>(size.ws_col, 40, 100);
}

int Characters(std::string_view text) {
  return int(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

std::string WrappedText(const std::string& text, int indent, int columns) {
  const std::string blanks(std::size_t(indent), ' ');
  std::string result, line;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!line.empty() && indent + Characters(line) + 1 + Characters(word) > columns) {
      result += blanks + line + '\n';
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return line.empty() ? result : result + blanks + line + '\n';
}

std::string Colored(const std::string& diagnostic, const std::string& severity) {
  if (!UsesColor()) return diagnostic;
  const std::size_t at = diagnostic.find(": " + severity + ": ");
  if (at == std::string::npos) return diagnostic;
  const char* color = severity == "error"     ? "\x1b[1;31m"
                      : severity == "warning" ? "\x1b[1;35m"
                                              : "\x1b[1;36m";
  const std::size_t begin = at + 2, length = severity.size() + 1;
  return diagnostic.substr(0, begin) + color + diagnostic.substr(begin, length) + "\x1b[0m" +
         diagnostic.substr(begin + length);
}

}  // namespace exphoton
