#include <algorithm>
#include <cmath>

#include "core/types/type_info.h"
#include "core/types/type_of.h"
#include "plugins/cdr_values/cdr_values.h"
#include "plugins/cdr_values/cdr_walk.h"
#include "plugins/ros_messages/internal/binding.h"
#include "plugins/ros_messages/internal/message_number.h"

namespace runnel::internal {

namespace {

using Kind = Step::Kind;

/// Walks through the steps and through octets side by side.
class StepReader : public CdrWalk {
 public:
  StepReader(CdrReader& reader, std::optional<Time>& stamp) : CdrWalk(reader), stamp_(stamp) {}

  // value: nullptr if there is nothing of it; what is read is then passed over.
  bool Read(const Step& step, void* value) {
    if (step.field != nullptr && value != nullptr) value = step.field->address(value);
    return ReadStep(step, value) || (!step.name.empty() && FailIn(step.name));
  }

 private:
  bool ReadStep(const Step& step, void* value) {
    switch (step.kind) {
      case Kind::kPlain:
        return ReadPlain(*step.part, value);
      case Kind::kNumber:
        return ReadNumber(step, value);
      case Kind::kStructure:
        return std::ranges::all_of(step.inside, [&](const Step& each) { return Read(each, value); });
      case Kind::kElements:
        return ReadElements(step, value);
      case Kind::kElement:
        return ReadElement(step, value);
      case Kind::kListOfOne:
        return Fail("a list is no value");
      case Kind::kHeading:
        return ReadHeading(step, value);
      case Kind::kStamp: {
        Time time;
        if (!ReadPlain(TypeOf<Time>(), &time)) return false;
        if (step.is_own_stamp) stamp_ = time;
        return true;
      }
      case Kind::kLastAngle:
      case Kind::kNoNumber:
        return IsThere(reader_.Skip(SizeOf(step.type), 1));
      case Kind::kNoText: {
        const std::size_t size = step.type == MessageType::kString ? 1 : 4;
        const auto count = reader_.GetCount(size);
        return IsThere(count && reader_.Skip(size, *count));
      }
      case Kind::kNoList:
        return SkipList(step);
    }
    return false;
  }

  bool ReadPlain(const TypeInfo& type, void* value) {
    const auto read = ReadCdr(type, reader_, value);
    return read || Fail(read.error().message);
  }

  bool ReadNumber(const Step& step, void* value) {
    AnyNumber number = 0;
    if (!IsThere(GetNumber(step.type, reader_, number))) return false;
    return SetNumber(*step.part, number, value) || Fail(std::to_string(number) + " is no " + step.part->name());
  }

  bool ReadHeading(const Step& step, void* value) {
    double x = 0, y = 0, z = 0, w = 0;
    if (!IsThere(reader_.Get(x) && reader_.Get(y) && reader_.Get(z) && reader_.Get(w))) return false;
    const double length = x * x + y * y + z * z + w * w;
    if (!(length > 0 && std::isfinite(length)))
      return Fail("a quaternion of length 0, or of what are no numbers, has no heading");
    const double heading = std::atan2(2 * (w * z + x * y), w * w + x * x - y * y - z * z);  // of whatever length it is
    return SetNumber(*step.part, heading, value) || Fail("the heading is no " + step.part->name());
  }

  bool ReadElements(const Step& step, void* value) {
    const ElementOperations& elements = step.part->elements();
    const auto count = CountOf(step, step.inside.front());
    if (!count || !TakeRoom(*elements.type, *count)) return false;
    // A matrix has rows of its own; other lists may refer to what is not theirs until they are resized.
    const bool is_as_long =
        step.part->kind() == TypeKind::kMatrix && elements.rows(value) * elements.columns(value) == *count;
    if (!is_as_long && !Resize(*step.part, value, 1, *count)) return false;
    return ForEach(*step.part, value, *count, [&](void* each) { return Read(step.inside.front(), each); });
  }

  std::optional<std::size_t> CountOf(const Step& step, const Step& element) {
    if (step.count == MessageCount::kArray) return step.capacity;
    return GetCount(FewestOctets(element));
  }

  bool SkipList(const Step& step) {
    const Step& element = step.element.front();
    const auto count = CountOf(step, element);
    return count && Skip(element, *count);
  }

  bool Skip(const Step& element, std::size_t count) {
    if (element.kind == Kind::kNoNumber) return IsThere(reader_.Skip(SizeOf(element.type), count));
    for (std::size_t i = 0; i < count; ++i) {
      if (!Read(element, nullptr)) return false;
    }
    return true;
  }

  bool ReadElement(const Step& step, void* value) {
    const auto count = CountOf(step, step.element.front());
    if (!count) return false;
    if (step.index >= *count) {
      return Fail("it has no element [" + std::to_string(step.index) + "], but " + std::to_string(*count) + " of them");
    }
    return Skip(step.element.front(), step.index) && Read(step.inside.front(), value);
  }

  std::optional<Time>& stamp_;
};

}  // namespace

Result<void> ReadBySteps(const Step& root, CdrReader& reader, const void* fresh, void* value,
                         std::optional<Time>& stamp) {
  StepReader steps(reader, stamp);
  if (root.kind != Kind::kStructure) {
    if (!steps.Read(root, value)) return steps.error();
    return {};
  }
  for (const Step& step : root.inside) {
    const bool is_missing = &step != &root.inside.front() && reader.left() == 0;
    if (!is_missing) {
      if (!steps.Read(step, value)) return steps.error();
    } else if (step.field != nullptr && fresh != nullptr) {
      const FieldInfo& field = *step.field;
      (void)CopyValue(*field.type, field.address(ForLooking(fresh)), field.address(value));
    }
  }
  return {};
}

namespace {

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
