#pragma once

#include <functional>

#include "core/base/error.h"
#include "core/element/framework_element.h"

namespace runnel {

/// Says what is wrong with an element, and where it stands in the file.
using TellError = std::function<void(Error error, const SourcePosition& position,
                                     const FrameworkElement& element)>;

/// Tells of each input at or below `application` that has to be connected and is not.
void CheckRequiredInputs(FrameworkElement& application, const TellError& tell);

}  // namespace runnel
