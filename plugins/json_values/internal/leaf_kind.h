#pragma once

namespace runnel {

class TypeInfo;

/// Which of the leaves that everybody knows a leaf is.
enum class LeafKind {
  kBool,
  kInt8,
  kInt16,
  kInt32,
  kInt64,
  kUint8,
  kUint16,
  kUint32,
  kUint64,
  kFloat,
  kDouble,
  kString,
  kDuration,
  kTime,
  kOther,  ///< has a text format of its own
};

[[nodiscard]] LeafKind KindOfLeaf(const TypeInfo& type);

}  // namespace runnel
