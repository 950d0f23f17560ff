#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "core/base/file_descriptor.h"
#include "plugins/control/command.h"
#include "plugins/control/protocol.h"

namespace runnel {

/// The server's end of one client: what has come, what is being answered, what is still to be sent.
/// Never waits. A client that does not read is not written for: its command pauses, and nothing more is
/// read from it, so it holds one request and about one answer, and no more.
///
/// Threads:  the server's.
class ClientConnection final : private Answer {
 public:
  using SteadyTime = Command::SteadyTime;

  /// Takes the socket. `longest_request`: in bytes.
  ClientConnection(FileDescriptor socket, std::size_t longest_request);

  [[nodiscard]] int descriptor() const noexcept { return socket_.number(); }
  /// What poll() shall look for.
  [[nodiscard]] short events() const noexcept;
  /// Gone, or there is nothing left to do for it.
  [[nodiscard]] bool is_over() const noexcept;
  /// Since when nothing has been read from it or written to it.
  [[nodiscard]] SteadyTime quiet_since() const noexcept { return quiet_since_; }
  /// When the command wants to go on; nothing if it has to wait for the client, or there is none.
  [[nodiscard]] std::optional<SteadyTime> due() const noexcept;

  /// Sends a frame, behind what is still to be sent.
  void Send(std::string_view kind, std::string_view payload);
  void SendEnd(ControlCode code);
  /// Every other request is refused, for this reason.
  void AllowOnlyStop(Error why) { why_only_stop_ = std::move(why); }
  /// Says why, and sends no more after what is still to be sent.
  void Refuse(const Error& error);

  /// Poll has told that there is something to do.
  void OnEvents(short events);
  /// Begins and continues what can be.
  void Work(CommandService& service, TaskGroup& tasks);
  /// The application ends: tells the client if it waits for an answer.
  void Finish();

 private:
  void Write(std::string_view text) override { Send("out", text); }
  [[nodiscard]] bool has_enough() const override { return has_enough_; }
  void WriteError(std::string_view text) override { Send("err", text); }

  void Read();
  void Flush();
  void Begin(CommandService& service, TaskGroup& tasks);
  [[nodiscard]] std::size_t backlog() const noexcept { return out_.size() - sent_; }

  const FileDescriptor socket_;
  FrameReader reader_;
  std::optional<Command> command_;
  std::string out_;
  std::size_t sent_ = 0;
  bool has_ended_ = false;   // the client sends no more
  bool has_enough_ = false;  // the client waits for the end of its command
  bool is_broken_ = false;   // the client has gone
  bool is_refused_ = false;
  bool may_have_request_ = false;  // among what has been read
  std::optional<Time> asked_;      // when the next request was asked for, if its client says so
  std::optional<Error> why_only_stop_;
  SteadyTime quiet_since_ = std::chrono::steady_clock::now();
};

}  // namespace runnel
