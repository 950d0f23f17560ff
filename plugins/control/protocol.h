#pragma once

#include <string>
#include <string_view>

#include <sys/types.h>

#include "core/base/clock.h"
#include "core/base/result.h"

namespace runnel {

/// Which protocol this code speaks. Changes when a client of before would misunderstand.
inline constexpr int kControlProtocol = 1;

/// The first frame that a client gets: whom it has reached.
struct Hello {
  int protocol = kControlProtocol;
  pid_t process = 0;
  std::string application = {};
  std::string file = {};
  Duration time{};  ///< that the application has been running, on its own clock

  [[nodiscard]] std::string ToText() const;
  /// Errors: another protocol, or no hello at all.
  [[nodiscard]] static Result<Hello> Parse(std::string_view text);
};

}  // namespace runnel
