#include <algorithm>
#include <cmath>

#include "core/types/type_of.h"
#include "core/types/value_copy.h"
#include "plugins/cdr_values/cdr_values.h"
#include "plugins/ros_messages/internal/message_number.h"
#include "plugins/ros_messages/internal/messages_by_steps.h"

namespace runnel::internal {

namespace {

using Kind = Step::Kind;

constexpr std::size_t kMostBytes = std::size_t{1} << 28;  // of elements, beside the octets there are

/// Walks through the steps and through octets side by side. The way to what failed is found on the way back.
class StepReader {
 public:
  StepReader(CdrReader& reader, std::optional<Time>& stamp)
      : reader_(reader), stamp_(stamp), room_(kMostBytes + reader.left()) {}

  // value: nullptr if there is nothing of it; what is read is then passed over.
  bool Read(const Step& step, void* value) {
    if (step.field != nullptr && value != nullptr) value = step.field->address(value);
    if (ReadStep(step, value)) return true;
    if (!step.name.empty()) path_.insert(0, "." + step.name);
    return false;
  }

  [[nodiscard]] Error error() const {
    const std::string path = path_.starts_with('.') ? path_.substr(1) : path_;
    return {.message = (path.empty() ? "" : path + ": ") + problem_};
  }

 private:
  bool Fail(std::string problem) {
    problem_ = std::move(problem);
    return false;
  }
  bool IsThere(bool is_there) { return is_there || Fail("the octets end before it does"); }

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
    return SetNumber(*step.part, number, value) ||
           Fail(std::to_string(number) + " is no " + step.part->name());
  }

  bool ReadHeading(const Step& step, void* value) {
    double x = 0, y = 0, z = 0, w = 0;
    if (!IsThere(reader_.Get(x) && reader_.Get(y) && reader_.Get(z) && reader_.Get(w))) return false;
    const double heading = std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
    return SetNumber(*step.part, heading, value) || Fail("the heading is no " + step.part->name());
  }

  bool ReadElements(const Step& step, void* value) {
    const ElementOperations& elements = step.part->elements();
    const std::size_t size = std::max<std::size_t>(elements.type->size(), 1);
    std::size_t count = step.capacity;
    if (step.count != MessageCount::kArray) {
      const auto read = reader_.GetCount(FewestOctets(step.inside.front()));
      if (!read) return Fail("it claims more elements than there are octets for");
      count = *read;
    }
    if (count > room_ / size) return Fail(std::to_string(count) + " elements are too many");
    room_ -= count * size;
    // A fixed matrix has rows of its own.
    const bool is_as_long = elements.rows(value) * elements.columns(value) == count;
    if (!is_as_long && !elements.resize(value, 1, count)) {
      return Fail("a " + step.part->name() + " cannot have " + std::to_string(count) + " elements");
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (Read(step.inside.front(), elements.element(value, i))) continue;
      path_.insert(0, "[" + std::to_string(i) + "]");
      return false;
    }
    return true;
  }

  bool SkipList(const Step& step) {
    const Step& element = step.element.front();
    std::size_t count = step.capacity;
    if (step.count != MessageCount::kArray) {
      const auto read = reader_.GetCount(FewestOctets(element));
      if (!read) return Fail("it claims more elements than there are octets for");
      count = *read;
    }
    if (element.kind == Kind::kNoNumber) return IsThere(reader_.Skip(SizeOf(element.type), count));
    for (std::size_t i = 0; i < count; ++i) {
      if (!Read(element, nullptr)) return false;
    }
    return true;
  }

  CdrReader& reader_;
  std::optional<Time>& stamp_;
  std::size_t room_;
  std::string path_;
  std::string problem_;
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

}  // namespace runnel::internal
