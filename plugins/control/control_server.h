#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/base/result.h"
#include "plugins/command_service/command_service.h"

namespace runnel {

struct ControlOptions {
  std::string application;            ///< its name, by which users choose it
  std::string file = {};              ///< that it came from
  std::filesystem::path folder = {};  ///< for the socket; "": ControlFolder()
  std::size_t most_clients = 32;
  std::size_t longest_request = 1 << 20;  ///< bytes
};

/// Makes a running application reachable by other processes of the same user, through a Unix socket:
/// looking, measuring, changing. See README.md for what goes over it.
///
/// Ownership:  the service must outlive it.
/// Threads:    has one of its own, which serves all clients and never takes part in a cycle; what may wait
///             is left to the service's worker. Start and destroy outside of cycles and without the structure lock.
/// Errors:     no folder, no socket. Clients' mistakes are answered, and never reach the application.
class ControlServer {
 public:
  static Result<std::unique_ptr<ControlServer>> Start(CommandService& service, ControlOptions options);
  /// Ends all connections, removes the socket, and waits for a change that is being carried out.
  ~ControlServer();

  [[nodiscard]] const std::filesystem::path& socket() const noexcept;

 private:
  class Loop;
  explicit ControlServer(std::unique_ptr<Loop> loop);

  const std::unique_ptr<Loop> loop_;
};

}  // namespace runnel
