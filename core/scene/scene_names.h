// SPDX-License-Identifier: BSD-2-Clause
// SceneNames holds the names of objects and materials, by the numbers of the AOVs objectId and
// materialId. Scene files do not name shapes, so an object is called by its shape or by the object
// that it is an instance of, and by its number: "sphere_3".
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace exphoton {

class ByteArchive;

class SceneNames {
 public:
  // The first object that is added gets the number 1.
  void AddObject(const std::string& kind);
  // The name is `label` if no other material has it, and else the label with its number.
  void AddMaterial(const std::string& label, bool isNamed);

  std::uint32_t ObjectCount() const { return std::uint32_t(objects_.size()); }
  std::uint32_t MaterialCount() const { return std::uint32_t(materials_.size()); }
  std::string Object(std::uint32_t number) const;
  const std::string& Material(std::uint32_t number) const { return materials_[number - 1]; }

  void Transfer(ByteArchive* archive);  // saves or loads

 private:
  std::vector<std::string> kinds_;      // few different ones
  std::vector<std::uint32_t> objects_;  // indices of kinds_
  std::vector<std::string> materials_;
  std::set<std::string> used_;  // names of materials
};

}  // namespace exphoton
