#include "apps/runnel/output.h"

#include <csignal>
#include <iostream>

#include <poll.h>
#include <unistd.h>

#include "plugins/control/command.h"

namespace runnel::program {

namespace {

bool IsReaderGone() {
  pollfd output{.fd = STDOUT_FILENO, .events = POLLOUT, .revents = 0};
  return poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

}  // namespace

void PrintError(const Error& error) { std::cerr << ErrorLine(error); }

void OutliveReaders() { std::signal(SIGPIPE, SIG_IGN); }

bool FinishOutput() {
  std::cout.flush();
  return std::cout.good() || IsReaderGone();
}

}  // namespace runnel::program
