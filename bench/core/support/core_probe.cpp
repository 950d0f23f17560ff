#include "bench/core/support/core_probe.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>

namespace runnel::bench {

namespace {

void KeepAddersBusy() {
  constexpr int kRounds = 5000;
  std::uint64_t a = 0, b = 0, c = 0, d = 0;
#pragma GCC unroll 4
  for (int i = 0; i < kRounds; ++i) {
    asm volatile("" : "+r"(a), "+r"(b), "+r"(c), "+r"(d));  // so that each round is one
    ++a;
    ++b;
    ++c;
    ++d;
  }
}

}  // namespace

double ProbeCore() {
  using Clock = std::chrono::steady_clock;
  double best = std::numeric_limits<double>::max();
  for (int i = 0; i < 3; ++i) {
    const auto start = Clock::now();
    KeepAddersBusy();
    const std::chrono::duration<double, std::nano> taken = Clock::now() - start;
    best = std::min(best, taken.count());
  }
  return best;
}

}  // namespace runnel::bench
