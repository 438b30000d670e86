// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/analysis/headline/machines.h"

#include <algorithm>
#include <set>

namespace exphoton::study {

std::string MachinesText(const Results& results) {
  std::set<std::string> nodes, processors;
  bool areAlone = true;
  for (const RunRow& row : results.runs) {
    if (row.IsOfTask()) nodes.insert(row.node);
    processors.insert(row.IsOfTask() ? row.processor : results.processor);
    areAlone = areAlone && (row.isAlone || !row.IsOfTask());
  }
  if (nodes.empty()) return "";
  std::string text = "The renders ran as tasks on " + std::to_string(nodes.size()) +
                     (nodes.size() == 1 ? " machine. " : " machines. ");
  if (processors.size() > 1) {
    std::string names;
    for (const std::string& processor : processors)
      names += (names.empty() ? "" : ", ") + processor;
    return text + "Their times are not comparable, because the processors differ: " + names + ".";
  }
  if (!areAlone)
    return text + "Their times are not comparable, because other work may have run beside them.";
  return text + "Each render had its machine for itself, and all processors are the same.";
}

}  // namespace exphoton::study
