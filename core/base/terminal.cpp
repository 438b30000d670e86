// SPDX-License-Identifier: BSD-2-Clause
// The terminal functions query the system and the environment at each call, because a test may
// change both.
#include "core/base/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>

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
