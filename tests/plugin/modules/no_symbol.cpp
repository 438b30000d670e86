// SPDX-License-Identifier: BSD-2-Clause
// This library for the loader's tests is not a plugin. It does not export ExphotonPlugin.
extern "C" __attribute__((visibility("default"))) int SomethingElse() { return 1; }
