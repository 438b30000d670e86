// SPDX-License-Identifier: BSD-2-Clause
// An empty source file. Its target owns the precompiled headers that plugins, the program and the
// helper libraries share.
