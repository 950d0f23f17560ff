#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeindex>
#include <vector>

#include "core/base/result.h"

namespace runnel {

class TypeInfo;
struct FieldOptions;

enum class TypeKind {
  kOpaque,       ///< has a name, and nothing inside that anybody may look at
  kLeaf,         ///< one value with a text format of its own: bool, numbers, string, duration, time
  kEnumeration,  ///< one of a few names
  kStructure,    ///< named fields
  kSequence,     ///< any or a fixed number of elements of one type
  kMatrix,       ///< rows and columns of elements of one type
};

/// Where a field lies in a structure. No std::function, which would cost each field of each type more code.
class FieldAddress {
 public:
  template <typename T, typename Pointer>
  FieldAddress(std::type_identity<T>, Pointer member) : find_(Find<T, Pointer>) {
    static_assert(sizeof member == sizeof member_);
    std::memcpy(&member_, &member, sizeof member);
  }
  void* operator()(void* structure) const { return find_(structure, member_); }

 private:
  template <typename T, typename Pointer>
  static void* Find(void* structure, std::ptrdiff_t bytes) {
    Pointer member;
    std::memcpy(&member, &bytes, sizeof member);
    return &(static_cast<T*>(structure)->*member);
  }

  void* (*find_)(void* structure, std::ptrdiff_t member);
  std::ptrdiff_t member_ = 0;  // the bytes of a pointer to a data member
};

/// A public member of a structure.
struct FieldInfo {
  std::string name;
  const TypeInfo* type;
  std::string unit;  ///< SI, "" for none
  std::string description;
  FieldAddress address;
};

/// One name of an enumeration.
struct EnumeratorInfo {
  std::string name;
  std::int64_t value;
};

/// FieldInfo::address and ElementOperations::element give a way to change the value; those who only
/// look at it say so by this.
[[nodiscard]] inline void* ForLooking(const void* value) { return const_cast<void*>(value); }

/// How a leaf becomes text, and back.
struct LeafOperations {
  std::string (*to_text)(const void* value);
  Result<void> (*from_text)(std::string_view text, void* value);
  bool needs_quotes;                                   ///< within structures the text stands in quotation marks
  void (*copy)(void* to, const void* from) = nullptr;  ///< set by TypeBuilder::Leaf()
};

struct EnumerationOperations {
  std::int64_t (*get)(const void* value);
  void (*set)(void* value, std::int64_t number);
};

/// Sequences and matrices; a sequence is one row, of which only the columns count. Elements are
/// counted row by row.
struct ElementOperations {
  const TypeInfo* type;
  bool is_fixed = false;  ///< the number of elements is part of the type
  std::size_t (*rows)(const void* value) = [](const void*) -> std::size_t { return 1; };
  std::size_t (*columns)(const void* value);
  /// False if the type cannot have that many.
  bool (*resize)(void* value, std::size_t rows, std::size_t columns);
  void* (*element)(void* value, std::size_t index);
  /// Numbers (no bool) that lie one behind the other in the order in which they are counted: from the first element
  /// on, type->size() bytes each may be copied at once.
  bool are_plain_numbers = false;
};

/// What can be known of a type at run time: its name and what is inside, so that values can be
/// shown, set from text, sent and recorded by code that was compiled without the type.
///
/// One object per C++ type and process, made by TypeOf<T>(); compare by address.
///
/// Threads:  never changes once TypeOf() has returned it; any thread.
class TypeInfo {
 public:
  explicit TypeInfo(std::type_index cpp_type) : cpp_type_(cpp_type) {}
  TypeInfo(const TypeInfo&) = delete;
  TypeInfo& operator=(const TypeInfo&) = delete;

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] TypeKind kind() const noexcept { return kind_; }
  [[nodiscard]] std::type_index cpp_type() const noexcept { return cpp_type_; }
  /// Of one value, in bytes, without what it has elsewhere.
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// What a value stands for, for viewers that know no module: "pose", "range_scan"; "" if nobody
  /// said. The words and the fields that go with them: core/types/README.md.
  [[nodiscard]] const std::string& semantic_tag() const noexcept { return semantic_tag_; }
  /// Whether values have a text format: nothing in them is opaque.
  [[nodiscard]] bool is_transparent() const;
  /// Whether the type, or one of what is inside, its fields and elements, is what is meant.
  [[nodiscard]] bool HasPart(bool (*is_meant)(const TypeInfo& part)) const;

  /// Of a structure, in the order of their description.
  [[nodiscard]] std::span<const FieldInfo> fields() const noexcept { return fields_; }
  [[nodiscard]] const FieldInfo* FindField(std::string_view name) const;
  /// Of an enumeration.
  [[nodiscard]] std::span<const EnumeratorInfo> enumerators() const noexcept { return enumerators_; }
  [[nodiscard]] const LeafOperations& leaf() const noexcept { return leaf_; }
  [[nodiscard]] const EnumerationOperations& enumeration() const noexcept { return enumeration_; }
  [[nodiscard]] const ElementOperations& elements() const noexcept { return elements_; }

  /// False only while the description is being written, by the thread that writes it.
  [[nodiscard]] bool is_complete() const noexcept { return is_complete_; }

  /// A new value as `T{}` makes it; nullptr if the type has no default constructor. Allocates.
  [[nodiscard]] std::shared_ptr<void> Make() const;

 private:
  template <typename T>
  friend class TypeBuilder;
  friend class TypeRegistry;

  void AddField(std::string&& name, const TypeInfo& type, FieldOptions&& options, const FieldAddress& address);

  const std::type_index cpp_type_;
  std::size_t size_ = 0;  // of a value, and how it is aligned, where it was described first
  std::size_t alignment_ = 0;
  std::string name_;
  std::string semantic_tag_;
  TypeKind kind_ = TypeKind::kOpaque;
  bool is_complete_ = false;
  std::vector<FieldInfo> fields_;
  std::vector<EnumeratorInfo> enumerators_;
  LeafOperations leaf_{};
  EnumerationOperations enumeration_{};
  ElementOperations elements_{};
  void* (*make_)() = nullptr;
  void (*delete_)(void* value) = nullptr;
};

/// The type called `name` among those that have been asked for in this process; nullptr if there is
/// none. Locks.
[[nodiscard]] const TypeInfo* FindType(std::string_view name);
/// All types that have been asked for, sorted by name. Locks.
[[nodiscard]] std::vector<const TypeInfo*> RegisteredTypes();

/// Sets `to` to what `from` is, both objects of the type, part by part as the description has it: for values
/// that two libraries share, of which each has its own idea of how the whole is copied. False if a list
/// cannot have that many elements; `to` is then half set. Precondition: the type is transparent.
///
/// Threads: as for the two objects. Allocates.
[[nodiscard]] bool CopyValue(const TypeInfo& type, const void* from, void* to);

}  // namespace runnel
