#pragma once

#include <string>

#include "core/element/framework_element.h"

namespace runnel {

/// The data flow of an application in the language of Graphviz: groups as nested boxes, modules with
/// the ports that are connected, a colour for each thread, and a key to the colours. The same tree
/// gives the same text.
///
/// Threads: any outside of cycles; takes the structure lock.
[[nodiscard]] std::string DotText(FrameworkElement& application);

}  // namespace runnel
