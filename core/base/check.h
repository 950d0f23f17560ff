#pragma once

#include <stdexcept>
#include <string_view>

namespace runnel {

/// Thrown where code breaks a documented precondition: a bug in a program, never a user's mistake.
/// Inside a module's Update() it stops that module alone and is reported with the module's path.
class ProgrammingError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

[[noreturn]] void ThrowProgrammingError(std::string_view what, std::string_view detail);

}  // namespace runnel

/// Always checked, in every build. `what` says the broken rule in words.
#define RUNNEL_CHECK(condition, what) \
  (static_cast<bool>(condition) ? void(0) : ::runnel::ThrowProgrammingError(what, #condition))
