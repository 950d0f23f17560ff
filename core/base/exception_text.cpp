#include "core/base/exception_text.h"

#include <typeinfo>

#include <cxxabi.h>

#include "core/base/call_stack.h"

namespace runnel {

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
