// SPDX-License-Identifier: BSD-2-Clause
// Data layouts written by hand must also be right in double precision, which is rarely built. Every
// build compiles this file with EXPHOTON_DOUBLE, and the compilation is the test.
#include "accelerators/bvh/traverse/traverse.h"
#include "accelerators/kd/kd_build.h"
#include "integrators/photon/gather/cone_directions.h"
#include "integrators/photon/maps/photon_map_set.h"
#include "integrators/photon/radiance/radiance_photon_map.h"

namespace exphoton {

static_assert(sizeof(Real) == sizeof(double));
template class BlockStore<PhotonBlock>;
template class PointTree<PhotonBlock>;
template class PointTree<RadianceBlock>;

}  // namespace exphoton
