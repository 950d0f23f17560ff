#pragma once

#include "core/types/type_builder.h"

namespace runnel {

/// That something has happened: a value without content, of which only counts that it came, and when. Anything
/// can be connected to an input of signals.
struct Signal {
  friend bool operator==(const Signal&, const Signal&) = default;
};

void Describe(TypeBuilder<Signal>& type);

}  // namespace runnel
