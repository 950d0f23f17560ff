#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "plugins/control/command.h"

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
/// Ownership:  what is controlled must outlive it.
/// Threads:    has two of its own, one for clients and one for changes; neither ever takes part in a
///             cycle. Start and destroy outside of cycles and without the structure lock.
/// Errors:     no folder, no socket. Clients' mistakes are answered, and never reach the application.
class ControlServer {
 public:
  static Result<std::unique_ptr<ControlServer>> Start(ControlledApplication application,
                                                      ControlOptions options);
  /// Ends all connections, removes the socket, and waits for a change that is being carried out.
  ~ControlServer();
  ControlServer(const ControlServer&) = delete;
  ControlServer& operator=(const ControlServer&) = delete;

  [[nodiscard]] const std::filesystem::path& socket() const noexcept;

 private:
  class Loop;
  explicit ControlServer(std::unique_ptr<Loop> loop);

  const std::unique_ptr<Loop> loop_;
};

}  // namespace runnel
