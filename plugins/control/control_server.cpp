#include "plugins/control/control_server.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <new>
#include <optional>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/port/port.h"
#include "plugins/control/application_state.h"
#include "plugins/control/client_connection.h"
#include "plugins/control/control_folder.h"
#include "plugins/control/protocol.h"

namespace runnel {

namespace {

// A client that has been quiet for so long makes room for another one, if there is no other room.
constexpr auto kQuiet = std::chrono::seconds(5);
// Clients besides the others who can press STOP, and nothing else.
constexpr std::size_t kKeptForStop = 8;
// After accepting has failed, for want of descriptors.
constexpr int kPauseMilliseconds = 100;

bool IsOwner(int descriptor) {
  ucred peer{};
  socklen_t size = sizeof peer;
  if (getsockopt(descriptor, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) return false;
  return peer.uid == geteuid() || peer.uid == 0;
}

}  // namespace

class ControlServer::Loop {
 public:
  Loop(CommandService& service, ControlOptions options, ListeningSocket listening, FileDescriptor wake)
      : service_(service),
        options_(std::move(options)),
        listening_(std::move(listening)),
        wake_(std::move(wake)),
        tasks_(std::in_place, service_.worker(), [this] { Wake(); }),
        thread_([this] { Run(); }) {}

  ~Loop() {
    ends_.store(true);
    Wake();
    thread_.join();
    unlink(listening_.path.c_str());
    clients_.clear();  // their commands use the tasks
    tasks_.reset();    // they wake this
  }

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return listening_.path; }

 private:
  // Of any thread.
  void Wake() const {
    const std::uint64_t one = 1;
    // Full means that it has not seen the last ones yet.
    (void)!write(wake_.number(), &one, sizeof one);
  }

  void Run() {
    while (!ends_.load()) {
      try {
        WaitForEvents();
      } catch (const std::bad_alloc&) {  // what it has not seen is still there
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
      for (const auto& client : clients_) client->Work(service_, *tasks_);
      std::erase_if(clients_, [](const auto& client) { return client->is_over(); });
    }
    for (const auto& client : clients_) client->Finish();
  }

  void WaitForEvents() {
    polled_.assign({{wake_.number(), POLLIN, 0}, {listening_.socket.number(), POLLIN, 0}});
    if (must_pause_) polled_[1].fd = -1;
    for (const auto& client : clients_) polled_.push_back({client->descriptor(), client->events(), 0});
    const std::size_t count = clients_.size();
    if (poll(polled_.data(), polled_.size(), Timeout()) < 0) return;
    if (polled_[0].revents != 0) {
      std::uint64_t ignored = 0;
      (void)!read(wake_.number(), &ignored, sizeof ignored);
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (polled_[i + 2].revents != 0) clients_[i]->OnEvents(polled_[i + 2].revents);
    }
    must_pause_ = false;
    if (polled_[1].revents != 0) Accept();
  }

  [[nodiscard]] int Timeout() const {
    std::optional<Command::SteadyTime> first;
    for (const auto& client : clients_) {
      const auto due = client->due();
      if (due && (!first || *due < *first)) first = due;
    }
    int milliseconds = must_pause_ ? kPauseMilliseconds : -1;
    if (first) {
      const auto now = std::chrono::steady_clock::now();
      // The earliest time of all is due, too, and is too far away to be subtracted from.
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(std::max(*first, now) - now);
      const int wait = static_cast<int>(std::clamp<std::int64_t>(left.count(), 0, 60'000));
      milliseconds = milliseconds < 0 ? wait : std::min(wait, milliseconds);
    }
    return milliseconds;
  }

  void Accept() {
    FileDescriptor socket(accept4(listening_.socket.number(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (!socket.is_open()) {
      must_pause_ = errno != EAGAIN && errno != EINTR && errno != ECONNABORTED;
      return;
    }
    // Without memory, who has called finds the line closed.
    auto client = std::make_unique<ClientConnection>(std::move(socket), options_.longest_request);
    if (!IsOwner(client->descriptor())) return;
    if (clients_.size() >= options_.most_clients && !EvictQuietClient()) {
      const Error full{.message =
                           "there are " + std::to_string(options_.most_clients) + " clients already, and all are busy"};
      if (clients_.size() >= options_.most_clients + kKeptForStop) {
        client->Refuse(full);
        return client->Finish();
      }
      client->AllowOnlyStop(full);
    }
    client->Send("hello", HelloText());
    clients_.push_back(std::move(client));
  }

  bool EvictQuietClient() {
    const auto quietest =
        std::ranges::min_element(clients_, {}, [](const auto& client) { return client->quiet_since(); });
    if (quietest == clients_.end()) return false;
    const auto quiet_for = std::chrono::steady_clock::now() - (*quietest)->quiet_since();
    if (quiet_for < kQuiet) return false;
    clients_.erase(quietest);
    return true;
  }

  [[nodiscard]] std::string HelloText() const {
    Hello hello;
    hello.process = getpid();
    hello.application = options_.application;
    hello.file = options_.file;
    hello.time = service_.application().runtime.clock().Now() - start_;
    hello.real = SteadyClock().Now() - started_;
    hello.is_asking_when = true;
    hello.state = StateText(service_.application());
    return hello.ToText();
  }

  CommandService& service_;
  const ControlOptions options_;
  const ListeningSocket listening_;
  const FileDescriptor wake_;
  const Time start_ = service_.application().runtime.clock().Now();
  const Time started_ = SteadyClock().Now();
  std::vector<std::unique_ptr<ClientConnection>> clients_;
  std::vector<pollfd> polled_;
  bool must_pause_ = false;
  std::atomic<bool> ends_{false};
  std::optional<TaskGroup> tasks_;
  std::thread thread_;
};

Result<std::unique_ptr<ControlServer>> ControlServer::Start(CommandService& service, ControlOptions options) {
  if (options.folder.empty()) options.folder = ControlFolder();
  auto listening = ListenInFolder(options.folder);
  if (!listening) return listening.error();
  FileDescriptor wake(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  if (!wake.is_open()) {
    unlink(listening->path.c_str());
    return SystemError("no event can be made");
  }
  return std::unique_ptr<ControlServer>(
      new ControlServer(std::make_unique<Loop>(service, std::move(options), std::move(*listening), std::move(wake))));
}

ControlServer::ControlServer(std::unique_ptr<Loop> loop) : loop_(std::move(loop)) {}
ControlServer::~ControlServer() = default;

const std::filesystem::path& ControlServer::socket() const noexcept { return loop_->path(); }

}  // namespace runnel
