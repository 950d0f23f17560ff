#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "plugins/inspector/internal/inspection.h"
#include "plugins/inspector/internal/viewer_message.h"

namespace runnel::internal {

/// {"op":"reply","request":…,"ok":true,"text":…}; `further`: members that only this reply has, as JSON
/// (",\"types\":[]").
[[nodiscard]] std::string Reply(std::optional<std::uint64_t> request, const std::string& text);

/// What is wrong with a request; `change`: with which of its changes, from 0.
struct RequestError {
  Error error;
  std::optional<std::size_t> change = {};
};
[[nodiscard]] std::string Refusal(std::optional<std::uint64_t> request,
                                  const std::vector<RequestError>& errors);

/// Whether messages of this kind are requests, each of which gets one reply.
[[nodiscard]] bool IsRequest(const std::string& op);
/// Whether it leaves the application as it is.
[[nodiscard]] bool OnlyLooks(const std::string& op);
/// All that viewers may say, for the hint to one that says something else.
[[nodiscard]] const std::vector<std::string>& AllOperations();

/// Does what is asked for, and returns the reply.
///
/// Threads:  the worker's: waits for locks and cycles.
[[nodiscard]] std::string CarryOut(Inspection& inspection, const ViewerMessage& message);

}  // namespace runnel::internal
