// SPDX-License-Identifier: BSD-2-Clause
// How much memory there is, in words for messages. Amounts are bytes.
#pragma once

#include <string>

namespace exphoton {

// What the machine has.
double PhysicalMemory();

// What this process may use: the machine's memory, or a lower limit (ulimit -v or -d).
double UsableMemory();

// "123 MB", rounded up.
std::string Megabytes(double bytes);

// "this process may use 400 MB" where a limit is set (ulimit -v), otherwise
// "this machine has 16000 MB of memory".
std::string MemoryLimit();

// "out of memory: " and the limit, without allocating: for where the last allocation has failed.
// Valid until the next call of any thread.
const char* OutOfMemoryText();

}  // namespace exphoton
