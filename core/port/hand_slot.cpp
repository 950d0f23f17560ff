#include "core/port/hand_slot.h"

#include <utility>

#include "core/element/annotation.h"
#include "core/port/port.h"
#include "core/port/stand_in.h"

namespace runnel {

namespace {

// What takes the place of the port has the same slot; a copy has none.
struct SlotOfPort final : Annotation {
  explicit SlotOfPort(std::shared_ptr<HandSlot> of_port) : slot(std::move(of_port)) {}
  [[nodiscard]] std::unique_ptr<Annotation> ForReplacement() const override {
    return std::make_unique<SlotOfPort>(slot);
  }
  [[nodiscard]] std::unique_ptr<Annotation> ForCopy() const override { return nullptr; }
  const std::shared_ptr<HandSlot> slot;
};

}  // namespace

std::shared_ptr<HandSlot> HandSlot::Find(const Port& port) {
  const auto* const found = port.FindAnnotation<SlotOfPort>();
  return found != nullptr ? found->slot : nullptr;
}

std::shared_ptr<HandSlot> HandSlot::Of(Port& port) {
  if (auto found = Find(port)) return found;
  const auto made = std::make_shared<HandSlot>();
  port.Annotate(std::make_unique<SlotOfPort>(made));
  return made;
}

Result<void> HandSlot::Publish(const AnyValue& value) const {
  if (stand_in == nullptr) return {};
  const auto published = stand_in->PublishFilled(internal::FillWith(value));
  return published ? Result<void>() : published.error();
}

}  // namespace runnel
