#include "core/base/error.h"

#include <cerrno>
#include <cstring>

namespace runnel {

std::string Error::ToString() const {
  std::string text;
  if (!position.file.empty()) {
    text += position.file;
    if (position.line > 0) text += ":" + std::to_string(position.line);
    if (position.line > 0 && position.column > 0) text += ":" + std::to_string(position.column);
    text += ": ";
  }
  if (!path.empty()) text += path + ": ";
  text += message;
  if (!hint.empty()) text += "; " + hint;
  return text;
}

Error Error::WithContext(std::string_view context) const {
  Error error = *this;
  error.message.insert(0, ": ").insert(0, context);
  return error;
}

Error Error::WithPath(std::string_view of) const {
  Error error = *this;
  if (error.path.empty()) error.path = of;
  return error;
}

Error Error::WithPosition(SourcePosition at) const {
  Error error = *this;
  if (error.position.file.empty()) error.position = std::move(at);
  return error;
}

Error SystemError(std::string_view what, std::string file) {
  const Error error{.message = std::strerror(errno), .position = {std::move(file)}};
  return error.WithContext(what);
}

}  // namespace runnel
