#include "apps/runnel/remote_recording.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <iostream>
#include <thread>
#include <utility>

#include <unistd.h>

#include "plugins/mcap/mcap_reader.h"
#include "plugins/recording/recording_info.h"
#include "plugins/recording/recording_text.h"

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

// The application ends the file when it sees that we have gone.
int ReportWhenEnded(const std::string& file) {
  constexpr auto kTimeout = std::chrono::seconds(10);
  const auto latest = std::chrono::steady_clock::now() + kTimeout;
  for (;;) {
    const auto reader = McapReader::Open(file);
    if (reader && (*reader)->contents().ended_properly) {
      const RecordingInfo info = InfoOf(**reader);
      std::cout << RecordingText(file, {.values = info.values,
                                        .dropped = info.dropped,
                                        .ports = info.ports,
                                        .bytes = info.bytes})
                << std::flush;
      return 0;
    }
    if (std::chrono::steady_clock::now() > latest) {
      std::cerr << file << ": error: the application has not ended the recording within 10 s\n";
      return 1;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace

Result<int> AskToRecord(ControlClient& client, const Request& request, const std::string& file) {
  const Interruptions interruptions;
  const bool is_terminal = isatty(STDOUT_FILENO) == 1;
  std::string last;
  const auto code = client.Ask(
      request.ToText(),
      [&](std::string_view text) {
        last = text;
        if (is_terminal) {
          std::cout << "\r\x1b[K" << text.substr(0, text.find('\n')) << std::flush;
        }
        return !interrupted.load();
      },
      [&](std::string_view text) {
        std::cerr << (is_terminal ? "\n" : "") << text << std::flush;
        return !interrupted.load();
      });
  if (is_terminal) std::cout << "\r\x1b[K";
  if (interrupted) {
    { const ControlClient gone(std::move(client)); }
    return ReportWhenEnded(file);
  }
  if (!code) return code;
  if (*code == 0) std::cout << last << std::flush;
  return code;
}

}  // namespace runnel::program
