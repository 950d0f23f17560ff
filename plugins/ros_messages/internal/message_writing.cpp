#include <algorithm>
#include <cmath>

#include "core/types/type_of.h"
#include "plugins/cdr_values/cdr_values.h"
#include "plugins/ros_messages/internal/binding.h"
#include "plugins/ros_messages/internal/message_number.h"

namespace runnel::internal {

namespace {

using Kind = Step::Kind;

double FieldNumber(const TypeInfo& type, const void* value, std::string_view name) {
  const FieldInfo* const field = type.FindField(name);
  return static_cast<double>(NumberOf(*field->type, field->address(ForLooking(value))));
}

double LastAngle(const TypeInfo& scan, const void* value) {
  const FieldInfo* const ranges = scan.FindField("ranges");
  const auto count = static_cast<double>(ranges->type->elements().columns(ranges->address(ForLooking(value))));
  return FieldNumber(scan, value, "start_angle") + FieldNumber(scan, value, "angle_step") * std::max(count - 1, 0.0);
}

class StepWriter {
 public:
  StepWriter(Time stamp, CdrWriter& writer) : stamp_(stamp), writer_(writer) {}

  void Write(const Step& step, const void* value) {
    if (step.field != nullptr) value = step.field->address(ForLooking(value));
    switch (step.kind) {
      case Kind::kPlain:
        return WriteCdr(*step.part, value, writer_);
      case Kind::kNumber:
        return PutNumber(step.type, NumberOf(*step.part, value), writer_);
      case Kind::kStructure:
        for (const Step& each : step.inside) Write(each, value);
        return;
      case Kind::kElements:
        return WriteElements(step, value);
      case Kind::kElement:
        return;  // read only
      case Kind::kListOfOne:
        writer_.PutCount(1);
        return Write(step.inside.front(), value);
      case Kind::kHeading: {
        const auto half = static_cast<double>(NumberOf(*step.part, value)) / 2;
        writer_.Put(0.0);
        writer_.Put(0.0);
        writer_.Put(std::sin(half));
        return writer_.Put(std::cos(half));
      }
      case Kind::kLastAngle:
        return PutNumber(step.type, LastAngle(*step.part, value), writer_);
      case Kind::kStamp:
        return WriteCdr(TypeOf<Time>(), &stamp_, writer_);
      case Kind::kNoNumber:
        return PutNumber(step.type, step.number, writer_);
      case Kind::kNoText:
        return WriteText(step);
      case Kind::kNoList:
        return WriteDefaults(step);
    }
  }

 private:
  void WriteText(const Step& step) {
    if (step.type == MessageType::kString) return writer_.PutText(step.text);
    writer_.PutCount(step.text.size());
    for (const char c : step.text) writer_.Put(static_cast<std::uint32_t>(static_cast<unsigned char>(c)));
  }

  void WriteElements(const Step& step, const void* value) {
    const ElementOperations& elements = step.part->elements();
    std::size_t count = elements.rows(value) * elements.columns(value);
    if (step.count != MessageCount::kList) count = std::min(count, step.capacity);
    if (step.count != MessageCount::kArray) writer_.PutCount(count);
    for (std::size_t i = 0; i < count; ++i) {
      Write(step.inside.front(), elements.element(ForLooking(value), i));
    }
    if (step.count != MessageCount::kArray) return;
    for (std::size_t i = count; i < step.capacity; ++i) Write(step.element.front(), nullptr);
  }

  void WriteDefaults(const Step& step) {
    if (step.count != MessageCount::kArray) writer_.PutCount(step.inside.size());
    for (const Step& each : step.inside) Write(each, nullptr);
    if (step.count != MessageCount::kArray) return;
    for (std::size_t i = step.inside.size(); i < step.capacity; ++i) Write(step.element.front(), nullptr);
  }

  const Time stamp_;
  CdrWriter& writer_;
};

}  // namespace

void WriteBySteps(const Step& root, const void* value, Time stamp, CdrWriter& writer) {
  StepWriter(stamp, writer).Write(root, value);
}

}  // namespace runnel::internal
