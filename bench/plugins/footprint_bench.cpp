// What an application costs before it does anything: libraries in its process, time from its start to its first
// cycle, memory. Beside a program that does the same without a framework.

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

constexpr int kToldThere = 3;
constexpr int kRuns = 40;

struct Program {
  std::string name;
  std::vector<std::string> words;  // its file first
};

struct Footprint {
  std::size_t files = 0;      // libraries and the program itself
  std::size_t own_files = 0;  // of these, Runnel's
  double mapped = 0;          // MB of them
  double own_mapped = 0;
  double resident = 0;    // MB
  double own_memory = 0;  // MB that no other process shares
  std::size_t threads = 0;
};

[[noreturn]] void Become(const Program& program, int there) {
  dup2(there, kToldThere);
  std::vector<char*> words;
  for (const std::string& each : program.words) words.push_back(const_cast<char*>(each.c_str()));
  words.push_back(nullptr);
  execv(words[0], words.data());
  _exit(127);
}

Footprint Measure(pid_t process) {
  const std::string folder = "/proc/" + std::to_string(process);
  Footprint found;
  std::map<std::string, std::size_t> files;
  std::ifstream maps(folder + "/maps");
  for (std::string line; std::getline(maps, line);) {
    const std::size_t path = line.find('/');
    if (path == std::string::npos) continue;
    std::istringstream range(line);
    std::size_t begin = 0;
    std::size_t end = 0;
    range >> std::hex >> begin;
    range.ignore();
    range >> end;
    files[line.substr(path)] += end - begin;
  }
  for (const auto& [file, bytes] : files) {
    if (file.find(".so") == std::string::npos && file.find("/bin/") == std::string::npos) continue;
    const std::string name = file.substr(file.rfind('/') + 1);
    const bool is_own = name.starts_with("librunnel_") || name.starts_with("footprint_") ||
                        file.find("/runnel/plugins/") != std::string::npos;
    found.files += 1;
    found.mapped += static_cast<double>(bytes) / 1e6;
    if (!is_own) continue;
    found.own_files += 1;
    found.own_mapped += static_cast<double>(bytes) / 1e6;
  }
  std::ifstream memory(folder + "/smaps_rollup");
  for (std::string line; std::getline(memory, line);) {
    std::istringstream words(line);
    std::string name;
    double kibibytes = 0;
    words >> name >> kibibytes;
    if (name == "Rss:") found.resident = kibibytes * 1.024e-3;
    if (name.starts_with("Private_")) found.own_memory += kibibytes * 1.024e-3;
  }
  std::ifstream status(folder + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("Threads:")) found.threads = std::stoul(line.substr(8));
  }
  return found;
}

struct Start {
  double took = 0;       // ms to the first cycle
  double computing = 0;  // ms of it, and of being measured: what a busy machine does not change much
};

Start Run(const Program& program, Footprint& footprint) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  const auto start = std::chrono::steady_clock::now();
  const pid_t process = fork();
  if (process < 0) throw std::runtime_error("no process");
  if (process == 0) Become(program, ends[1]);
  close(ends[1]);
  char byte = 0;
  const bool is_there = read(ends[0], &byte, 1) == 1;
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
  if (is_there) footprint = Measure(process);
  kill(process, SIGKILL);
  rusage used{};
  wait4(process, nullptr, 0, &used);
  close(ends[0]);
  if (!is_there) throw std::runtime_error(program.name + " has not come to its first cycle");
  const auto milliseconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_usec) / 1e3;
  };
  return {took.count(), milliseconds(used.ru_utime) + milliseconds(used.ru_stime)};
}

double Median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

}  // namespace

int main() try {
  const std::string folder = RUNNEL_FOOTPRINT_PROGRAMS;
  const std::string slim = folder + "/footprint_slim";
  const std::vector<Program> programs{{"no framework", {folder + "/footprint_bare"}},
                                      {"slim", {slim}},
                                      {"slim, traced", {slim, "tracing", "trace=/dev/null"}},
                                      {"slim, viewers", {slim, "viewers", "inspect=0"}}};
  std::vector<std::vector<double>> times(programs.size());
  std::vector<std::vector<double>> computing(programs.size());
  std::vector<Footprint> footprints(programs.size());
  // In turns, so that whatever else the machine does hits all alike.
  for (int run = 0; run < kRuns; ++run) {
    for (std::size_t i = 0; i < programs.size(); ++i) {
      const Start start = Run(programs[i], footprints[i]);
      times[i].push_back(start.took);
      computing[i].push_back(start.computing);
    }
  }
  std::printf("%-14s %8s %8s %10s %10s %8s %12s %12s %11s %11s\n", "", "files", "Runnel's", "mapped", "Runnel's",
              "threads", "first cycle", "computing", "resident", "unshared");
  for (std::size_t i = 0; i < programs.size(); ++i) {
    const Footprint& found = footprints[i];
    std::printf("%-14s %8zu %8zu %7.2f MB %7.2f MB %8zu %9.2f ms %9.2f ms %8.2f MB %8.2f MB\n",
                programs[i].name.c_str(), found.files, found.own_files, found.mapped, found.own_mapped, found.threads,
                Median(times[i]), Median(computing[i]), found.resident, found.own_memory);
  }
  std::printf(
      "files: libraries and the program; first cycle: from fork() on; medians of %d starts, in "
      "turns\n",
      kRuns);
} catch (const std::exception& error) {
  std::fprintf(stderr, "error: %s\n", error.what());
  return 1;
}
