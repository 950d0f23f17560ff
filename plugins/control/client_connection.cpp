#include "plugins/control/client_connection.h"

#include <array>
#include <cerrno>
#include <new>
#include <thread>
#include <utility>

#include <poll.h>
#include <sys/socket.h>

#include "core/base/number_text.h"
#include "core/element/attempt.h"

namespace runnel {

namespace {

constexpr std::size_t kReadAtOnce = 65'536;
// With so much to be sent no command goes on.
constexpr std::size_t kBacklog = 65'536;
// Larger buffers are given back when they are empty.
constexpr std::size_t kKept = 1'000'000;
constexpr auto kAwaitsTask = std::chrono::milliseconds(500);  // at the end

}  // namespace

ClientConnection::ClientConnection(FileDescriptor socket, std::size_t longest_request)
    : socket_(std::move(socket)), reader_(longest_request) {}

short ClientConnection::events() const noexcept {
  // Requests are taken one by one: what comes meanwhile stays where it is.
  const bool reads = !has_ended_ && !is_refused_ && !command_ && backlog() < kBacklog;
  const bool may_end = command_ && !has_enough_;
  return static_cast<short>((reads ? POLLIN : 0) | (may_end ? POLLRDHUP : 0) | (backlog() > 0 ? POLLOUT : 0));
}

bool ClientConnection::is_over() const noexcept {
  if (is_broken_) return true;
  if (backlog() > 0 || command_) return false;
  return is_refused_ || (has_ended_ && !may_have_request_);
}

std::optional<Command::SteadyTime> ClientConnection::due() const noexcept {
  if (backlog() >= kBacklog || is_refused_) return {};
  if (command_) return command_->due();
  return may_have_request_ ? std::optional(SteadyTime{}) : std::nullopt;
}

void ClientConnection::Send(std::string_view kind, std::string_view payload) { out_ += FrameBytes(kind, payload); }

void ClientConnection::SendEnd(ControlCode code) { Send("end", std::to_string(static_cast<int>(code))); }

void ClientConnection::Refuse(const Error& error) {
  WriteError(ErrorLine(error));
  SendEnd(ControlCode::kBadInput);
  is_refused_ = true;
  command_.reset();
}

void ClientConnection::OnEvents(short events) {
  if ((events & (POLLERR | POLLHUP)) != 0 && (events & POLLIN) == 0) {
    is_broken_ = true;
    return;
  }
  if ((events & POLLRDHUP) != 0) has_enough_ = true;
  try {
    if ((events & POLLIN) != 0) Read();
  } catch (const std::bad_alloc&) {  // a part of what has come is lost: its client tries again, or says so
    is_broken_ = true;
  }
  if ((events & POLLOUT) != 0) Flush();
}

void ClientConnection::Read() {
  std::array<char, kReadAtOnce> bytes;
  const ssize_t count = recv(descriptor(), bytes.data(), bytes.size(), 0);
  if (count < 0 && errno != EAGAIN && errno != EINTR) is_broken_ = true;
  if (count == 0) has_ended_ = true;
  if (count <= 0) return;
  quiet_since_ = std::chrono::steady_clock::now();
  reader_.Add({bytes.data(), static_cast<std::size_t>(count)});
  may_have_request_ = true;
}

void ClientConnection::Flush() {
  while (backlog() > 0) {
    const ssize_t count = send(descriptor(), out_.data() + sent_, backlog(), MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      is_broken_ = errno != EAGAIN && errno != EWOULDBLOCK;
      return;
    }
    sent_ += static_cast<std::size_t>(count);
    quiet_since_ = std::chrono::steady_clock::now();
  }
  if (out_.capacity() > kKept) std::string().swap(out_);
  out_.clear();
  sent_ = 0;
}

void ClientConnection::Begin(CommandService& service, TaskGroup& tasks) {
  const auto frame = reader_.Take();
  if (!frame) return Refuse(frame.error());
  may_have_request_ = frame->has_value();
  if (!may_have_request_) return;
  if ((*frame)->kind == "at") {
    const auto at = NumberIn<std::int64_t>((*frame)->payload);
    if (!at) return Refuse({.message = "a frame 'at' without a time in nanoseconds"});
    asked_ = Time(Duration(*at));
    return;
  }
  if ((*frame)->kind != "request") {
    return Refuse({.message = "a frame '" + (*frame)->kind + "' where a 'request' should be"});
  }
  const auto asked = std::exchange(asked_, std::nullopt);
  if (asked) service.operators().Hear("a terminal", *asked);
  const std::string& request = (*frame)->payload;
  if (why_only_stop_ && request != "stop") return Refuse(*why_only_stop_);
  auto command = MakeCommand(request, service, tasks, asked);
  if (command) {
    command_.emplace(std::move(*command));
  } else {
    SendEnd(runnel::Refuse(*this, command.error()));
  }
}

void ClientConnection::Work(CommandService& service, TaskGroup& tasks) {
  if (is_broken_ || is_refused_ || backlog() >= kBacklog) return;
  try {
    if (!command_) Begin(service, tasks);
    if (!command_ || command_->due() > std::chrono::steady_clock::now()) return Flush();
    if (const auto code = command_->Continue(*this)) {
      command_.reset();
      SendEnd(*code);
    }
  } catch (...) {  // of a type's text format, or for want of memory
    try {
      Refuse(CaughtError());
    } catch (const std::bad_alloc&) {  // nor is there any to say so
      is_broken_ = true;
    }
  }
  Flush();
}

void ClientConnection::Finish() {
  try {
    // What has been done is done, though it is what has ended the application; and may be about to say so.
    const auto is_under_way = [this] {
      return command_ && command_->waits_for_task() && command_->due() != SteadyTime::min();
    };
    const auto last = std::chrono::steady_clock::now() + kAwaitsTask;
    while (is_under_way() && std::chrono::steady_clock::now() < last)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const auto code =
        command_ && command_->waits_for_task() && !is_under_way() ? command_->Continue(*this) : std::nullopt;
    if (code) {
      command_.reset();
      SendEnd(*code);
    }
  } catch (...) {
    WriteError(ErrorLine(CaughtError()));
  }
  if (command_) {
    command_.reset();
    WriteError("the application has ended\n");
    SendEnd(ControlCode::kFailed);
  }
  Flush();
}

}  // namespace runnel
