#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "plugins/inspector/internal/inspection.h"
#include "plugins/inspector/internal/viewer_message.h"
#include "plugins/web_server/web_session.h"

namespace runnel::internal {

/// {"op":"reply","request":…,"ok":true,"text":…}
[[nodiscard]] std::string Reply(std::optional<std::uint64_t> request, const std::string& text);

[[nodiscard]] std::string Refusal(std::optional<std::uint64_t> request, const std::vector<RequestError>& errors,
                                  const std::string& needs = {});

/// A request while it is being carried out; a change that is destroyed before it has begun is not done.
///
/// Threads:  the server's; waits for nothing.
struct ViewerRequest {
  std::function<std::string()> take_reply;  ///< once it is done
  std::function<bool()> is_done = {};       ///< asked with each look; none: at once
};

/// What viewers may say, and who may say it.
struct Operation {
  /// `on_done` is called by the worker when the task is done.
  using Begin = ViewerRequest (*)(Inspection& inspection, ViewerMessage message, std::function<void()> on_done);
  // Not an aggregate: what has no role does not compile. Without `its_begin` it is the session's and gets no reply.
  Operation(std::string_view its_name, WebRole its_role, Begin its_begin, std::string_view its_fields = "")
      : name(its_name), role(its_role), role_of_modules(its_role), begin(its_begin), fields(its_fields) {}
  /// Of the table of requests, which says the role.
  Operation(std::string_view its_name, Begin its_begin, std::string_view its_fields = "");

  std::string_view name;
  WebRole role;             ///< that is needed for it
  WebRole role_of_modules;  ///< the same, if the message names a path
  Begin begin;              ///< nullptr: is not answered
  /// What a message of it may say besides "op", "request", "at", and its fields in the table of requests; words.
  std::string_view fields;
};
[[nodiscard]] std::span<const Operation> AllOperations();
/// nullptr: there is none.
[[nodiscard]] const Operation* FindOperation(std::string_view name);
/// Errors: the message says what its operation does not have, with the nearest name. A STOP may say anything besides.
[[nodiscard]] Result<void> CheckFields(const Operation& operation, const ViewerMessage& message);
/// That is needed for what `message` asks for.
[[nodiscard]] WebRole RoleFor(const Operation& operation, const ViewerMessage& message);

/// How values of one port could be passed on to another: parts and conversions. Waits for the structure lock.
[[nodiscard]] std::string FindConversions(Inspection& inspection, const ViewerMessage& message);

/// Calls a service for a viewer: the reply's text is what the service replies. Given up when the viewer goes.
[[nodiscard]] ViewerRequest BeginCallRequest(Inspection& inspection, ViewerMessage message,
                                             std::function<void()> on_done);

/// Asks what is under way at a service to end. Waits for the structure lock.
[[nodiscard]] std::string AbortCall(Inspection& inspection, const ViewerMessage& message);

}  // namespace runnel::internal
