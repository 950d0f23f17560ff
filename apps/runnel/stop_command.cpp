#include <chrono>
#include <iostream>
#include <mutex>
#include <thread>
#include <vector>

#include <unistd.h>

#include "apps/runnel/command_line.h"
#include "apps/runnel/meant_application.h"
#include "apps/runnel/output.h"
#include "plugins/control/control_folder.h"

namespace runnel::program {

namespace {

constexpr Duration kPatience = std::chrono::seconds(2);

// What has come of the STOP of one application; neither code nor text: it is another application than the one that is meant.
struct Stopped {
  std::string text = {};
  ExitCode code = ExitCode::kDone;
};
Result<Stopped> StopOne(const std::filesystem::path& socket, const std::string& wanted) {
  auto client = ControlClient::Connect(socket, kPatience);
  if (!client) return client.error();
  const Hello& hello = client->hello();
  if (!wanted.empty() && wanted != hello.application && wanted != std::to_string(hello.process)) return Stopped();
  client->SetPatience(kPatience);
  const std::string name = hello.application + " (" + std::to_string(hello.process) + "): ";
  const auto answer = AskForAll(*client, "stop");
  if (!answer) return Error{.message = name + answer.error().message};
  if (answer->output.empty()) return Error{.message = name + answer->errors};
  return Stopped{name + answer->output + answer->errors, answer->code == 0 ? ExitCode::kDone : ExitCode::kRunFailed};
}

}  // namespace

ExitCode Stop(const ControlArguments& arguments) {
  const auto sockets = FindControlSockets(ControlFolder());
  if (!sockets) return Fail(sockets.error());
  std::mutex mutex;
  std::size_t stopped = 0;          // guarded by mutex
  ExitCode code = ExitCode::kDone;  // guarded by mutex
  const auto stop = [&](const std::filesystem::path& socket) {
    const auto told = StopOne(socket, arguments.application);
    const std::lock_guard lock(mutex);
    if (told) {
      std::cout << Coloured(told->text, STDOUT_FILENO) << std::flush;
      if (!told->text.empty()) ++stopped;
      if (told->code != ExitCode::kDone) code = told->code;
      return;
    }
    code = Fail({.message = "the STOP is not confirmed: " + told.error().message, .position = {socket.string()}});
  };
  // All at once: one that hangs delays no other.
  std::vector<std::thread> asking;
  for (const auto& socket : *sockets) asking.emplace_back(stop, socket);
  for (std::thread& each : asking) each.join();
  if (stopped > 0 || code != ExitCode::kDone) return code;
  const std::string name = arguments.application.empty() ? "" : " called '" + arguments.application + "'";
  return Fail({.message = "no application" + name + " is running that could be reached, so nothing has been stopped"});
}

}  // namespace runnel::program
