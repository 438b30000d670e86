// SPDX-License-Identifier: BSD-2-Clause
// ObjectGeometry: construction and destruction, which would be long in every file that includes the
// header.
#include "core/scene/aggregate.h"

namespace exphoton {

ObjectGeometry::ObjectGeometry(std::unique_ptr<PrimitiveSet> set,
                               std::unique_ptr<Aggregate> aggregate)
    : set_(std::move(set)), aggregate_(std::move(aggregate)) {}
ObjectGeometry::~ObjectGeometry() = default;

}  // namespace exphoton
