#include "modules/flow/passing_module.h"

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

Result<void> PassingModule::MakePorts(std::size_t inputs, std::size_t places) {
  const auto ports = FindPortsByName(type.Get());
  if (!ports) return ports.error().WithPath(type.path());
  for (std::size_t i = 1; i <= inputs; ++i) {
    inputs_.push_back((*ports)->MakeInput(InputGroup(), inputs == 1 ? "in" : "in" + std::to_string(i),
                                          {.ageing = Ageing::kPassedOn}));
  }
  output_ = (*ports)->MakeOutput(OutputGroup(), "out");
  if (output_ == nullptr) {
    return Error{.message = "values of type '" + type.Get() + "' can be made by their own module only",
                 .path = type.path()};
  }
  values_ = (*ports)->MakeHeldValues(places);
  return {};
}

bool PassingModule::PassSafeValue() {
  const auto is_in_force = [this] { return static_cast<const InputBase&>(input()).is_stop_in_force(); };
  if (!is_in_force()) return false;
  while (values_->Next(input(), 0)) {
  }
  (void)values_->Read(input(), 0);
  // Asked again: a command that came after a release has to pass by the usual way.
  if (is_in_force() && values_->Find(0) != nullptr) Pass(0);
  values_->Drop(0);
  return true;
}

}  // namespace runnel::flow
