#pragma once

#include <exception>
#include <string>

namespace runnel {

/// What an exception says, for those who catch whatever other people's code throws: the text of a
/// std::exception, of a string or of a C string, else the name of the type that was thrown.
///
///     } catch (...) {
///       Report("the handler failed: " + DescribeException());
///     }
///
/// Threads:    any. Allocation: of the text; without memory it is "out of memory".
/// Errors:     none; outside of a handler it is "no exception".
[[nodiscard]] std::string DescribeException(std::exception_ptr exception = std::current_exception()) noexcept;

}  // namespace runnel
