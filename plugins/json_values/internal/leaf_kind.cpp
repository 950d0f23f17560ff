#include "plugins/json_values/internal/leaf_kind.h"

#include <array>
#include <utility>

#include "core/types/type_of.h"

namespace runnel {

LeafKind KindOfLeaf(const TypeInfo& type) {
  // What lists are made of comes first.
  static const std::array<std::pair<const TypeInfo*, LeafKind>, 14> kKinds{{
      {&TypeOf<float>(), LeafKind::kFloat},
      {&TypeOf<double>(), LeafKind::kDouble},
      {&TypeOf<std::uint8_t>(), LeafKind::kUint8},
      {&TypeOf<std::uint16_t>(), LeafKind::kUint16},
      {&TypeOf<std::int32_t>(), LeafKind::kInt32},
      {&TypeOf<std::uint32_t>(), LeafKind::kUint32},
      {&TypeOf<bool>(), LeafKind::kBool},
      {&TypeOf<std::string>(), LeafKind::kString},
      {&TypeOf<std::int64_t>(), LeafKind::kInt64},
      {&TypeOf<std::uint64_t>(), LeafKind::kUint64},
      {&TypeOf<Duration>(), LeafKind::kDuration},
      {&TypeOf<Time>(), LeafKind::kTime},
      {&TypeOf<std::int8_t>(), LeafKind::kInt8},
      {&TypeOf<std::int16_t>(), LeafKind::kInt16},
  }};
  for (const auto& [known, kind] : kKinds) {
    if (known == &type) return kind;
  }
  return LeafKind::kOther;
}

}  // namespace runnel
