#pragma once

#include <cstdint>
#include <random>
#include <string>

#include "core/types/leaf_types.h"
#include "core/types/type_info.h"

namespace runnel::test {

/// Fills any value of a described type; the same seed makes the same. Texts have letters only, so that leaves with a
/// text format of their own take them, and lists get shorter the deeper they are.
class RandomValue {
 public:
  explicit RandomValue(unsigned seed) : random_(seed) {}

  void Fill(const TypeInfo& type, void* value, std::size_t longest = 5) {
    if (type.kind() == TypeKind::kLeaf) {
      FillLeaf(type, value);
    } else if (type.kind() == TypeKind::kEnumeration) {
      const auto names = type.enumerators();
      type.enumeration().set(value, names[Below(names.size())].value);
    } else if (type.kind() == TypeKind::kStructure) {
      for (const FieldInfo& field : type.fields()) Fill(*field.type, field.address(value), longest);
    } else {
      const ElementOperations& elements = type.elements();
      if (!elements.is_fixed) {
        const bool is_matrix = type.kind() == TypeKind::kMatrix;
        elements.resize(value, is_matrix ? Below(longest + 1) : 1, Below(longest + 1));
      }
      const std::size_t count = elements.rows(value) * elements.columns(value);
      for (std::size_t i = 0; i < count; ++i) {
        Fill(*elements.type, elements.element(value, i), longest / 2);
      }
    }
  }

  std::size_t Below(std::size_t end) { return random_() % end; }

 private:
  void FillLeaf(const TypeInfo& type, void* value) {
    WithLeafType(type, [&]<typename T>(std::type_identity<T>) {
      if constexpr (std::is_same_v<T, std::string>) {
        *static_cast<T*>(value) = Text();
      } else if constexpr (std::is_same_v<T, Duration> || std::is_same_v<T, Time>) {
        *static_cast<T*>(value) = T(Duration(static_cast<std::int64_t>(random_()) << 28));
      } else if constexpr (std::is_floating_point_v<T>) {
        *static_cast<T*>(value) = static_cast<T>(random_()) / 1000 - 5;
      } else if constexpr (std::is_same_v<T, bool>) {
        *static_cast<T*>(value) = random_() % 2 == 1;
      } else if constexpr (!std::is_void_v<T>) {
        *static_cast<T*>(value) = static_cast<T>(std::uint64_t{random_()} << 32 | random_());
      } else {
        (void)type.leaf().from_text(Text(), value);
      }
    });
  }
  std::string Text() {
    std::string text;
    for (std::size_t i = Below(9); i > 0; --i) text += static_cast<char>('a' + Below(26));
    return text;
  }

  std::mt19937 random_;
};

}  // namespace runnel::test
