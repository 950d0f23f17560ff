#include "core/base/error.h"

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

}  // namespace runnel
