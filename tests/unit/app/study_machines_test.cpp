// SPDX-License-Identifier: BSD-2-Clause
// These tests check when the times of tasks count as comparable.
#include "core/app/analysis/headline/machines.h"

#include <gtest/gtest.h>

namespace exphoton::study {
namespace {

Results Runs(const std::vector<RunRow>& rows) {
  Results results;
  results.processor = "P";
  results.runs = rows;
  return results;
}

RunRow OfTask(const std::string& node, const std::string& processor, bool isAlone) {
  RunRow row;
  row.node = node;
  row.processor = processor;
  row.isAlone = isAlone;
  return row;
}

TEST(MachinesTest, AStudyOnOneMachineSaysNothing) {
  EXPECT_EQ(MachinesText(Runs({RunRow(), RunRow()})), "");
}

TEST(MachinesTest, EqualMachinesThatWereAloneAreComparable) {
  EXPECT_EQ(MachinesText(Runs({OfTask("a", "P", true), OfTask("b", "P", true), RunRow()})),
            "The renders ran as tasks on 2 machines. Each render had its machine for itself, and "
            "all processors are the same.");
}

TEST(MachinesTest, SharedMachinesAreNotComparable) {
  EXPECT_EQ(MachinesText(Runs({OfTask("a", "P", true), OfTask("a", "P", false)})),
            "The renders ran as tasks on 1 machine. Their times are not comparable, because other "
            "work may have run beside them.");
}

TEST(MachinesTest, DifferentProcessorsAreNotComparable) {
  for (const RunRow& other : {OfTask("b", "Q", true), OfTask("a", "Q", true)})
    EXPECT_NE(MachinesText(Runs({OfTask("a", "P", true), other}))
                  .find("not comparable, because the processors differ: P, Q."),
              std::string::npos);
  EXPECT_NE(MachinesText(Runs({OfTask("a", "Q", true), RunRow()})).find("differ: P, Q."),
            std::string::npos);
}

TEST(MachinesTest, RowsKeepTheirMachine) {
  const RunRow row = RowFromJson(RowToJson(OfTask("a", "P", true)));
  EXPECT_EQ(row.node, "a");
  EXPECT_EQ(row.processor, "P");
  EXPECT_TRUE(row.isAlone);
  EXPECT_EQ(RowToJson(RunRow()).find("node"), std::string::npos);
}

}  // namespace
}  // namespace exphoton::study
