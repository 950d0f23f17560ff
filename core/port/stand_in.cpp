#include "core/port/stand_in.h"

#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>

#include "core/channel/channel.h"
#include "core/element/runtime.h"
#include "core/lockfree/thread_epoch.h"
#include "core/port/typed_ports.h"
#include "core/types/builtin_types.h"
#include "core/types/type_info.h"
#include "core/types/type_of.h"

namespace runnel::internal {

StandIn::StandIn(const Port& goes_on_at, std::unique_ptr<ChannelBase> channel)
    : Port({goes_on_at.runtime().root(), "stand_in", false}, Direction::kOutput, goes_on_at.type(), {}),
      goes_on_at_(&goes_on_at),
      channel_(std::move(channel)) {}

StandIn::~StandIn() = default;

Port::Fill FillWith(const AnyValue& value) {
  return [value](void* to) -> Result<void> {
    return CopyValue(value.type(), value.get(), to) ? Result<void>() : Error{.message = "the value cannot be copied"};
  };
}

void DeleteLater(std::unique_ptr<StandIn> stand_in) {
  Retire([stand_in = stand_in.release()] { delete stand_in; });
}

namespace {

// Of types that values become, and no module may have a port for.
template <typename... Types>
std::unique_ptr<ChannelBase> MakeChannelOf(const TypeInfo& type) {
  std::unique_ptr<ChannelBase> channel;
  const auto try_one = [&]<typename T>(std::type_identity<T>) {
    if (!channel && &type == &TypeOf<T>()) channel = Channel<T>::Make();
  };
  (try_one(std::type_identity<Types>()), ...);
  return channel;
}

}  // namespace

std::unique_ptr<ChannelBase> MakeChannelFor(const TypeInfo& type) {
  const TypedPorts* const ports = FindTypedPorts(type);
  auto channel =
      ports != nullptr
          ? ports->MakeChannel()
          : MakeChannelOf<bool, std::int8_t, std::int16_t, std::int32_t, std::int64_t, std::uint8_t, std::uint16_t,
                          std::uint32_t, std::uint64_t, float, double, std::string, Signal>(type);
  if (channel && !channel->can_be_filled()) channel.reset();
  return channel;
}

}  // namespace runnel::internal
