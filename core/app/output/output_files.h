// SPDX-License-Identifier: BSD-2-Clause
// CheckWritable checks before rendering that an output file can be written. The other functions
// write files and standard output.
#pragma once

#include <functional>
#include <string>

namespace exphoton::cli {

// Throws Error(File) if `path` cannot be written. Leaves no file behind.
void CheckWritable(const std::string& path);

// Makes the folder and its missing parents. Throws Error(File).
void MakeFolder(const std::string& path);

// Replaces the file atomically. Throws Error(File).
void WriteTextFile(const std::string& path, const std::string& text);

// Calls `write` with the path. If this fails with Error(File), calls it with a file of the same
// name in a new temporary folder, so that hours of rendering are not lost, and throws Error(File)
// with both names.
void WriteOrKeepElsewhere(const std::string& path,
                          const std::function<void(const std::string&)>& write);

// Writes to standard output. Throws Error(File) if that fails, for example on a full disk.
void PrintOut(const std::string& text);

}  // namespace exphoton::cli
