// SPDX-License-Identifier: BSD-2-Clause
// What the build compiles once for all tests. No file includes this header; see
// core/plugins/precompiled.h.
#pragma once

#include <gtest/gtest.h>

#include "core/plugins/precompiled.h"
