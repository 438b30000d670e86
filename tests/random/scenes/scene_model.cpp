// SPDX-License-Identifier: BSD-2-Clause
// kIntegrators is the table of the integrators that SceneModel::integrator indexes.
#include "tests/random/scenes/scene_model.h"

#include <algorithm>

namespace exphoton::random_scenes {

int Colour::Max() const { return std::max({red, green, blue}); }

const std::vector<std::string> kIntegrators{
    "\"exphotonmap\"",
    "\"path\"",
    "\"photonmap\"",
    "\"exphotonmap\" \"float rrthreshold\" 0",
    "\"directlighting\" \"string strategy\" \"weighted\"",
    "\"whitted\"",
    "\"exphotonmap\" \"bool radiancephotons\" \"false\"",
    "\"exphotonmap\" \"string photonaim\" \"on\"",
    "\"exphotonmap\" \"string gathersampling\" \"bsdf\" \"string lightselection\" \"uniform\"",
    "\"photonmap\" \"bool finalgather\" \"false\"",
    "\"photonmap\" \"bool directwithphotons\" \"true\"",
    "\"exphotonmap\" \"string photonroulette\" \"maxcomponent\"",
    "\"exphotonmap\" \"string photonroulette\" \"constant\"",
    "\"path\" \"integer maxdepth\" 20",
    "\"directlighting\" \"string strategy\" \"near\"",
    "\"exphotonmap\" \"integer directlights\" 1",
    "\"guidedpath\"",
};

}  // namespace exphoton::random_scenes
