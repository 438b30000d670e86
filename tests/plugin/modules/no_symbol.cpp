// SPDX-License-Identifier: BSD-2-Clause
// A library for the loader's tests that is no plugin.
extern "C" __attribute__((visibility("default"))) int SomethingElse() { return 1; }
