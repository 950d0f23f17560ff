#pragma once

#include "core/element/annotation.h"

namespace runnel {

/// Kept with elements that no tag of their own stands for: whoever saves the application passes them
/// by, with all that is below them. What they hold is either made again by other tags, or no part of
/// the application.
struct NotSaved final : Annotation {};

}  // namespace runnel
