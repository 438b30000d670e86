// SPDX-License-Identifier: BSD-2-Clause
// Inspects a shared library without loading it, because loading runs its constructors. Source: the
// System V ABI, chapters "Object Files" and "Dynamic Linking"; the GNU hash table.
#pragma once

#include <optional>
#include <string>

namespace exphoton {

struct LibraryFault {
  std::string text;        // continues a sentence that begins with the file's path
  bool isForeign = false;  // a sound library without the symbol, probably of another program
};

// Returns the reason why the open file cannot be a library of this machine that exports `symbol`.
// Returns nullopt if the file is such a library.
std::optional<LibraryFault> FaultOfLibrary(int file, const std::string& symbol);

}  // namespace exphoton
