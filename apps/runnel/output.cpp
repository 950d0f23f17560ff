#include "apps/runnel/output.h"

#include <array>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <utility>

#include <poll.h>
#include <unistd.h>

#include "plugins/control/command.h"

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

}  // namespace

std::string Coloured(std::string_view text, int descriptor) {
  const auto is_set = [](const char* name) {
    const char* const value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  const char* const kind = std::getenv("TERM");
  const bool is_plain = isatty(descriptor) != 1 || is_set("NO_COLOR") ||
                        (kind != nullptr && std::string_view(kind) == "dumb");
  if (is_plain) return std::string(text);
  std::string coloured(text);
  for (const auto& [word, colour] : kColours) {
    const std::string painted = std::string("\x1b[") + colour + "m" + word + "\x1b[0m";
    for (std::size_t at = coloured.find(word); at != std::string::npos; at = coloured.find(word, at + painted.size()))
      coloured.replace(at, std::string_view(word).size(), painted);
  }
  return coloured;
}

void PrintError(const Error& error) { std::cerr << Coloured(ErrorLine(error), STDERR_FILENO); }

void OutliveReaders() { std::signal(SIGPIPE, SIG_IGN); }

bool FinishOutput() {
  std::cout.flush();
  return std::cout.good() || IsReaderGone();
}

}  // namespace runnel::program
