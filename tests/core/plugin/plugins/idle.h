#pragma once

#include "core/module/module.h"
#include "core/plugin/plugin_entry.h"

namespace runnel::test {

class Idle final : public runnel::Module {
 public:
  using Module::Module;

 private:
  void Update() override {}
};

}  // namespace runnel::test
