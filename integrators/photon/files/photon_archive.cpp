// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/photon/files/photon_archive.h"

#include <array>
#include <cmath>
#include <map>

namespace exphoton {
namespace {

constexpr const char* kIdentity = "photon identity";

void Transfer(PhotonIdentity* identity, ByteArchive* archive) {
  identity->resize(archive->Count(identity->size(), 16));
  for (auto& [name, value] : *identity) {
    archive->Text(&name);
    archive->Text(&value);
  }
}

void Transfer(Spectrum* spectrum, ByteArchive* archive) {
  archive->Values(&spectrum->r, &spectrum->g, &spectrum->b);
}

void Transfer(Normal3* n, ByteArchive* archive) { archive->Values(&n->x, &n->y, &n->z); }

std::string Differences(const PhotonIdentity& there, const PhotonIdentity& here) {
  std::map<std::string, std::array<std::string, 2>> values;
  for (const auto& [name, value] : there) values[name][0] = value;
  for (const auto& [name, value] : here) values[name][1] = value;
  std::string texts;
  const auto shown = [](const std::string& value) { return value.empty() ? "missing" : value; };
  for (const auto& [name, both] : values)
    if (both[0] != both[1])
      texts += (texts.empty() ? "" : "; ") + name + " is " + shown(both[0]) + " there, " +
               shown(both[1]) + " here";
  return texts;
}

bool IsFinite(const RadiancePhotonSite& site) {
  Real sum = site.p.x + site.p.y + site.p.z + site.reflectance.MaxComponent() +
             site.transmittance.MaxComponent();
  for (const Normal3& n : {site.n, site.normals.smooth, site.normals.bumped})
    sum += n.x + n.y + n.z;
  return std::isfinite(sum);
}

}  // namespace

// `flag` may be uninitialised while loading.
void Transfer(bool* flag, ByteArchive* archive) {
  std::uint8_t number = archive->IsLoading() ? 0 : std::uint8_t(*flag);
  archive->Values(&number);
  *flag = number != 0;
}

void Transfer(LightTally* light, ByteArchive* archive) {
  archive->Values(&light->shot, &light->hit, &light->skipped, &light->stored, &light->caustic);
}

void Transfer(RadiancePhotonSite* site, ByteArchive* archive) {
  archive->Values(&site->p.x, &site->p.y, &site->p.z);
  Transfer(&site->n, archive);
  Transfer(&site->reflectance, archive);
  Transfer(&site->transmittance, archive);
  archive->Values(&site->glossyShare);
  Transfer(&site->isCoated, archive);
  Transfer(&site->normals.smooth, archive);
  Transfer(&site->normals.bumped, archive);
  if (archive->IsLoading() && !IsFinite(*site)) throw ArchiveError("a radiance site is not finite");
}

void WriteIdentity(const PhotonIdentity& identity, StateWriter* writer) {
  PhotonIdentity written = identity;
  ByteArchive archive;
  Transfer(&written, &archive);
  writer->Add(kIdentity, archive.Take());
}

void CheckIdentity(const StateFile& file, const PhotonIdentity& identity) {
  if (!file.Has(kIdentity)) file.FailAsDamaged("it holds no photons but the state of a render");
  PhotonIdentity there;
  file.Read(kIdentity, [&](ByteArchive* archive) { Transfer(&there, archive); });
  const std::string differences = Differences(there, identity);
  if (differences.empty()) return;
  throw Error(ExitStatus::CommandLine,
              "cannot use the photons \"" + file.Path() + "\": " + differences, {},
              "exphoton photons SCENE -o FILE shoots them again; without --photons the "
              "render shoots its own");
}

}  // namespace exphoton
