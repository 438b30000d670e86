// SPDX-License-Identifier: BSD-2-Clause
// An empty source. Its target owns the precompiled headers of the test programs.
