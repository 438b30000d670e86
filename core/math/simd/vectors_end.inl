// SPDX-License-Identifier: BSD-2-Clause
// This file ends the code of a SIMD target. The code after it uses only instructions of every
// machine.
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
