// How long it takes until readers of a driving port find its safe value, whatever else goes on: from a request for STOP,
// by each way, and from the end of a dead-man's deadline. Prints a table for each, in milliseconds; each row has as many
// tries as are asked for: bench_stop [TRIES [TEXT]], 1000 by default, and only rows with the text in their name or table's.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <thread>
#include <utility>

#include "bench/plugins/stop/loads.h"
#include "bench/plugins/stop/ways.h"

namespace runnel::bench {
namespace {

using namespace std::chrono_literals;

void PrintHead(const std::string& what) {
  std::printf("\n%-56s %6s %9s %9s %9s\n", (what + " (ms)").c_str(), "tries", "p50", "p99", "max");
}

void PrintRow(const Load& load, std::vector<double> times) {
  std::ranges::sort(times);
  const auto at = [&](double part) {
    const auto place = static_cast<std::size_t>(part * static_cast<double>(times.size()));
    return times[std::min(times.size() - 1, place)];
  };
  std::printf("%-56s %6zu %9.3f %9.3f %9.3f\n", load.name.c_str(), times.size(), at(0.5), at(0.99), times.back());
  std::fflush(stdout);
}

/// False: that way cannot be had.
bool MeasureStop(const KindOfWay& kind, const Load& load, int tries) {
  loads_end = false;
  Robot robot(load.driver);
  TaskGroup tasks(robot.service->worker());
  const auto way = kind.make(robot, load.fills_page);
  if (way == nullptr) return false;
  std::vector<double> times;
  {
    const Burden burden(load, robot);
    while (static_cast<int>(times.size()) < tries) {
      robot.Drive();
      std::ranges::copy(way->Press(), std::back_inserter(times));
      (void)robot.service->Begin(RobotStopRequest{false, "bench"}, tasks);
    }
  }
  PrintRow(load, std::move(times));
  return true;
}

// All bases are driven before the load begins, and not heard of again. Their deadlines end one after the other.
void MeasureDeadMan(const Load& load, int tries) {
  constexpr Duration kFirst = 250ms;
  constexpr Duration kStep = 5ms;
  loads_end = false;
  Robot robot(load.driver);
  TaskGroup tasks(robot.service->worker());
  std::vector<double> times;
  for (int round = 0; static_cast<int>(times.size()) < tries; ++round) {
    std::vector<std::pair<const Base*, SteadyClock::time_point>> driven;  // and when each has to stand
    for (std::size_t i = 0; i < robot.bases.size(); ++i) {
      const Duration deadline = kFirst + static_cast<int>(i) * kStep;
      const std::string port = "/base" + std::to_string(i) + "/input/speed";
      const auto pending = robot.service->Begin(
          PublishRequest{port, "0.4", {}, deadline, "round " + std::to_string(round) + port}, tasks);
      while (!pending->is_done()) std::this_thread::yield();
      const auto heard = SteadyClock::now();
      if (const CommandAnswer answer = pending->Take(); !answer) Fail(answer.diagnostics.ToString());
      driven.emplace_back(robot.bases[i], heard + deadline);
    }
    {
      const Burden burden(load, robot);
      while (!driven.empty()) {
        std::erase_if(driven, [&](const auto& each) {
          if (each.first->speed.Get() != 0) return false;
          times.push_back(Since(each.second));
          return true;
        });
        std::this_thread::sleep_for(100us);
      }
    }
    for (const Base* base : robot.bases) {
      const auto pending = robot.service->Begin(ReleaseRequest{base->speed.path()}, tasks);
      while (!pending->is_done()) std::this_thread::yield();
    }
  }
  PrintRow(load, std::move(times));
}

int Main(int tries, const std::string& text) {
  const auto begin = SteadyClock::now();
  const auto wanted = [&](const std::string& table) {
    std::vector<Load> rows = Loads();
    std::erase_if(rows, [&](const Load& each) { return (table + ": " + each.name).find(text) == std::string::npos; });
    if (!rows.empty()) PrintHead(table);
    return rows;
  };
  for (const KindOfWay& kind : KindsOfWays()) {
    for (const Load& load : wanted("STOP, " + kind.name)) {
      if (!MeasureStop(kind, load, tries)) break;
    }
  }
  for (const Load& load : wanted("dead-man, after its deadline")) MeasureDeadMan(load, tries);
  std::printf("\nmeasured for %.0f s\n", Since(begin) / 1000);
  return 0;
}

}  // namespace
}  // namespace runnel::bench

int main(int argc, char** argv) {
  return runnel::bench::Main(argc > 1 ? std::max(1, std::atoi(argv[1])) : 1000, argc > 2 ? argv[2] : "");
}
