// SPDX-License-Identifier: BSD-2-Clause
// A radiance photon lies at a photon of a map. This photon is always in the disk of its estimate,
// so a full weight makes the estimate too bright. But a gather ray reads the nearest radiance
// photon, so the circle about its hit that ends at this one holds no other. Where the circle lies
// in the disk, photons are missing. OwnPhotonWeight returns the weight of the own photon with which
// both effects cancel (docs/theory/exphotonmap.md, section 4).
#pragma once

namespace exphoton {

// Radiance photons are scattered with constant density. `inDisk` is their mean number in the disk
// of an estimate, `inReach` in the disk within which rays read one (both > 0). Returns a weight in
// [0,1], good to 1e-4.
double OwnPhotonWeight(double inDisk, double inReach);

}  // namespace exphoton
