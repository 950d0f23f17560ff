// The floor of the footprint: what the slim program does, without any framework.

#include <chrono>
#include <thread>

#include <unistd.h>

namespace {

constexpr int kToldThere = 3;  // who measures waits for a byte

}  // namespace

int main() {
  double value = 0;
  double sum = 0;
  bool is_first = true;
  for (auto due = std::chrono::steady_clock::now();; due += std::chrono::milliseconds(10)) {
    std::this_thread::sleep_until(due);
    value += 1;
    sum += 0.5 * value;
    if (is_first && sum > 0 && write(kToldThere, "", 1) != 1) return 1;
    is_first = false;
  }
}
