// SPDX-License-Identifier: BSD-2-Clause
// A faulty plugin for the loader's tests: it does not say what it is.
#include "core/plugin.h"

extern "C" __attribute__((visibility("default"))) const exphoton::PluginDescriptor*
ExphotonPlugin() {
  return nullptr;
}
