#pragma once

#include <memory>
#include <utility>

#include "core/element/annotation.h"
#include "core/port/port_options.h"

namespace runnel {

/// The limits that an application gives to an input, as an annotation of the port: what they leave open is as its
/// module has it. They take effect when the module becomes ready, and go over to one that replaces it.
struct GivenLimits final : Annotation {
  explicit GivenLimits(InputLimits given) : limits(std::move(given)) {}
  [[nodiscard]] std::unique_ptr<Annotation> ForReplacement() const override {
    return std::make_unique<GivenLimits>(limits);
  }
  InputLimits limits;
};

}  // namespace runnel
