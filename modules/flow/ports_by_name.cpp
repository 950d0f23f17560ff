#include "modules/flow/ports_by_name.h"

#include <cstdint>

#include "core/base/nearest_name.h"
#include "core/types/type_info.h"
#include "core/types/type_of.h"

namespace runnel::flow {

namespace {

template <typename... Types>
void MakeKnown() {
  ((void)TypeOf<Types>(), ...);
  (internal::MakeTypedPortsKnown<Types>(), ...);
}

}  // namespace

Result<const TypedPorts*> FindPortsByName(const std::string& name) {
  // Those that nobody need have used before.
  MakeKnown<bool, std::int32_t, std::int64_t, std::uint32_t, double, std::string>();
  const TypeInfo* const type = FindType(name);
  if (type == nullptr) {
    return Error{.message = "there is no data type '" + name + "'",
                 .hint = NearestNameHint(name, NamesOf(RegisteredTypes(), &TypeInfo::name))};
  }
  if (const TypedPorts* const ports = FindTypedPorts(*type)) return ports;
  return Error{.message = "no module that has been made has a port of type '" + name + "'",
               .hint = "add the module that the values come from first"};
}

}  // namespace runnel::flow
