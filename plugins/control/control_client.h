#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/file_descriptor.h"
#include "core/base/result.h"
#include "plugins/control/protocol.h"

namespace runnel {

/// A connection to a running application.
///
/// Threads:  one at a time; calls wait for the application.
class ControlClient {
 public:
  /// Errors: nobody there, no answer within `timeout`, another protocol.
  static Result<ControlClient> Connect(const std::filesystem::path& socket, Duration timeout = std::chrono::seconds(5));

  /// How long each answer is waited for from now on; 0: for ever.
  void SetPatience(Duration timeout) noexcept;
  /// When the person asked for what comes next, on the machine's steady clock; else it is when that is sent.
  void SetAsked(Time asked) noexcept { asked_ = asked; }
  [[nodiscard]] const Hello& hello() const noexcept { return hello_; }

  /// Where an answer goes, as it comes. False: the answer is not wanted any more.
  using Use = std::function<bool(std::string_view text)>;
  /// Asks, and returns the code with which the answer ended: 0 done, 1 failed, 2 bad input.
  /// Errors: the connection is lost.
  Result<int> Ask(const std::string& request, const Use& output, const Use& errors);
  /// There will be no more requests, and one that goes on until its client has enough ends in order.
  void EndRequests() noexcept;
  /// Waits until the application has gone, or ends the connection.
  void WaitForEnd();

 private:
  explicit ControlClient(FileDescriptor socket);
  Result<void> Send(std::string_view bytes);
  /// Waits for the next frame.
  Result<Frame> Receive();

  FileDescriptor socket_;
  FrameReader reader_;
  Hello hello_;
  std::optional<Time> asked_;
};

/// The running applications of this user, by process. Those that do not answer are left out, and said
/// to `silent`, if there is one. Errors: the folder cannot be trusted.
struct RunningApplication {
  std::filesystem::path socket;
  Hello hello;
};
[[nodiscard]] Result<std::vector<RunningApplication>> FindRunningApplications(const std::filesystem::path& folder,
                                                                              std::vector<Error>* silent = nullptr);

/// The one that is meant by `wanted`, a name or the number of a process; "": the only one. Errors: none,
/// or several; the hint lists them.
[[nodiscard]] Result<RunningApplication> ChooseApplication(const std::vector<RunningApplication>& applications,
                                                           const std::string& wanted);

}  // namespace runnel
