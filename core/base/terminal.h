// SPDX-License-Identifier: BSD-2-Clause
// These functions query standard error: whether its lines can be redrawn and coloured. The
// environment variables have the meaning defined by https://no-color.org and
// https://bixense.com/clicolors.
#pragma once

#include <string>

namespace exphoton {

// Returns whether standard error is a terminal that can redraw a line.
bool IsRedrawable();
// Returns whether to use colour: on a redrawable terminal or with CLICOLOR_FORCE, but never with
// NO_COLOR.
bool UsesColor();
int TerminalColumns();  // 80 if unknown

// Returns `diagnostic` (from FormatDiagnostic) with its severity coloured, if colours are used.
std::string Colored(const std::string& diagnostic, const std::string& severity);

}  // namespace exphoton
