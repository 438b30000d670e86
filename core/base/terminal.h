// SPDX-License-Identifier: BSD-2-Clause
// These functions query standard error: whether its lines can be redrawn and coloured. The
// environment variables have the meaning defined by https://no-color.org and
// https://bixense.com/clicolors.
#pragma once

#include <string>
#include <string_view>

namespace exphoton {

// Returns whether standard error is a terminal that can redraw a line.
bool IsRedrawable();
// Returns whether to use colour: on a redrawable terminal or with CLICOLOR_FORCE, but never with
// NO_COLOR.
bool UsesColor();
int TerminalColumns();  // of standard error; 80 if unknown
// Returns the columns of the terminal on standard output, at most 100, or 80 without a terminal.
// The environment variable COLUMNS takes precedence.
int OutputColumns();

int Characters(std::string_view text);  // of UTF-8 text

// Breaks `text` between words into lines of at most `columns` characters that begin with `indent`
// blanks. A word that is too long gets a line of its own. Each line ends with a newline.
std::string WrappedText(const std::string& text, int indent, int columns);

// Returns `diagnostic` (from FormatDiagnostic) with its severity coloured, if colours are used.
std::string Colored(const std::string& diagnostic, const std::string& severity);

}  // namespace exphoton
