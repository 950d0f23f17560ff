#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace runnel::internal {

/// What a viewer says, as the protocol has it; what is not said is as here.
struct ViewerMessage {
  std::string op;
  std::optional<std::uint64_t> request;
  std::string path;
  std::string label;
  std::vector<std::string> changes;
  std::string file;
  std::string plugin;
  std::optional<double> rate;
  std::optional<double> speed;
  std::size_t elements = 12;
  std::uint64_t cycles = 1;
};

/// Errors: it is no JSON object, is nested deeper than any message is, or a member is of another kind
/// than the protocol has it.
[[nodiscard]] Result<ViewerMessage> ParseViewerMessage(std::string_view text);

}  // namespace runnel::internal
