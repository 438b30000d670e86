// SPDX-License-Identifier: BSD-2-Clause
// From here on the instructions that every machine has.
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
