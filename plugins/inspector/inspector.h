#pragma once

#include <memory>
#include <string>

#include "plugins/command_service/command_service.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/web_server/web_session.h"

namespace runnel {

namespace internal {
class Inspection;
}

struct InspectorOptions {
  std::string application = {};  ///< its name
  std::string file = {};         ///< that it came from
  std::string version = {};      ///< of the program
  bool is_read_only = false;     ///< viewers look, and change nothing
};

/// Shows a running application to viewers, and lets them change it: the other end of the protocol in
/// PROTOCOL.md. As many viewers as the server lets in share what is found out about the structure.
///
/// Ownership:  what is inspected must outlive it, and it the server that it gives its protocol to.
/// Threads:    sessions on the server's; what may wait is left to the service's worker. The rest
///             from any.
/// Errors:     what viewers get wrong is answered, and never reaches the application.
class Inspector {
 public:
  Inspector(CommandService& service, Scheduler& scheduler, InspectorOptions options);
  ~Inspector();

  [[nodiscard]] WebProtocol Protocol();
  /// No cycle will run any more; `verdict` is what has come of it, for people.
  void NoteEnd(std::string verdict);

 private:
  const std::unique_ptr<internal::Inspection> shared_;
};

}  // namespace runnel
