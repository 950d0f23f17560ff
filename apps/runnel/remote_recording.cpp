#include "apps/runnel/remote_recording.h"

#include <atomic>
#include <csignal>
#include <iostream>

#include <unistd.h>

namespace runnel::program {

namespace {

std::atomic<bool> interrupted{false};

// The first Ctrl-C ends the recording, a second the program.
class Interruptions {
 public:
  Interruptions() {
    struct sigaction action {};
    action.sa_handler = [](int) { interrupted = true; };
    action.sa_flags = SA_RESETHAND | SA_RESTART;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
  }
};

}  // namespace

Result<int> AskToRecord(ControlClient& client, const Request& request) {
  const Interruptions interruptions;
  const bool is_terminal = isatty(STDOUT_FILENO) == 1;
  std::string last;
  const auto go_on = [&] {
    if (interrupted) client.EndRequests();
    return true;
  };
  const auto code = client.Ask(
      request.ToText(),
      [&](std::string_view text) {
        last = text;
        if (is_terminal) {
          std::cout << "\r\x1b[K" << text.substr(0, text.find('\n')) << std::flush;
        }
        return go_on();
      },
      [&](std::string_view text) {
        std::cerr << (is_terminal ? "\n" : "") << text << std::flush;
        return go_on();
      });
  if (is_terminal) std::cout << "\r\x1b[K";
  if (code && *code == 0) std::cout << last << std::flush;
  return code;
}

}  // namespace runnel::program
