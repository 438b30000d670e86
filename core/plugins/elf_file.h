// SPDX-License-Identifier: BSD-2-Clause
// A look into a shared library without loading it: loading runs the code of its constructors.
// Source: the System V ABI, chapters "Object Files" and "Dynamic Linking"; GNU's hash table.
#pragma once

#include <optional>
#include <string>

namespace exphoton {

// Why the open file cannot be a library of this machine that exports `symbol`, as the rest of a
// sentence that begins with the file's path; nothing where it can.
std::optional<std::string> FaultOfLibrary(int file, const std::string& symbol);

}  // namespace exphoton
