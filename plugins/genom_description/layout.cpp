#include <algorithm>
#include <limits>

#include "plugins/genom_description/component_json.h"

namespace runnel::genom {

namespace {

constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();

std::uint64_t Sum(std::uint64_t a, std::uint64_t b) { return a > kMost - b ? kMost : a + b; }
std::uint64_t Product(std::uint64_t a, std::uint64_t b) { return b != 0 && a > kMost / b ? kMost : a * b; }
std::uint64_t Aligned(std::uint64_t offset, std::uint64_t alignment) {
  const std::uint64_t rest = offset % alignment;
  return rest == 0 || offset == kMost ? offset : Sum(offset, alignment - rest);
}

// Parts side by side, in order.
class Row {
 public:
  std::uint64_t Add(Layout part) {
    const std::uint64_t offset = Aligned(whole_.size, part.alignment);
    whole_.size = Sum(offset, part.size);
    whole_.alignment = std::max(whole_.alignment, part.alignment);
    return offset;
  }
  [[nodiscard]] Layout layout() const { return {Aligned(whole_.size, whole_.alignment), whole_.alignment}; }

 private:
  Layout whole_ = {};
};

constexpr Layout kPointer{8, 8};
constexpr Layout kCount{4, 4};
constexpr Layout kBoolean{1, 1};

}  // namespace

Layout Layouts::OfMembers(const std::vector<Type*>& members, std::vector<std::uint64_t>* offsets) {
  Row row;
  for (const Type* each : members) {
    const std::uint64_t offset = row.Add(Of(*each->type));
    if (offsets != nullptr) offsets->push_back(offset);
  }
  return row.layout();
}

Layout Layouts::Of(const Type& type) {
  const Type& final_type = *FinalType(&type);
  if (const auto found = known_.find(&final_type); found != known_.end()) return found->second;
  if (depth_ >= kDeepest) return {kMost, 8};
  ++depth_;
  const Layout layout = Compute(final_type);
  --depth_;
  known_.emplace(&final_type, layout);
  return layout;
}

Layout Layouts::Compute(const Type& type) {
  switch (type.kind) {
    case TypeKind::kBoolean:
    case TypeKind::kOctet:
    case TypeKind::kCharacter:
      return {1, 1};
    case TypeKind::kShort:
    case TypeKind::kUnsignedShort:
      return {2, 2};
    case TypeKind::kLong:
    case TypeKind::kUnsignedLong:
    case TypeKind::kFloat:
    case TypeKind::kEnum:
      return {4, 4};
    case TypeKind::kLongLong:
    case TypeKind::kUnsignedLongLong:
    case TypeKind::kDouble:
      return {8, 8};
    case TypeKind::kNative:
      return kPointer;
    case TypeKind::kString:
      return type.length == Type::kUnbounded ? kPointer : Layout{type.length, 1};
    case TypeKind::kArray: {
      const Layout element = Of(*type.type);
      return {Product(element.size, type.length), element.alignment};
    }
    case TypeKind::kSequence: {  // _maximum, _length, _buffer, and _release if that is a pointer
      Row row;
      row.Add(kCount);
      row.Add(kCount);
      if (type.length == Type::kUnbounded) {
        row.Add(kPointer);
        row.Add(kPointer);
      } else {
        const Layout element = Of(*type.type);
        row.Add({Product(element.size, type.length), element.alignment});
      }
      return row.layout();
    }
    case TypeKind::kOptional: {
      Row row;
      row.Add(kBoolean);
      row.Add(Of(*type.type));
      return row.layout();
    }
    case TypeKind::kUnion: {
      Layout largest;
      for (const Type* each : type.members) {
        const Layout member = Of(*each->type);
        largest = {std::max(largest.size, member.size), std::max(largest.alignment, member.alignment)};
      }
      Row row;
      row.Add(Of(*type.type));
      row.Add(largest);
      return row.layout();
    }
    case TypeKind::kStruct:
    case TypeKind::kException:
      return OfMembers(type.members);
    default:
      return {0, 1};
  }
}

}  // namespace runnel::genom
