#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/module/module.h"
#include "core/port/typed_ports.h"
#include "plugins/parameters/static_parameter.h"

namespace runnel::flow {

/// What modules have in common that pass on values of any type, without copying them: `type` says which, in the words
/// of `<port type="…">`, and is known before the ports are made.
///
/// Ports:   of the C++ class behind the type; who connects them sees no difference to those of other modules.
/// Errors:  a type that no port of a loaded plugin has; one whose values only its own module can make.
class PassingModule : public Module {
 public:
  explicit PassingModule(const Placement& placement) : Module(placement) {}

  StaticParameter<std::string> type{
      this, "type", {.default_value = "double", .description = "of the values that pass"}};

 protected:
  /// In Construct(): inputs called in1, in2 …, or in if there is but one, the output out, and places for values.
  Result<void> MakePorts(std::size_t inputs, std::size_t places);

  [[nodiscard]] const std::vector<std::unique_ptr<Port>>& inputs() const noexcept {
    return inputs_;
  }
  [[nodiscard]] Port& input() const noexcept { return *inputs_.front(); }
  [[nodiscard]] HeldValues& values() const noexcept { return *values_; }
  /// Publishes what is in the place, and lets go of it.
  void Pass(std::size_t place) {
    values_->Forward(*output_, place);
    values_->Drop(place);
  }

 private:
  // Leases go before the ports, though they need not.
  std::vector<std::unique_ptr<Port>> inputs_;
  std::unique_ptr<Port> output_;
  std::unique_ptr<HeldValues> values_;
};

}  // namespace runnel::flow
