#include "plugins/runtime_construction/port_types.h"

#include <thread>

#include "core/element/runtime.h"
#include "core/types/builtin_types.h"
#include "core/types/type_of.h"

namespace runnel {

namespace {

template <typename... Types>
void MakeKnown() {
  ((void)TypeOf<Types>(), ...);
}

}  // namespace

void MakePortTypesKnown(const ModuleRegistry& modules) {
  MakeKnown<bool, std::int8_t, std::int16_t, std::int32_t, std::int64_t, std::uint8_t,
            std::uint16_t, std::uint32_t, std::uint64_t, float, double, std::string, Duration,
            Time>();
  std::thread([&modules] {
    Runtime scratch;
    for (const ModuleType* type : modules.All()) {
      // One that cannot be made here brings no type; if the application asks for it, that is told.
      (void)modules.Create(type->name, scratch.root(),
                           std::to_string(scratch.root().children().size()));
    }
  }).join();
}

}  // namespace runnel
