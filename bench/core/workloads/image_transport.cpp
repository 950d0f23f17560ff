// FINROC's table 2: a camera of 1920 x 1080 x 3 bytes at 50 images a second, filled by memcpy, and
// consumer threads that wait for each image and look at it. Each case is a process of its own, so
// that its memory is its own.

#include "bench/core/workloads/image_transport.h"

#include <array>
#include <cstdio>
#include <memory>
#include <sstream>

#include <unistd.h>

#include "bench/core/support/counted.h"
#include "bench/core/support/image_subjects.h"
#include "bench/core/workloads/workloads.h"

namespace runnel::bench {

namespace {

// Leads to this very program, even if its file has been replaced meanwhile.
std::string OwnProgram() { return "/proc/" + std::to_string(getpid()) + "/exe"; }

std::string OutputOf(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string output;
  std::array<char, 256> part{};
  while (pipe && std::fgets(part.data(), part.size(), pipe.get()) != nullptr) output += part.data();
  return output;
}

void RunInAProcess(benchmark::State& state, const ImageTransport& transport) {
  std::ostringstream command;
  command << OwnProgram() << " --image-transport '" << transport.subject << "' --readers " << transport.readers
          << " --image-seconds " << transport.seconds;
  for (auto _ : state) {
    std::istringstream output(OutputOf(command.str()));
    double cpu = 0;
    double memory = 0;
    double share = 0;
    if (!(output >> cpu >> memory >> share)) {
      state.SkipWithError("the process failed");
    } else if (share < 0.8) {
      state.SkipWithError("a fifth of the images did not arrive: the machine is too busy");
    }
    state.counters["CPU"] = cpu;
    state.counters["peak RSS"] = memory;
  }
}

void AddProcess(Suite& suite, Role role, const std::string& subject, int readers) {
  const ImageTransport transport{subject, readers, suite.settings().seconds_per_image_case};
  suite.AddProcess(role, subject, [transport](benchmark::State& state) { RunInAProcess(state, transport); });
}

}  // namespace

int RunImageTransport(const ImageTransport& transport) {
  const auto measured = MeasureImageSubject(transport);
  if (!measured) return 1;
  std::printf("%f %f %f\n", measured->cpu_percent, measured->peak_megabytes, measured->arrived);
  return 0;
}

void AddImageTransport(Suite& suite) {
  for (const int readers : {0, 1, 7, 15}) {
    suite.Start({.name = "image transport, " + Counted(static_cast<std::size_t>(readers), "consumer"),
                 .quantities = {{"CPU", "%"}, {"peak RSS", "MB"}},
                 .family = "image transport",
                 .axis = "consumers",
                 .position = static_cast<double>(readers)});
    AddProcess(suite, Role::kRunnel, kPortsSubject, readers);
    AddProcess(suite, Role::kRival, kPoolSubject, readers);
    AddProcess(suite, Role::kFloor, readers == 0 ? kFillingSubject : kWakeUpSubject, readers);
  }
}

}  // namespace runnel::bench
