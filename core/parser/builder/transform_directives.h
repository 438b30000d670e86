// SPDX-License-Identifier: BSD-2-Clause
// The directives that change the current transformation, as a function of the one before.
#pragma once

#include "core/parser/builder/moving_transform.h"
#include "core/parser/render_setup.h"
#include "core/parser/syntax/directive.h"

namespace exphoton {

bool IsTransformDirective(DirectiveId id);  // those of one matrix; not the named ones

// Throws Error(Scene) where the result is singular or not finite.
Transform ApplyTransform(const Transform& current, const Directive& directive, Dialect dialect);

}  // namespace exphoton
