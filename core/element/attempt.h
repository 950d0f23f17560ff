#pragma once

#include <string>
#include <string_view>
#include <type_traits>

#include "core/base/error.h"
#include "core/base/exception_text.h"
#include "core/element/framework_element.h"

namespace runnel {

/// The exception that is being handled as an error: that of an ElementError, else what
/// DescribeException() says, with `before` before it. Precondition: within a catch block.
/// Errors:     std::bad_alloc, only if there is something in `before`.
[[nodiscard]] inline Error CaughtError(std::string_view before = {}) {
  try {
    try {
      throw;
    } catch (const ElementError& error) {
      return error.error();
    }
  } catch (...) {
    std::string what = DescribeException();
    return {.message = before.empty() ? std::move(what) : std::string(before) + what};
  }
}

/// What `act` gives, which is a Result. What it throws is an error of that, as by CaughtError().
template <typename Act>
[[nodiscard]] std::invoke_result_t<const Act&> Attempt(const Act& act, std::string_view before = {}) {
  try {
    return act();
  } catch (...) {
    return CaughtError(before);
  }
}

}  // namespace runnel
