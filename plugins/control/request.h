#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace runnel {

/// What a client asks for: a command with its arguments in a line, and, if it has more lines, a text.
///
///     echo /robot/planner/pose count=3
///     change file=plan.txt
///     connect /a/out /b/in
///     delete /c
struct Request {
  std::string command;
  std::vector<std::string> arguments;
  std::map<std::string, std::string> options;
  std::string body;

  /// Errors: the first line cannot be split into arguments, or has an option twice.
  [[nodiscard]] static Result<Request> Parse(std::string_view text);
  [[nodiscard]] std::string ToText() const;

  [[nodiscard]] bool Has(const std::string& option) const { return options.count(option) > 0; }
  [[nodiscard]] std::string Option(const std::string& option) const;
};

}  // namespace runnel
