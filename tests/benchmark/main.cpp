// SPDX-License-Identifier: BSD-2-Clause
// bench_kernels is the benchmark program: bench_kernels [--floors FILE] [--tables FILE] [options of
// Google Benchmark, for example --benchmark_filter=^rays/]. Exit status 1: a ratio is below its
// floor.
#include <benchmark/benchmark.h>

#include <exception>
#include <iostream>

#include "tests/benchmark/parts.h"
#include "tests/benchmark/report.h"

namespace exphoton {
namespace {

// Reporter prints each contest when it is over.
class Reporter final : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (!run.error_occurred) continue;
      std::cerr << run.benchmark_name() << ": " << run.error_message << "\n";
      hasFailed_ = true;
    }
    for (; printed_ < Outcomes().size(); ++printed_) PrintOutcome(Outcomes()[printed_], std::cout);
  }
  bool HasFailed() const { return hasFailed_; }

 private:
  std::size_t printed_ = 0;
  bool hasFailed_ = false;
};

// Removes "--name value" from the arguments and returns the value, or "" if it is missing.
std::string Take(const std::string& name, int* argc, char** argv) {
  for (int i = 1; i + 1 < *argc; ++i) {
    if (argv[i] != name) continue;
    const std::string value = argv[i + 1];
    for (int j = i + 2; j <= *argc; ++j) argv[j - 2] = argv[j];
    *argc -= 2;
    return value;
  }
  return "";
}

int Main(int argc, char** argv) {
  const std::string floors = Take("--floors", &argc, argv);
  const std::string tables = Take("--tables", &argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  AddRays();
  AddLookups();
  AddBuilds();
  AddParsing();
  Reporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  if (reporter.HasFailed()) return 1;
  if (!tables.empty()) ReplaceTables(tables, MarkdownTables());
  return !floors.empty() && CheckFloors(floors, std::cerr) > 0 ? 1 : 0;
}

}  // namespace
}  // namespace exphoton

int main(int argc, char** argv) {
  try {
    return exphoton::Main(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "bench: " << error.what() << "\n";
    return 1;
  }
}
