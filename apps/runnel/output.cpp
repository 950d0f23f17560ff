#include "apps/runnel/output.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include "core/base/characters.h"
#include "core/element/runtime.h"
#include "plugins/control/command.h"
#include "plugins/scheduling/thread_container.h"

namespace runnel::program {

namespace {

// Words that nobody shall overlook.
constexpr std::array<std::pair<const char*, const char*>, 9> kColours{{{"error:", "1;31"},
                                                                       {"warning:", "1;33"},
                                                                       {"FAILED", "1;31"},
                                                                       {"STUCK", "1;31"},
                                                                       {"STOP", "1;31"},
                                                                       {"BLOCKED", "1;33"},
                                                                       {"NOT CONNECTED", "1;31"},
                                                                       {"PAUSED", "1;33"},
                                                                       {"ended, held", "1;33"}}};

bool IsReaderGone() {
  pollfd output{.fd = STDOUT_FILENO, .events = POLLOUT, .revents = 0};
  return poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

double Milliseconds(Duration duration) { return ToSeconds(duration) * 1e3; }

std::string Line(const ThreadContainer& thread, int width) {
  const CycleStatistics all = thread.statistics();
  return fmt::format("{:<{}} {:9} {:8}  {:8.3f} {:8.3f} {:8.3f}  {:8.3f} {:8.3f}  {:8.3f} {:8.3f}\n", thread.path(),
                     width, all.cycles, all.overruns, Milliseconds(all.period_min), Milliseconds(all.period_mean),
                     Milliseconds(all.period_max), Milliseconds(all.jitter_mean), Milliseconds(all.jitter_max),
                     Milliseconds(all.execution_mean), Milliseconds(all.execution_max));
}

std::string Heading(int width) {
  return fmt::format(
      "{:<{}} {:>9} {:>8}  {:>26}  {:>17}  {:>17}\n"
      "{:<{}} {:>9} {:>8}  {:>8} {:>8} {:>8}  {:>8} {:>8}  {:>8} {:>8}\n",
      "thread", width, "cycles", "overruns", "period / ms", "jitter / ms", "execution / ms", "", width, "", "", "min",
      "mean", "max", "mean", "max", "mean", "max");
}

}  // namespace

std::string Coloured(std::string_view text, int descriptor) {
  const auto is_set = [](const char* name) {
    const char* const value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  const char* const kind = std::getenv("TERM");
  const bool is_plain =
      isatty(descriptor) != 1 || is_set("NO_COLOR") || (kind != nullptr && std::string_view(kind) == "dumb");
  std::string coloured = Printable(text, "\n\t");
  if (is_plain) return coloured;
  for (const auto& [word, colour] : kColours) {
    const std::string painted = std::string("\x1b[") + colour + "m" + word + "\x1b[0m";
    for (std::size_t at = coloured.find(word); at != std::string::npos; at = coloured.find(word, at + painted.size()))
      coloured.replace(at, std::string_view(word).size(), painted);
  }
  return coloured;
}

void PrintError(const Error& error) { std::cerr << Coloured(ErrorLine(error), STDERR_FILENO); }

ExitCode Fail(const Error& error, ExitCode code) {
  PrintError(error);
  return code;
}

void OutliveReaders() { std::signal(SIGPIPE, SIG_IGN); }

bool FinishOutput() {
  std::cout.flush();
  return std::cout.good() || IsReaderGone();
}

std::string StatisticsTable(FrameworkElement& root) {
  const std::lock_guard lock(root.runtime().structure_mutex());
  std::vector<const ThreadContainer*> threads;
  int width = 0;
  root.VisitAll<const ThreadContainer>([&](const ThreadContainer& thread) {
    threads.push_back(&thread);
    width = std::max(width, static_cast<int>(thread.path().size()));
  });
  std::string text = Heading(width);
  for (const ThreadContainer* each : threads) text += Line(*each, width);
  return text;
}

}  // namespace runnel::program
