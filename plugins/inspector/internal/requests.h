#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "plugins/inspector/internal/inspection.h"
#include "plugins/inspector/internal/viewer_message.h"

namespace runnel::internal {

/// {"op":"reply","request":…,"ok":true,"text":…}
[[nodiscard]] std::string Reply(std::optional<std::uint64_t> request, const std::string& text);

[[nodiscard]] std::string Refusal(std::optional<std::uint64_t> request,
                                  const std::vector<RequestError>& errors);

/// Whether messages of this kind are requests, each of which gets one reply.
[[nodiscard]] bool IsRequest(const std::string& op);
/// Whether it leaves the application as it is.
[[nodiscard]] bool OnlyLooks(const std::string& op);
/// All that viewers may say, for the hint to one that says something else.
[[nodiscard]] const std::vector<std::string>& AllOperations();

/// A request while it is being carried out; a change that is destroyed before it has begun is not done.
///
/// Threads:  the server's; waits for nothing.
struct ViewerRequest {
  std::shared_ptr<WorkerTask> task;         ///< nullptr: it has been answered at once
  std::function<std::string()> take_reply;  ///< once the task is done
};
/// `on_done` is called by the worker when the task is done.
[[nodiscard]] ViewerRequest BeginRequest(Inspection& inspection, ViewerMessage message,
                                         std::function<void()> on_done);

}  // namespace runnel::internal
