// SPDX-License-Identifier: BSD-2-Clause
// The searches, in terms of vectors of sixteen (Real16 and what goes with it), which the including
// file defines for its instructions.

#include "core/spatial/nearest/nearest_distances.inl"

#include "core/spatial/nearest/nearest_candidates.inl"
#include "core/spatial/nearest/nearest_disk.inl"
#include "core/spatial/nearest/nearest_disks.inl"
#include "core/spatial/nearest/nearest_points.inl"
