// SPDX-License-Identifier: BSD-2-Clause
// What standard error is: whether lines on it can be redrawn and coloured. https://no-color.org and
// https://bixense.com/clicolors say what the environment variables mean.
#pragma once

#include <string>

namespace exphoton {

// A terminal on which a line can be drawn again.
bool IsRedrawable();
// Colours: a redrawable terminal, or CLICOLOR_FORCE; never with NO_COLOR.
bool UsesColor();
int TerminalColumns();  // 80 where unknown

// `diagnostic` (of FormatDiagnostic) with its severity coloured, if colours are used.
std::string Colored(const std::string& diagnostic, const std::string& severity);

}  // namespace exphoton
