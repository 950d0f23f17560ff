#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/port/port.h"

namespace runnel {

/// The element or port that a person means by `path`: the application's name may be left out, and of
/// ports the group's. Errors name the nearest. Under the structure lock.
[[nodiscard]] Result<FrameworkElement*> FindMeant(Runtime& runtime, std::string_view path);
[[nodiscard]] Result<Port*> FindMeantPort(Runtime& runtime, std::string_view path);

/// How many values have passed each port at and below `start`, by path. Under the structure lock.
using PublicationCounts = std::map<std::string, std::uint64_t, std::less<>>;
[[nodiscard]] PublicationCounts CountPublications(FrameworkElement& start);

}  // namespace runnel
