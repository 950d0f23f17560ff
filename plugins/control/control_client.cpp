#include "plugins/control/control_client.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fmt/ranges.h>
#include <sys/socket.h>
#include <sys/time.h>

#include "core/base/nearest_name.h"
#include "core/base/number_text.h"
#include "plugins/control/control_folder.h"

namespace runnel {

namespace {

constexpr std::size_t kLongestAnswer = std::size_t{1} << 30;

Error Lost(const std::string& why) { return {.message = "the connection to the application is lost: " + why}; }

std::string Described(const RunningApplication& application) {
  return application.hello.application + " (" + std::to_string(application.hello.process) + ")";
}

}  // namespace

ControlClient::ControlClient(FileDescriptor socket) : socket_(std::move(socket)), reader_(kLongestAnswer) {}

Result<ControlClient> ControlClient::Connect(const std::filesystem::path& socket, Duration timeout) {
  auto connected = ConnectToSocket(socket);
  if (!connected) return connected.error();
  ControlClient client(std::move(*connected));
  client.SetPatience(timeout);
  const auto frame = client.Receive();
  client.SetPatience({});
  if (!frame) return frame.error();
  if (frame->kind == "err") return Error{.message = frame->payload};
  auto hello = frame->kind == "hello" ? Hello::Parse(frame->payload) : Hello::Parse("");
  if (!hello) return hello.error();
  client.hello_ = std::move(*hello);
  return client;
}

Result<void> ControlClient::Send(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = send(socket_.number(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      return Lost(std::strerror(errno));
    }
  }
  return {};
}

Result<Frame> ControlClient::Receive() {
  std::array<char, 65'536> bytes;
  for (;;) {
    auto frame = reader_.Take();
    if (!frame) return Lost(frame.error().message);
    if (*frame) return std::move(**frame);
    const ssize_t count = recv(socket_.number(), bytes.data(), bytes.size(), 0);
    if (count > 0) {
      reader_.Add({bytes.data(), static_cast<std::size_t>(count)});
    } else if (count == 0) {
      return Lost("it has ended");
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      return Lost("it does not answer");
    } else if (errno != EINTR) {
      return Lost(std::strerror(errno));
    }
  }
}

Result<int> ControlClient::Ask(const std::string& request, const Use& output, const Use& errors) {
  const std::string at =
      hello_.is_asking_when
          ? FrameBytes("at", std::to_string(asked_.value_or(SteadyClock().Now()).time_since_epoch().count()))
          : "";
  if (auto sent = Send(at + FrameBytes("request", request)); !sent) return sent.error();
  for (;;) {
    const auto frame = Receive();
    if (!frame) return frame.error();
    if (frame->kind == "out" && !output(frame->payload)) return 0;
    if (frame->kind == "err" && !errors(frame->payload)) return 0;
    if (frame->kind != "end") continue;
    return NumberIn<int>(frame->payload).value_or(1);
  }
}

void ControlClient::WaitForEnd() {
  while (Receive()) {
  }
}

void ControlClient::SetPatience(Duration timeout) noexcept {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(timeout);
  const auto rest = std::chrono::ceil<std::chrono::microseconds>(timeout - seconds);
  const timeval wait{.tv_sec = seconds.count(), .tv_usec = rest.count()};
  setsockopt(socket_.number(), SOL_SOCKET, SO_RCVTIMEO, &wait, sizeof wait);
}

void ControlClient::EndRequests() noexcept { shutdown(socket_.number(), SHUT_WR); }

Result<std::vector<RunningApplication>> FindRunningApplications(const std::filesystem::path& folder,
                                                                std::vector<Error>* silent) {
  const auto sockets = FindControlSockets(folder);
  if (!sockets) return sockets.error();
  std::vector<RunningApplication> applications;
  for (const auto& socket : *sockets) {
    const auto client = ControlClient::Connect(socket);
    if (client) {
      applications.push_back({socket, client->hello()});
    } else if (silent != nullptr) {
      Error error = client.error();
      error.position.file = socket.string();
      silent->push_back(std::move(error));
    }
  }
  return applications;
}

Result<RunningApplication> ChooseApplication(const std::vector<RunningApplication>& applications,
                                             const std::string& wanted) {
  std::vector<RunningApplication> meant = applications;
  std::erase_if(meant, [&](const RunningApplication& each) {
    return !wanted.empty() && wanted != each.hello.application && wanted != std::to_string(each.hello.process);
  });
  if (meant.size() == 1) return meant.front();
  if (applications.empty()) {
    return Error{.message = "no application is running that could be reached", .hint = "start one with 'runnel run'"};
  }
  if (meant.empty()) {
    return Error{.message = "no running application is called '" + wanted + "'",
                 .hint = NearestNameHint(
                     wanted, NamesOf(applications, [](const auto& each) { return each.hello.application; }))};
  }
  const std::string called = wanted.empty() ? "" : " called '" + wanted + "'";
  return Error{.message = fmt::format("{} applications{} are running: {}", meant.size(), called,
                                      fmt::join(NamesOf(meant, Described), ", ")),
               .hint = wanted.empty()
                           ? "choose one by --app NAME or --app PROCESS, or by a path that begins with its name"
                           : "choose one by --app PROCESS"};
}

}  // namespace runnel
