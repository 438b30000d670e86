// SPDX-License-Identifier: BSD-2-Clause
// The headers that the build precompiles once for all files of a target. No file includes this
// header, because each file includes the headers that it uses. A build with
// -DEXPHOTON_FAST_BUILD=OFF reveals missing includes.
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
