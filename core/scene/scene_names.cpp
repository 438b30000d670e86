// SPDX-License-Identifier: BSD-2-Clause
// SceneNames stores each kind of object once, because a scene can have millions of objects.
#include "core/scene/scene_names.h"

#include <algorithm>

#include "core/files/byte_archive.h"

namespace exphoton {
namespace {

void TransferTexts(std::vector<std::string>* texts, ByteArchive* archive) {
  texts->resize(archive->Count(texts->size(), 8));
  for (std::string& text : *texts) archive->Text(&text);
}

}  // namespace

void SceneNames::AddObject(const std::string& kind) {
  const auto found = std::find(kinds_.begin(), kinds_.end(), kind);
  objects_.push_back(std::uint32_t(found - kinds_.begin()));
  if (found == kinds_.end()) kinds_.push_back(kind);
}

void SceneNames::AddMaterial(const std::string& label, bool isNamed) {
  const std::string number = "_" + std::to_string(materials_.size() + 1);
  std::string name = isNamed ? label : label + number;
  while (!used_.insert(name).second) name += number;
  materials_.push_back(std::move(name));
}

std::string SceneNames::Object(std::uint32_t number) const {
  return kinds_[objects_[number - 1]] + "_" + std::to_string(number);
}

void SceneNames::Transfer(ByteArchive* archive) {
  TransferTexts(&kinds_, archive);
  archive->List(&objects_);
  TransferTexts(&materials_, archive);
  for (const std::uint32_t kind : objects_)
    if (kind >= kinds_.size()) throw ArchiveError("an object has no name");
}

}  // namespace exphoton
