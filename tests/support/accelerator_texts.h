// SPDX-License-Identifier: BSD-2-Clause
// kAccelerators lists the accelerators and settings that tests compare with brute force.
#pragma once

namespace exphoton {

inline const char* const kAccelerators[] = {
    R"("kdtree")",
    R"("kdtree" "integer maxdepth" 3)",
    R"("kdtree" "integer maxprims" 8 "float emptybonus" 0 "integer intersectcost" 1)",
    R"("bvh")",
    R"("bvh" "string vectors" "portable")",
    R"("bvh" "string vectors" "avx2")",
    R"("bvh" "integer maxprims" 2)",
    R"("bvh" "integer maxprims" 20)",
};

}  // namespace exphoton
