// SPDX-License-Identifier: BSD-2-Clause
// What is laid out by hand must be right in double too, a build that few make: that this compiles
// with EXPHOTON_DOUBLE, in every build, is the test.
#include "accelerators/bvh/traverse/traverse.h"
#include "accelerators/kd/kd_build.h"
#include "integrators/photon/gather/cone_directions.h"
#include "integrators/photon/maps/photon_map_set.h"
#include "integrators/photon/maps/radiance_photon_map.h"

namespace exphoton {

static_assert(sizeof(Real) == sizeof(double));
template class BlockStore<PhotonBlock>;
template class PointTree<PhotonBlock>;
template class PointTree<RadianceBlock>;

}  // namespace exphoton
