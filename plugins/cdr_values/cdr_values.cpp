#include "plugins/cdr_values/cdr_values.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "core/types/builtin_types.h"
#include "core/types/leaf_types.h"
#include "core/types/shared_vector_types.h"
#include "core/types/type_info.h"
#include "plugins/cdr_values/cdr_walk.h"

namespace runnel {

namespace {

// Calls `use` with the unsigned number that is as large as the enumeration, as a std::type_identity.
template <typename Use>
auto WithEnumerationType(const TypeInfo& type, const Use& use) {
  switch (type.size()) {
    case 1:
      return use(std::type_identity<std::uint8_t>());
    case 2:
      return use(std::type_identity<std::uint16_t>());
    case 4:
      return use(std::type_identity<std::uint32_t>());
    default:
      return use(std::type_identity<std::uint64_t>());
  }
}

constexpr int kDeepest = 100;
constexpr std::size_t kLeastReferredTo = 4096;  // bytes: less is as soon copied

/// Walks through a description and through octets side by side.
class ValueReader : public CdrWalk {
 public:
  explicit ValueReader(CdrReader& reader) : CdrWalk(reader) {}

  bool Read(const TypeInfo& type, void* value) {
    switch (type.kind()) {
      case TypeKind::kOpaque:
        break;
      case TypeKind::kLeaf:
        return ReadLeaf(type, value);
      case TypeKind::kEnumeration:
        return ReadEnumeration(type, value);
      case TypeKind::kStructure:
        return std::ranges::all_of(type.fields(), [&](const FieldInfo& field) { return ReadField(field, value); });
      case TypeKind::kSequence:
      case TypeKind::kMatrix:
        return ReadElements(type, value);
    }
    return Fail("a " + type.name() + " is not described");
  }

  bool ReadField(const FieldInfo& field, void* structure) {
    return Read(*field.type, field.address(structure)) || FailIn(field.name);
  }

 private:
  bool ReadLeaf(const TypeInfo& type, void* value) {
    if (&type == &TypeOf<Signal>()) return IsThere(reader_.Skip(1, 1));
    return WithLeafType(type, [&]<typename T>(std::type_identity<T>) {
      if constexpr (std::is_void_v<T>) {
        std::string text;
        if (!IsThere(reader_.GetText(text))) return false;
        const auto read = type.leaf().from_text(text, value);
        return read || Fail(read.error().message);
      } else if constexpr (std::is_same_v<T, std::string>) {
        return IsThere(reader_.GetText(*static_cast<T*>(value)));
      } else if constexpr (std::is_same_v<T, Duration> || std::is_same_v<T, Time>) {
        std::int32_t whole = 0;
        std::uint32_t rest = 0;
        if (!IsThere(reader_.Get(whole) && reader_.Get(rest))) return false;
        *static_cast<T*>(value) = T(std::chrono::seconds(whole) + Duration(rest));
        return true;
      } else {
        return IsThere(reader_.Get(*static_cast<T*>(value)));
      }
    });
  }

  bool ReadEnumeration(const TypeInfo& type, void* value) {
    return WithEnumerationType(type, [&]<typename N>(std::type_identity<N>) {
      N number = 0;
      if (!IsThere(reader_.Get(number))) return false;
      for (const EnumeratorInfo& each : type.enumerators()) {
        if (static_cast<N>(each.value) != number) continue;
        type.enumeration().set(value, each.value);
        return true;
      }
      return Fail("there is no " + type.name() + " of the number " + std::to_string(number));
    });
  }

  bool ReadElements(const TypeInfo& type, void* value) {
    const ElementOperations& elements = type.elements();
    const TypeInfo& element = *elements.type;
    std::size_t count = elements.is_fixed ? elements.rows(value) * elements.columns(value) : 0;
    if (!elements.is_fixed) {
      std::uint32_t rows = 1, columns = 0;
      if (!ReadCounts(type, rows, columns, count)) return false;
      if (Refer(type, value, count)) return true;
      if (!TakeRoom(element, count) || !Resize(type, value, rows, columns)) return false;
    }
    if (count == 0) return true;
    if (elements.are_plain_numbers) {
      return IsThere(reader_.GetPlain(elements.element(value, 0), element.size(), count));
    }
    if (++depth_ > kDeepest) {
      return Fail("it is nested deeper than " + std::to_string(kDeepest) + " levels");
    }
    if (!ForEach(type, value, count, [&](void* each) { return Read(element, each); })) return false;
    --depth_;
    return true;
  }

  // Whether the list has become what lies in the octets, without a copy.
  bool Refer(const TypeInfo& type, void* value, std::size_t count) {
    const std::size_t size = type.elements().type->size();
    if (!type.elements().are_plain_numbers || count * size < kLeastReferredTo) return false;
    CdrReader behind = reader_;
    const std::byte* const first = behind.FindKept(size, count);
    if (first == nullptr || !ReferTo(type, value, first, count, reader_.holder())) return false;
    reader_ = std::move(behind);
    return true;
  }

  bool ReadCounts(const TypeInfo& type, std::uint32_t& rows, std::uint32_t& columns, std::size_t& count) {
    const TypeInfo& element = *type.elements().type;
    const bool is_matrix = type.kind() == TypeKind::kMatrix;
    if (is_matrix && !IsThere(reader_.Get(rows) && reader_.Get(columns))) return false;
    const auto read = GetCount(FewestCdrOctets(element));
    if (!read) return false;
    count = *read;
    if (!is_matrix) columns = static_cast<std::uint32_t>(count);
    if (std::uint64_t{rows} * columns != count)
      return Fail(std::to_string(count) + " elements are too many or too few");
    return true;
  }

  int depth_ = 0;
};

std::size_t FewestOctetsOfLeaf(const TypeInfo& type) {
  if (&type == &TypeOf<Signal>()) return 1;
  return WithLeafType(type, []<typename T>(std::type_identity<T>) -> std::size_t {
    if constexpr (std::is_arithmetic_v<T>) {
      return sizeof(T);
    } else {  // texts have a length, times two numbers of 32 bits
      return std::is_void_v<T> || std::is_same_v<T, std::string> ? 4 : 8;
    }
  });
}

// Of fixed arrays only those of numbers are as large as their elements together; others may be empty.
std::size_t FewestOctetsOfElements(const TypeInfo& type) {
  const ElementOperations& elements = type.elements();
  if (!elements.is_fixed) return type.kind() == TypeKind::kMatrix ? 12 : 4;
  const std::size_t size = elements.type->size();
  return elements.are_plain_numbers ? type.size() / size * size : 0;
}

}  // namespace

std::size_t FewestCdrOctets(const TypeInfo& type) {
  switch (type.kind()) {
    case TypeKind::kLeaf:
      return FewestOctetsOfLeaf(type);
    case TypeKind::kEnumeration:
      return type.size();
    case TypeKind::kSequence:
    case TypeKind::kMatrix:
      return FewestOctetsOfElements(type);
    default: {
      std::size_t sum = 0;
      for (const FieldInfo& field : type.fields()) sum += FewestCdrOctets(*field.type);
      return sum;
    }
  }
}

Result<void> ReadCdr(const TypeInfo& type, CdrReader& reader, void* value) {
  ValueReader values(reader);
  if (!values.Read(type, value)) return values.error();
  return {};
}

Result<void> ReadCdr(const TypeInfo& type, std::span<const std::byte> octets, void* value,
                     std::shared_ptr<const void> holder) {
  auto reader = CdrReader::Begin(octets, std::move(holder));
  if (!reader) return reader.error();
  if (type.kind() != TypeKind::kStructure) return ReadCdr(type, *reader, value);
  ValueReader values(*reader);
  std::shared_ptr<void> fresh;
  for (const FieldInfo& field : type.fields()) {
    const bool is_missing = &field != &type.fields().front() && reader->left() == 0;
    if (is_missing && fresh == nullptr) fresh = type.Make();
    if (is_missing && fresh != nullptr) {
      (void)CopyValue(*field.type, field.address(fresh.get()), field.address(value));
    } else if (!values.ReadField(field, value)) {
      return values.error();
    }
  }
  return {};
}

namespace {

void WriteTime(Duration since_begin, CdrWriter& writer) {
  using std::chrono::floor, std::chrono::seconds;
  constexpr std::numeric_limits<std::int32_t> kLimits;
  const auto whole = floor<seconds>(since_begin);
  const auto held = std::clamp<std::int64_t>(whole.count(), kLimits.min(), kLimits.max());
  writer.Put(static_cast<std::int32_t>(held));
  writer.Put(static_cast<std::uint32_t>((since_begin - whole).count()));
}

void WriteLeaf(const TypeInfo& type, const void* value, CdrWriter& writer) {
  if (&type == &TypeOf<Signal>()) return writer.Put(std::uint8_t{0});
  WithLeafType(type, [&]<typename T>(std::type_identity<T>) {
    if constexpr (std::is_void_v<T>) {
      writer.PutText(type.leaf().to_text(value));
    } else if constexpr (std::is_same_v<T, std::string>) {
      writer.PutText(*static_cast<const T*>(value));
    } else if constexpr (std::is_same_v<T, Duration>) {
      WriteTime(*static_cast<const T*>(value), writer);
    } else if constexpr (std::is_same_v<T, Time>) {
      WriteTime(static_cast<const T*>(value)->time_since_epoch(), writer);
    } else {
      writer.Put(*static_cast<const T*>(value));
    }
  });
}

void WriteElements(const TypeInfo& type, const void* value, CdrWriter& writer) {
  const ElementOperations& elements = type.elements();
  const std::size_t rows = elements.rows(value), columns = elements.columns(value);
  if (!elements.is_fixed) {
    if (type.kind() == TypeKind::kMatrix) {
      writer.PutCount(rows);
      writer.PutCount(columns);
    }
    writer.PutCount(rows * columns);
  }
  void* const list = ForLooking(value);
  if (rows * columns == 0) return;
  if (elements.are_plain_numbers) {
    return writer.PutPlain(elements.element(list, 0), elements.type->size(), rows * columns);
  }
  for (std::size_t i = 0; i < rows * columns; ++i) {
    WriteCdr(*elements.type, elements.element(list, i), writer);
  }
}

}  // namespace

void WriteCdr(const TypeInfo& type, const void* value, CdrWriter& writer) {
  switch (type.kind()) {
    case TypeKind::kOpaque:
      break;
    case TypeKind::kLeaf:
      return WriteLeaf(type, value, writer);
    case TypeKind::kEnumeration:
      return WithEnumerationType(
          type, [&]<typename N>(std::type_identity<N>) { writer.Put(static_cast<N>(type.enumeration().get(value))); });
    case TypeKind::kStructure:
      for (const FieldInfo& field : type.fields()) {
        WriteCdr(*field.type, field.address(ForLooking(value)), writer);
      }
      return;
    case TypeKind::kSequence:
    case TypeKind::kMatrix:
      return WriteElements(type, value, writer);
  }
  ThrowProgrammingError("an opaque value has no octets", type.name());
}

void WriteCdr(const TypeInfo& type, const void* value, std::vector<std::byte>& octets) {
  CdrWriter writer(octets);
  WriteCdr(type, value, writer);
}

Result<void> CheckCdr(const TypeInfo& type) {
  if (type.is_transparent()) return {};
  return Error{
      .message = "a " + type.name() + " cannot go over the network: its inside, or a part of it, is not described",
      .hint = "Describe() of the type is to name its fields"};
}

}  // namespace runnel
