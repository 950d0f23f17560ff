#pragma once

#include <string>
#include <utility>

#include "core/element/annotation.h"

namespace runnel {

/// How an element was called before. Files may still use it.
struct FormerName final : Annotation {
  explicit FormerName(std::string text) : name(std::move(text)) {}
  const std::string name;
};

}  // namespace runnel
