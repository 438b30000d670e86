// SPDX-License-Identifier: BSD-2-Clause
// This plugin for the loader's tests is faulty on purpose. Its entry function throws an exception.
#include "core/plugin.h"

extern "C" __attribute__((visibility("default"))) const exphoton::PluginDescriptor*
ExphotonPlugin() {
  throw std::runtime_error("ask me later");
}
