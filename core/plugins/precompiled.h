// SPDX-License-Identifier: BSD-2-Clause
// What the build compiles once for all files of a target. No file includes this header: each names
// what it uses, and a build with -DEXPHOTON_FAST_BUILD=OFF shows where one does not.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/plugin.h"
