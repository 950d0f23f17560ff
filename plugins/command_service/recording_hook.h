#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace runnel {

/// What a client wants to be recorded.
struct RecordingRequest {
  std::string file;  ///< absolute
  std::vector<std::string> ports = {};
  std::string compression = {};
};

/// A recording that a client has begun. Ends with this. Threads: one at a time.
class ClientRecording {
 public:
  virtual ~ClientRecording() = default;
  /// How it is going, in one line.
  [[nodiscard]] virtual std::string Progress() = 0;
  /// Why nothing more is recorded, if so.
  [[nodiscard]] virtual std::optional<Error> Failure() = 0;
  /// Ends it, and says in one line what there is. May take a while.
  virtual Result<std::string> Finish() = 0;
};

/// Begins one. May take a while. Errors: of the file, of the ports; nothing is recorded then.
using RecordingHook =
    std::function<Result<std::unique_ptr<ClientRecording>>(const RecordingRequest&)>;

}  // namespace runnel
