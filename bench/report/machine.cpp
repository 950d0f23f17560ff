#include "bench/report/machine.h"

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

#include <sys/utsname.h>

#include "bench/report/text.h"

namespace runnel::bench {

namespace {

std::string FirstLine(const std::string& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

std::string Processor() {
  std::ifstream stream("/proc/cpuinfo");
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string Kernel() {
  utsname name{};
  uname(&name);
  return std::string(name.sysname) + " " + name.release + " " + name.machine;
}

std::string Now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[40];
  (void)std::strftime(text, sizeof(text), "%Y-%m-%d %H:%M:%S UTC", &parts);
  return text;
}

std::string Governor() {
  const std::string governor = FirstLine("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
  return governor.empty() ? "not readable" : governor;
}

std::vector<std::string> Warnings(double load, unsigned cores) {
  std::vector<std::string> warnings;
#ifndef NDEBUG
  warnings.emplace_back("assertions are on: build the preset release");
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  warnings.emplace_back("a sanitizer is on: times mean nothing");
#endif
  if (load > 0.3 * cores) {
    warnings.push_back("other work goes on here (load " + Rounded(load) + "): trust ratios, not times, and repeat");
  }
  if (cores < 2) warnings.emplace_back("one core: cases with two threads take turns");
  return warnings;
}

}  // namespace

double LoadAverage() {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? load : 0;
}

Machine ThisMachine() {
  const unsigned cores = std::thread::hardware_concurrency();
  const double load = LoadAverage();
  Machine machine;
  machine.facts = {{"processor", Processor()},
                   {"cores", std::to_string(cores)},
                   {"governor", Governor()},
                   {"kernel", Kernel()},
                   {"compiler", std::string(RUNNEL_BENCH_COMPILER)},
                   {"flags", RUNNEL_BENCH_FLAGS},
                   {"load", Rounded(load)},
                   {"time", Now()}};
  machine.warnings = Warnings(load, cores);
  return machine;
}

std::string Machine::ToString() const {
  std::string text;
  for (const auto& [name, value] : facts) {
    text += name + ":" + std::string(name.size() < 11 ? 11 - name.size() : 1, ' ') + value + "\n";
  }
  for (const std::string& warning : warnings) text += "warning:   " + warning + "\n";
  return text;
}

}  // namespace runnel::bench
