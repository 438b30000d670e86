// SPDX-License-Identifier: BSD-2-Clause
// The searches, written in terms of Real16. The including file defines Real16 and its functions for
// its SIMD target.

#include "core/spatial/nearest/nearest_distances.inl"

#include "core/spatial/nearest/nearest_candidates.inl"
#include "core/spatial/nearest/nearest_disk.inl"
#include "core/spatial/nearest/nearest_disks.inl"
#include "core/spatial/nearest/nearest_points.inl"
