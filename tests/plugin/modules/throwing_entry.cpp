// SPDX-License-Identifier: BSD-2-Clause
// A faulty plugin for the loader's tests: it fails when it is asked what it is.
#include "core/plugin.h"

extern "C" __attribute__((visibility("default"))) const exphoton::PluginDescriptor*
ExphotonPlugin() {
  throw std::runtime_error("ask me later");
}
