// SPDX-License-Identifier: BSD-2-Clause
// These functions return the amount of memory, as numbers and as text for messages. Amounts are in
// bytes.
#pragma once

#include <string>

namespace exphoton {

// Returns the physical memory of the machine.
double PhysicalMemory();

// Returns the memory that this process may use: the machine's memory, or a lower limit (ulimit -v
// or -d).
double UsableMemory();

// Returns text such as "123 MB". One MB is 2^20 bytes; the number is rounded up.
std::string Megabytes(double bytes);

// Returns "this process may use 400 MB" if a lower limit is set (ulimit -v or -d). Otherwise
// returns "this machine has 16000 MB of memory".
std::string MemoryLimit();

// Returns "out of memory: " and the text of MemoryLimit without allocating, for use after a failed
// allocation. The text is valid until the next call in any thread.
const char* OutOfMemoryText();

}  // namespace exphoton
