// SPDX-License-Identifier: BSD-2-Clause
// Subjects are the scenes whose lost digits are measured: the runs of the catalogue of hard cases,
// with fewer samples and photons, and the files of scenes/ with few pixels.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/support/test_scene.h"

namespace exphoton::rounding {

struct Subject {
  std::string group;  // a group of hard cases, or the name of a scene
  std::string name;   // "T1 matte.2", or the name of the integrator
  std::string text;   // the scene; empty: the file
  std::string file;
};

// LeftOut names a case, or a run or script of one, that cannot be measured.
struct LeftOut {
  std::string name;
  std::string reason;
};
struct Subjects {
  std::vector<Subject> all;
  std::vector<LeftOut> leftOut;
};
// Slow cases are measured, too, because they have few pixels and photons here.
Subjects ReadHardCases();
// By path tracing. Photon maps are in the hard cases, and would take most of the time.
std::vector<Subject> ReadScenes();

// Renders `count` times with one thread and a fixed seed, and calls begin(i) before picture i. A
// hard case is loaded after each of these calls. A scene file is loaded once, before the first,
// because large meshes take longer to load than their few pixels.
std::vector<TestRender> RenderSubject(const Subject& subject, int count,
                                      const std::function<void(int)>& begin);

}  // namespace exphoton::rounding
