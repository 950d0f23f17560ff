// The part of bench/stop_search that is done in one process; the tests do the same for a short while.

#include <cstdint>
#include <cstdio>

#include <CLI/CLI.hpp>

#include "tests/integration/stop_search/stop_search.h"

int main(int argc, char** argv) {
  std::uint64_t seed = 1;
  std::uint64_t steps = 10'000;
  CLI::App app("Searches at random for a way around STOP, in bug_demo on simulated time.");
  app.add_option("--seed", seed, "Chooses the steps.");
  app.add_option("--steps", steps, "How many things are done.");
  CLI11_PARSE(app, argc, argv);
  const auto found = runnel::test::SearchForWaysAroundStop(seed, steps);
  std::printf("seed %llu: %llu steps, %llu presses, %llu plugins reloaded, %llu changes refused\n",
              static_cast<unsigned long long>(seed), static_cast<unsigned long long>(found.steps),
              static_cast<unsigned long long>(found.presses), static_cast<unsigned long long>(found.reloads),
              static_cast<unsigned long long>(found.refused));
  std::printf("%llu times a driving port was looked at, %llu times under STOP, %llu times it moved\n",
              static_cast<unsigned long long>(found.checks), static_cast<unsigned long long>(found.checks_in_force),
              static_cast<unsigned long long>(found.moving));
  std::printf("%llu marks and blocks came back with what was deleted\n",
              static_cast<unsigned long long>(found.came_back));
  for (const auto& violation : found.violations) std::printf("%s\n", violation.c_str());
  std::printf("%zu ways around STOP\n", found.violations.size());
  return found.violations.empty() ? 0 : 1;
}
