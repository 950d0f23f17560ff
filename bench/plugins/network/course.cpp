#include <algorithm>
#include <cstdlib>
#include <new>
#include <random>
#include <thread>

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/plugins/network/network_bench.h"

namespace runnel {

double ProcessorTime() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

namespace {

// As the threads of applications do.
void SleepUntil(Time time) {
  const auto since = time.time_since_epoch().count();
  const timespec until{since / 1'000'000'000, since % 1'000'000'000};
  (void)clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

}  // namespace

void Course::Write(const std::function<void()>& send) {
  std::this_thread::sleep_for(std::chrono::milliseconds(100));  // until what is said at the beginning has been said
  const double began = Now();
  const double processor = ProcessorTime();
  Time next = SteadyClock().Now();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.5, 1.5);
  while (load_.period.count() > 0 ? sent_ < load_.count : Now() - began < 1) {
    if (load_.period.count() > 0) {
      next += load_.is_even ? Duration(load_.period) : FromSeconds(share(random) * ToSeconds(load_.period));
      SleepUntil(next);
    }
    send();
    ++sent_;
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  processor_writing_ = ProcessorTime() - processor;
  has_ended_ = true;
}

void Course::Note(double sent) {
  const double now = Now();
  const std::size_t place = count_.load(std::memory_order_relaxed);
  if (place == 0) {
    first_ = now;
    processor_reading_ = -ProcessorTime();
  }
  last_ = now;
  if (place >= kMost) return;
  latencies_[place] = static_cast<float>(now - sent);
  count_.store(place + 1, std::memory_order_release);
}

void Course::WaitForEnd() {
  while (!has_ended_) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  for (std::size_t seen = ~std::size_t{0}; count_.load(std::memory_order_acquire) != seen;) {
    seen = count_.load(std::memory_order_acquire);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  processor_reading_ += ProcessorTime();
}

Figures Course::figures() const {
  std::vector<float> all(latencies_.begin(), latencies_.begin() + static_cast<std::ptrdiff_t>(count_.load()));
  if (all.empty()) return {};
  std::ranges::sort(all);
  const auto count = static_cast<double>(all.size());
  return {.p50 = all[all.size() / 2],
          .p99 = all[all.size() * 99 / 100],
          .processor_writing = processor_writing_ / count,
          .processor_reading = processor_reading_ / count,
          .sent = sent_,
          .arrived = count,
          .rate = count / (last_ - first_)};
}

Figures Measure(const Load& load, const std::function<void(Course&)>& read, const std::function<void(Course&)>& write) {
  void* const shared = mmap(nullptr, sizeof(Course), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) std::abort();
  Course& course = *new (shared) Course(load);
  const auto run = [&](const std::function<void(Course&)>& part) {
    const pid_t child = fork();
    if (child != 0) return child;
    part(course);
    _exit(0);
  };
  const pid_t reader = run(read);
  const pid_t writer = run(write);
  waitpid(writer, nullptr, 0);
  waitpid(reader, nullptr, 0);
  const Figures figures = course.figures();
  munmap(shared, sizeof(Course));
  return figures;
}

}  // namespace runnel
