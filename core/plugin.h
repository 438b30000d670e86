// SPDX-License-Identifier: BSD-2-Clause
// The header that a plugin's author includes: every interface, the parameter table and the
// descriptor. docs/development/writing-a-plugin.md shows a whole plugin.
#pragma once

#include "core/base/error.h"
#include "core/base/log.h"
#include "core/params/param_table.h"
#include "core/plugins/descriptor.h"
#include "core/plugins/kinds.h"
