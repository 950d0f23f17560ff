#pragma once

#include <string>

#include "plugins/ros_messages/internal/binding.h"

namespace runnel::internal {

// Steps of what the value does not have.

/// What the message has by default. Errors: a nested message is not known.
Result<Step> DefaultStep(const MessageField& field, const MessageLibrary& library);
Step NumberStep(MessageType type, long double number);
Step TextStep(std::string text);
Step StampStep(bool is_own);
/// Stamp and frame.
Step HeaderStep(bool is_own, const std::string& frame);

/// One element of a list.
[[nodiscard]] MessageField One(MessageField field);

}  // namespace runnel::internal
