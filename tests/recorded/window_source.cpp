// SPDX-License-Identifier: BSD-2-Clause
// WindowScenes draws resolutions, crop windows, filters, samplers, cameras with their screen
// windows, and integrators that share work between pixels. The scene stays the same.
#include <array>
#include <string>

#include "tests/recorded/draw.h"
#include "tests/recorded/scene_list.h"

namespace exphoton::recorded {
namespace {

constexpr std::array<const char*, 7> kWindowIntegrators{
    "\"directlighting\"",
    "\"path\" \"integer maxdepth\" 2",
    "\"exphotonmap\" \"integer indirectphotons\" 150 \"integer causticphotons\" 50 "
    "\"integer finalgathersamples\" 4 \"bool sharedgather\" \"true\" "
    "\"integer maxphotonpaths\" 2000",
    "\"photonmap\" \"integer indirectphotons\" 150 \"integer finalgathersamples\" 3 "
    "\"integer maxphotonpaths\" 2000",
    "\"bidirectional\" \"integer maxdepth\" 2",
    "\"irradiancecache\" \"integer nsamples\" 9",
    "\"igi\" \"integer nlights\" 4 \"integer nsets\" 2"};

constexpr std::array<const char*, 6> kWindowSamplers{
    "\"lowdiscrepancy\" \"integer pixelsamples\" 2",
    "\"halton\" \"integer pixelsamples\" 3",
    "\"stratified\" \"integer xsamples\" 2 \"integer ysamples\" 3",
    "\"bestcandidate\" \"integer pixelsamples\" 3",
    "\"adaptive\" \"integer minsamples\" 2 \"integer maxsamples\" 6",
    "\"random\" \"integer xsamples\" 2 \"integer ysamples\" 1"};

constexpr std::array<const char*, 7> kWindowFilters{
    "\"box\"",
    "\"box\" \"float xwidth\" .8 \"float ywidth\" 1.7",
    "\"triangle\" \"float xwidth\" 2.3 \"float ywidth\" .6",
    "\"gaussian\" \"float xwidth\" 1.2 \"float ywidth\" 2.5 \"float alpha\" .7",
    "\"mitchell\" \"float B\" .2 \"float C\" .6 \"float xwidth\" 1.5",
    "\"sinc\" \"float tau\" 2 \"float xwidth\" 3",
    "\"gaussian\""};

constexpr std::array<const char*, 6> kCameras{
    "\"perspective\" \"float fov\" 70",
    "\"perspective\" \"float fov\" 50 \"float lensradius\" .2 \"float focaldistance\" 2",
    "\"perspective\" \"float screenwindow\" [-.9 .5 -.3 .8] \"float hither\" 1.2",
    "\"orthographic\" \"float screenwindow\" [-1.5 1 -.8 1.2] \"float yon\" 2.5",
    "\"environment\" \"float shutteropen\" .2 \"float shutterclose\" .6",
    "\"perspective\" \"float frameaspectratio\" .7 \"float lensradius\" .1 "
    "\"float focaldistance\" 3"};

// The first four are windows of the whole picture; the others crop it, some to one line of pixels.
constexpr std::array<const char*, 8> kCrops{"",
                                            "[0 1 0 1]",
                                            "[0 1 .5 1]",
                                            "[.5 1 0 1]",
                                            "[.21 .83 .13 .67]",
                                            "[.4 .45 0 1]",
                                            "[.1 .9 .58 .61]",
                                            "[.34 .99 .01 .76]"};

constexpr std::array<const char*, 4> kWindowAovs{"", "albedo,N,P,Z,uv,variance,samples", "variance",
                                                 "light,samples"};

constexpr const char* kWorld =
    "WorldBegin\n"
    "AttributeBegin\nAreaLightSource \"area\" \"color L\" [5 4 3] \"integer nsamples\" 2\n"
    "Translate .4 1.6 .2 Rotate 85 1 .1 0 Shape \"disk\" \"float radius\" .5\nAttributeEnd\n"
    "LightSource \"point\" \"color I\" [1 2 2] \"point from\" [-1.5 .5 -1]\n"
    "Texture \"board\" \"color\" \"checkerboard\" \"float uscale\" 7 \"float vscale\" 5 "
    "\"color tex1\" [.9 .6 .3] \"color tex2\" [.2 .4 .7]\n"
    "Material \"matte\" \"texture Kd\" \"board\"\n"
    "AttributeBegin\nTranslate 0 -.8 0 Rotate -90 1 0 0 Shape \"disk\" \"float radius\" 6\n"
    "AttributeEnd\n"
    "AttributeBegin\nActiveTransform EndTime Translate .3 .1 0 ActiveTransform All\n"
    "Material \"glass\" Translate -.5 0 .3 Shape \"sphere\" \"float radius\" .6\nAttributeEnd\n"
    "Material \"uber\" \"color Kd\" [.3 .6 .2] \"color opacity\" [.6 .8 .7]\n"
    "Translate .7 -.2 -.2 Rotate 30 1 1 0 Shape \"cylinder\" \"float radius\" .4\nWorldEnd\n";

RecordedScene WindowSceneOf(std::uint64_t seed) {
  Draw draw(seed + 1000);
  std::string film = "Film \"image\" \"integer xresolution\" " +
                     std::to_string(2 + draw.Below(14)) + " \"integer yresolution\" " +
                     std::to_string(2 + draw.Below(11));
  const std::string crop = draw.From(kCrops);
  if (!crop.empty()) film += " \"float cropwindow\" " + crop;
  if (draw.Below(3) == 0) film += " \"bool premultiplyalpha\" \"false\"";
  RecordedScene scene{"window/" + std::to_string(seed), film + "\n", {}};
  const auto add = [&](const char* directive, const std::string& words) {
    scene.text += std::string(directive) + " " + words + "\n";
  };
  add("SurfaceIntegrator", kWindowIntegrators[std::size_t(seed) % kWindowIntegrators.size()]);
  add("Sampler", draw.From(kWindowSamplers));
  add("PixelFilter", draw.From(kWindowFilters));
  scene.text += "LookAt .2 .4 -3 0 0 0 .1 1 0\n";
  add("Camera", draw.From(kCameras));
  scene.text += kWorld;
  std::string unknown;
  const std::string aovs = draw.From(kWindowAovs);
  if (!aovs.empty()) scene.aovs = ParseAovs(aovs, &unknown).value();
  return scene;
}

}  // namespace

std::vector<RecordedScene> WindowScenes(std::uint64_t firstSeed, std::uint64_t lastSeed) {
  return OfSeeds(firstSeed, lastSeed, WindowSceneOf);
}

}  // namespace exphoton::recorded
