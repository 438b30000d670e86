// SPDX-License-Identifier: BSD-2-Clause
// ApplyTransform applies a transformation directive to the current transformation.
#pragma once

#include "core/parser/builder/moving_transform.h"
#include "core/parser/render_setup.h"
#include "core/parser/syntax/directive.h"

namespace exphoton {

bool IsTransformDirective(DirectiveId id);  // false for CoordSysTransform

// Returns the new current transformation. Throws Error(Scene) if it is singular or not finite.
Transform ApplyTransform(const Transform& current, const Directive& directive, Dialect dialect);

}  // namespace exphoton
