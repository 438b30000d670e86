// SPDX-License-Identifier: BSD-2-Clause
// Subjects are the scenes whose lost digits are measured: the runs of the catalogue of hard cases,
// with fewer samples and photons, and the files of scenes/ with few pixels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/imaging/image.h"

namespace exphoton::rounding {

struct Subject {
  std::string group;  // a group of hard cases, or the name of a scene
  std::string name;   // "T1 matte.2", or the name of the integrator
  std::string text;   // the scene; empty: the file
  std::string file;
};

// Of cases: each run that must succeed. Slow ones, scripts and runs with other command lines are
// left out, and so is guidedpath, whose guides take minutes without vectors.
std::vector<Subject> ReadHardCases();
// By path tracing. Photon maps are in the hard cases, and would take most of the time.
std::vector<Subject> ReadScenes();

// Renders with one thread and a fixed seed.
Image RenderSubject(const Subject& subject);

}  // namespace exphoton::rounding
