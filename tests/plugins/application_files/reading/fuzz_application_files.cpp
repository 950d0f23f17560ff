// Random application files, as many as asked for: fuzz_application_files --seed 1 --count 1000000

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <thread>

#include <unistd.h>

#include "tests/plugins/application_files/reading/file_trial.h"
#include "tests/plugins/application_files/reading/random_files.h"

namespace runnel::testing {
namespace {

constexpr int kFound = 1;
constexpr int kBadUsage = 2;
constexpr int kHangs = 3;
constexpr auto kLongest = std::chrono::seconds(10);

struct Arguments {
  std::uint64_t seed = 1;
  std::uint64_t first = 0;
  std::uint64_t count = 100'000;
  std::uint64_t most_faults = 1;
  bool prints = false;
};

std::atomic<std::uint64_t> current_number{0};

void Write(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) _exit(kFound);
}

// What is allowed in a handler only.
void TellCrash(int signal) {
  char digits[24];
  char* at = digits + sizeof(digits) - 1;
  *at = '\0';
  for (std::uint64_t left = current_number; at == digits + sizeof(digits) - 1 || left > 0; left /= 10) {
    *--at = static_cast<char>('0' + left % 10);
  }
  Write("\ncrashed at input ");
  Write(at);
  Write(": see it with --first <it> --count 1 --print\n");
  std::signal(signal, SIG_DFL);
  raise(signal);
}

// On a stack of its own, for the program's may be what has come to its end.
void HandleCrashes() {
  static char stack[1U << 16U];
  const stack_t alternative{.ss_sp = stack, .ss_flags = 0, .ss_size = sizeof(stack)};
  sigaltstack(&alternative, nullptr);
  struct sigaction action {};
  action.sa_handler = TellCrash;
  action.sa_flags = SA_ONSTACK;
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL}) {
    sigaction(signal, &action, nullptr);
  }
}

// Ends the program if one input takes so long that it must be an endless loop.
void Watch(const std::atomic<bool>& is_over) {
  std::uint64_t last = current_number;
  auto since = std::chrono::steady_clock::now();
  while (!is_over) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const auto now = std::chrono::steady_clock::now();
    if (current_number != last) since = now;
    last = current_number;
    if (now - since < kLongest) continue;
    std::fprintf(stderr, "\ninput %llu hangs: see it with --first %llu --count 1 --print\n",
                 static_cast<unsigned long long>(last), static_cast<unsigned long long>(last));
    _exit(kHangs);
  }
}

void PrintProgress(std::uint64_t done, const FileTrial& trial, double seconds) {
  const FileTrial::Counts& counts = trial.counts();
  std::fprintf(stderr, "\r%llu inputs (%.0f/s): %llu no XML, %llu refused, %llu built, %llu saved  ",
               static_cast<unsigned long long>(done), static_cast<double>(done) / seconds,
               static_cast<unsigned long long>(counts.unreadable), static_cast<unsigned long long>(counts.refused),
               static_cast<unsigned long long>(counts.built), static_cast<unsigned long long>(counts.saved));
}

int Run(const Arguments& arguments) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("fuzz_application_files_" + std::to_string(getpid()));
  RandomFiles files(arguments.seed, RUNNEL_CORPUS);
  FileTrial trial(folder, RUNNEL_CORPUS);
  const auto start = std::chrono::steady_clock::now();
  std::uint64_t done = 0;
  std::uint64_t faults = 0;
  for (; done < arguments.count && faults < arguments.most_faults; ++done) {
    const std::uint64_t number = arguments.first + done;
    current_number = number;
    const std::string text = files.Make(number);
    if (arguments.prints) std::printf("%s\n", text.c_str());
    if (const std::string fault = trial.Try(text, number); !fault.empty()) {
      ++faults;
      std::printf("\n---- input %llu\n%s\n---- %s\n", static_cast<unsigned long long>(number), text.c_str(),
                  fault.c_str());
    }
    if (done % 10'000 == 9'999 || done + 1 == arguments.count) {
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
      PrintProgress(done + 1, trial, took.count());
    }
  }
  std::filesystem::remove_all(folder);
  std::printf("\nseed %llu, %llu inputs: %s\n", static_cast<unsigned long long>(arguments.seed),
              static_cast<unsigned long long>(done),
              faults == 0 ? "no fault" : (std::to_string(faults) + " faults").c_str());
  return faults == 0 ? 0 : kFound;
}

std::optional<Arguments> Parse(int count, char** words) {
  Arguments arguments;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (word == "--print") {
      arguments.prints = true;
      continue;
    }
    std::uint64_t* const number = word == "--seed"     ? &arguments.seed
                                  : word == "--first"  ? &arguments.first
                                  : word == "--count"  ? &arguments.count
                                  : word == "--faults" ? &arguments.most_faults
                                                       : nullptr;
    if (number == nullptr || ++i == count) return std::nullopt;
    char* end = nullptr;
    *number = std::strtoull(words[i], &end, 10);
    if (end == words[i] || *end != '\0') return std::nullopt;
  }
  return arguments;
}

}  // namespace
}  // namespace runnel::testing

int main(int count, char** words) {
  using namespace runnel::testing;
  const auto arguments = Parse(count, words);
  if (!arguments) {
    std::fputs(
        "usage: fuzz_application_files [--seed N] [--first N] [--count N] [--faults N] "
        "[--print]\n",
        stderr);
    return kBadUsage;
  }
  HandleCrashes();
  std::atomic<bool> is_over{false};
  std::thread watch(Watch, std::cref(is_over));
  const int verdict = Run(*arguments);
  is_over = true;
  watch.join();
  return verdict;
}
