// SPDX-License-Identifier: BSD-2-Clause
// Where pictures and reports go, and the check before rendering that they can be written there.
#pragma once

#include <string>

namespace exphoton::cli {

// Throws Error(File) where `path` cannot be written. Leaves nothing behind.
void CheckWritable(const std::string& path);

// Makes the folder and those above it. Throws Error(File).
void MakeFolder(const std::string& path);

// Replaces the file in one step. Throws Error(File).
void WriteTextFile(const std::string& path, const std::string& text);

// To standard output; throws Error(File) where that fails (a full disk).
void PrintOut(const std::string& text);

}  // namespace exphoton::cli
