#pragma once

#include <optional>

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/types/contact.h"
#include "plugins/parameters/parameter.h"

namespace runnel {

/// A bumper all round the body: says that it is touched, and goes on saying so for a while, as a
/// switch with a spring does. Runs in the thread of the world, or it may miss a short touch.
class Bumper final : public Module {
 public:
  using Module::Module;

  Input<Contact> truth{this, "truth", {.description = "what the body touches", .required = true}};
  Output<Contact> contact{this, "contact", {.description = "what the bumper says"}};

  Parameter<double> hold{this,
                         "hold",
                         {.default_value = 0.2,
                          .bounds = {0.0, 60.0},
                          .unit = "s",
                          .description = "how long it stays pressed after a touch"}};

 private:
  void Update() override {
    const auto real = truth.Read();
    if (!real.is_new()) return;
    if (real->is_touching) {
      last_ = *real;
      released_ = now() + FromSeconds(hold.Get());
    }
    const bool is_held = released_ && now() < *released_;
    contact.Publish(real->is_touching || is_held ? last_ : Contact{});
  }

  Contact last_;
  std::optional<Time> released_;
};

}  // namespace runnel
