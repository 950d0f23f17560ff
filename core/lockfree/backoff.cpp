#include "core/lockfree/backoff.h"

#include <chrono>
#include <thread>

namespace runnel {

void BackOff(int round) {
  if (round < 64) {
    std::this_thread::yield();
  } else {
    std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
}

}  // namespace runnel
