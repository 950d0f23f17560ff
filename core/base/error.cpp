#include "core/base/error.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <tuple>
#include <typeinfo>

#include <cxxabi.h>

#include "core/base/call_stack.h"

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

namespace {

void AppendLines(std::vector<Error> entries, const std::string& kind, std::string& text) {
  std::stable_sort(entries.begin(), entries.end(), [](const Error& a, const Error& b) {
    return std::tie(a.position.file, a.position.line, a.position.column) <
           std::tie(b.position.file, b.position.line, b.position.column);
  });
  for (Error& entry : entries) {
    entry.message.insert(0, kind + (entry.path.empty() ? "" : entry.path + ": "));
    entry.path.clear();  // said inside the message, after the kind
    text += entry.ToString() + "\n";
  }
}

}  // namespace

std::string Diagnostics::ToString() const {
  std::string text;
  AppendLines(errors_, "error: ", text);
  AppendLines(warnings_, "warning: ", text);
  return text;
}

namespace {

// Of the exception that is being handled.
std::string TypeOfCurrentException() {
  const std::type_info* const type = abi::__cxa_current_exception_type();
  return type == nullptr ? "unknown exception" : "exception of type " + Demangled(type->name());
}

std::string Describe(const std::exception_ptr& exception) {
  try {
    std::rethrow_exception(exception);
  } catch (const std::exception& standard) {
    return standard.what();
  } catch (const std::string& text) {
    return text;
  } catch (const char* text) {
    return text != nullptr ? text : "null pointer";
  } catch (...) {
    return TypeOfCurrentException();
  }
}

}  // namespace

std::string DescribeException(std::exception_ptr exception) noexcept {
  if (exception == nullptr) return "no exception";
  try {
    return Describe(exception);
  } catch (...) {
    return "out of memory";  // short enough to need none
  }
}

}  // namespace runnel
