#pragma once

#include <string>

#include "core/element/framework_element.h"

namespace runnel::program {

/// How the cycles of all threads at and below `root` have gone, one line each under a heading.
[[nodiscard]] std::string StatisticsTable(FrameworkElement& root);

}  // namespace runnel::program
