// SPDX-License-Identifier: BSD-2-Clause
// The header that plugin authors include. It declares every interface, the parameter table and the
// plugin descriptor. docs/development/writing-a-plugin.md shows a complete plugin.
#pragma once

#include "core/base/error.h"
#include "core/base/log.h"
#include "core/params/param_table.h"
#include "core/plugins/descriptor.h"
#include "core/plugins/kinds.h"
